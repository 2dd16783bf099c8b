// SPDX-License-Identifier: GPL-2.0-or-later
//
// What must come out whatever the units: scaling and turning a whole specimen (PHYSICS.md 2.5, item
// 12), the elastic moduli of a random fabric under affine strain (item 13), and chains of scattered
// strengths (item 14). For every law of law_cases.h.
//
// Factors are powers of two, so a scaled run gives the same bits, breaks and slips included.
#include <gtest/gtest.h>

#include <random>

#include "law_cases.h"
#include "reference_table.h"
#include "strength.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

// Factors on lengths, stresses and density; time follows as length sqrt(density/stress).
struct Scale {
  double length = 1.0, stress = 1.0, density = 1.0;
  double time() const { return length * std::sqrt(density / stress); }
};

class Scaling : public testing::TestWithParam<LawAndSpace> {
 protected:
  const LawCase &law() const { return GetParam()(); }
  bool flat() const { return GetParam().flat; }

  // A random cluster of bonded grains that fly apart, some bonds breaking; `turn` turns it all.
  Bench cluster(const Scale &s, bool options, Vec3 turn = {0, 0, 0}) const {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> u(-1, 1);
    Bench b(flat(), 4e-3 * s.length);
    const int n = flat() ? 4 : 3, depth = flat() ? 1 : 2;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < depth; ++k) {
          const Vec3 x{1.9e-3 * i + 1e-4 * u(random), 1.9e-3 * j + 1e-4 * u(random), flat() ? 0.0 : 1.9e-3 * k + 1e-4 * u(random)};
          const double radius = 1e-3 * (1.0 + 0.1 * u(random));
          Vec3 v = 8.0 * Vec3{u(random), u(random), flat() ? 0.0 : u(random)};
          Vec3 w = 5000.0 * Vec3{flat() ? 0.0 : u(random), flat() ? 0.0 : u(random), u(random)};
          Grain &g = b.grains[b.add(s.length * rotated(x, turn), s.length * radius, 2500.0 * s.density)];
          g.v = (s.length / s.time()) * rotated(v, turn);
          g.w = (1.0 / s.time()) * rotated(w, turn);
        }
    b.options = options;
    const BondCase c{1e9 * s.stress, 2.5, 6e6 * s.stress, 4e6 * s.stress, {2e9 * s.stress, 2.0, 0.5}};
    for (int i = 0; i < static_cast<int>(b.grains.size()); ++i)
      for (int j = i + 1; j < static_cast<int>(b.grains.size()); ++j) {
        if (b.distance(i, j) > 2.4e-3 * s.length) continue;
        PairRow &row = law().bond(b, i, j, c);
        if (options) row.tension = 0.7, row.failure = 2.0, row.viscous = 1e-7 * s.time();
      }
    return b;
  }

  void run(Bench &b, const Scale &s, int steps) const {
    b.load(0.0, false);
    for (int k = 0; k < steps; ++k) b.step(2e-8 * s.time());
  }
};

int broken(const Bench &b) {
  int count = 0;
  for (const PairRow &p : b.pairs) count += p.alive == 0.0;
  return count;
}

}  // namespace

// Lengths at fixed strength: stresses unchanged. Stresses and moduli: loads in proportion. Density:
// the same path in another time.
TEST_P(Scaling, lengths_stresses_and_density) {
  for (const bool options : {false, true}) {
    Bench base = cluster({}, options);
    run(base, {}, 800);
    EXPECT_GT(broken(base), 3);
    EXPECT_LT(broken(base), static_cast<int>(base.pairs.size()));
    for (const Scale s : {Scale{4, 1, 1}, Scale{1, 16, 1}, Scale{1, 1, 0.25}, Scale{0.5, 4, 16}}) {
      Bench other = cluster(s, options);
      run(other, s, 800);
      ASSERT_EQ(base.pairs.size(), other.pairs.size());
      const double force = s.stress * s.length * s.length;
      for (std::size_t k = 0; k < base.grains.size(); ++k) {
        const Grain &a = base.grains[k], &b = other.grains[k];
        EXPECT_EQ(length(s.length * a.x - b.x), 0.0) << k;
        EXPECT_EQ(length(force * a.f - b.f), 0.0) << k;
        EXPECT_EQ(length((force * s.length) * a.t - b.t), 0.0) << k;
      }
      for (std::size_t k = 0; k < base.pairs.size(); ++k) {
        EXPECT_EQ(base.pairs[k].alive, other.pairs[k].alive);
        EXPECT_EQ(s.stress * base.pairs[k].sigma, other.pairs[k].sigma);
        EXPECT_EQ(force * s.length * base.pairs[k].lost, other.pairs[k].lost);
      }
    }
  }
}

// No axis is special: turned as a whole it does the same. Differences are rounding, which the motion
// amplifies, until a break comes a step later; so the run is short.
TEST_P(Scaling, turned_as_a_whole) {
  const Vec3 turn = flat() ? Vec3{0, 0, 0.7} : Vec3{0.4, -1.1, 0.8};
  for (const bool options : {false, true}) {
    Bench base = cluster({}, options), other = cluster({}, options, turn);
    run(base, {}, 400);
    run(other, {}, 400);
    EXPECT_GT(broken(base), 1);
    for (std::size_t k = 0; k < base.pairs.size(); ++k) EXPECT_EQ(base.pairs[k].alive, other.pairs[k].alive);
    for (std::size_t k = 0; k < base.grains.size(); ++k) {
      EXPECT_LT(length(rotated(base.grains[k].x, turn) - other.grains[k].x), 1e-15) << k;
      EXPECT_LT(length(rotated(base.grains[k].f, turn) - other.grains[k].f), 1e-9 * (1.0 + length(base.grains[k].f))) << k;
    }
  }
}

// Affine strain of an isotropic fabric: the six axes of the icosahedron average every tensor of the
// fourth order as all directions do. Stress = sum of l e (x) f over the bonds, by volume.
TEST_P(Scaling, voigt_moduli_of_an_isotropic_fabric) {
  if (flat()) return;
  const ReferenceTable reference;
  const double radius = 1e-3, l = 2e-3, E_b = 1e9, Z = 9.5, phi = 0.62, golden = 0.5 * (1.0 + std::sqrt(5.0));
  const Vec3 axes[] = {{0, 1, golden}, {0, 1, -golden}, {1, golden, 0}, {1, -golden, 0}, {golden, 0, 1}, {-golden, 0, 1}};
  const double volume = 6.0 * 2.0 / Z * (4.0 / 3.0 * kPi * radius * radius * radius) / phi;
  double C[2] = {0, 0};  // C_11, C_12
  for (const Vec3 axis : axes) {
    // five-point derivative: the strain is finite, the moduli are those at none
    const std::pair<double, double> stencil[] = {{-2, 1.0 / 12}, {-1, -8.0 / 12}, {1, 8.0 / 12}, {2, -1.0 / 12}};
    for (const auto &[times, weight] : stencil) {
      Bench b;
      const Vec3 e = unit(axis);
      b.add({0, 0, 0}, radius, 2500);
      b.add(l * e, radius, 2500);
      law().bond(b, 0, 1, {E_b, 2.5, 1e300, 1e300, {}});
      b.load(0.0, false);
      const double h = 1e-5, strain = times * h;
      b.prescribe(1e-7, [&](int g) { return g ? l * e + Vec3{strain * l * e.x, 0, 0} : Vec3{0, 0, 0}; },
                  [](int) { return Vec3{0, 0, 0}; });
      C[0] += weight / h * l * e.x * b.pairs[0].force.x / volume;
      C[1] += weight / h * l * e.y * b.pairs[0].force.y / volume;
    }
  }
  const double E = (C[0] - C[1]) * (C[0] + 2.0 * C[1]) / (C[0] + C[1]), nu = C[1] / (C[0] + C[1]);
  EXPECT_NEAR(E / E_b / reference("voigt_macro", "Z=9.5 phi=.62 R_b=R touching ks/kn=0.4", "E_macro/E_b"), 1.0, 1e-8);
  EXPECT_NEAR(nu / reference("voigt_macro", "ks/kn=0.4", "nu"), 1.0, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Laws, Scaling, testing::ValuesIn(laws_in_space_and_plane()),
                         [](const auto &info) { return name_of(info.param); });

// A chain is as strong as its weakest bond: mean strength n^(-1/k), coefficient of variation that of
// the Weibull modulus k whatever n. Standard errors of 2000 chains: CV/sqrt(2000), 0.7/sqrt(2000).
TEST(WeibullChain, mean_strength_and_variation) {
  const struct {
    double k, cv;
  } table[] = {{2, 0.52}, {3, 0.36}, {5, 0.23}, {8, 0.15}, {12, 0.10}, {20, 0.06}};
  const int chains = 2000;
  for (const auto &row : table)
    for (const int n : {1, 8, 64}) {
      const StrengthDistribution d{50e6, Scatter::weibull, row.k, 17, 0};
      double sum = 0.0, squares = 0.0;
      for (int c = 0; c < chains; ++c) {
        double weakest = 1e300;
        for (int b = 0; b < n; ++b) weakest = std::min(weakest, bond_strength(d, 1 + c * (n + 1) + b, 2 + c * (n + 1) + b));
        sum += weakest, squares += weakest * weakest;
      }
      const double mean = sum / chains, cv = std::sqrt(squares / chains - mean * mean) / mean;
      const double exact = std::sqrt(std::tgamma(1 + 2 / row.k) / std::pow(std::tgamma(1 + 1 / row.k), 2) - 1.0);
      EXPECT_NEAR(mean / (50e6 * std::pow(n, -1.0 / row.k)), 1.0, 3.3 * exact / std::sqrt(chains)) << row.k << ' ' << n;
      EXPECT_NEAR(cv / exact, 1.0, 3.3 * 0.9 / std::sqrt(chains)) << row.k << ' ' << n;
      EXPECT_NEAR(exact, row.cv, 0.0051);  // the table's two digits
    }
}

// The kernel agrees: a chain stretched evenly breaks where the smallest strength is, and at it.
TEST(WeibullChain, breaks_at_its_weakest_bond) {
  const StrengthDistribution d{5e6, Scatter::weibull, 4.0, 3, 0};
  const int n = 70;  // more than a block
  for (int chain = 0; chain < 10; ++chain) {
    Bench b;
    for (int k = 0; k <= n; ++k) b.add({2e-3 * k, 0, 0}, 1e-3, 2500);
    ParallelParameters p;
    p.modulus = 1e9;
    int weakest = 0;
    for (int k = 0; k < n; ++k) {
      b.bond(k, k + 1, p).sigma_c = bond_strength(d, chain * 100 + k + 1, chain * 100 + k + 2);
      if (b.pairs[k].sigma_c < b.pairs[weakest].sigma_c) weakest = k;
    }
    const double strength = b.pairs[weakest].sigma_c;
    const auto stretch = [&](double stress) {
      b.prescribe(1e-7, [&](int g) { return Vec3{2e-3 * g * (1.0 + stress / 1e9), 0, 0}; }, [](int) { return Vec3{0, 0, 0}; });
    };
    stretch(strength * (1.0 - 1e-9));
    for (const PairRow &row : b.pairs) EXPECT_EQ(row.alive, 1.0);
    stretch(strength * (1.0 + 1e-9));
    for (int k = 0; k < n; ++k) EXPECT_EQ(b.pairs[k].alive, k == weakest ? 0.0 : 1.0);
  }
}
