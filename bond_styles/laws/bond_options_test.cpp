// SPDX-License-Identifier: GPL-2.0-or-later
//
// The options that all laws share (bond_options.h) against closed forms, for every law of law_cases.h
// in space and in the plane: tension modulus, softening, damping, no grain contact; and that they
// change nothing when off.
#include "bond_options.h"

#include <gtest/gtest.h>

#include <random>

#include "chain_runs.h"
#include "law_cases.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

constexpr double kThickness = 4e-3;  // m, in the plane
constexpr double kSigma = 5e6;       // Pa, strength where one is needed

class Options : public testing::TestWithParam<LawAndSpace> {
 protected:
  const LawCase &law() const { return GetParam()(); }
  bool flat() const { return GetParam().flat; }

  // Two touching grains, bonded. The options are on, but neutral.
  Bench pair(const BondCase &c = {}, double r2 = 1e-3) const {
    Bench b(flat(), kThickness);
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({1e-3 + r2, 0, 0}, r2, 2500);
    b.options = true;
    law().bond(b, 0, 1, c);
    return b;
  }
  BondStiffness stiffness(const Bench &b) const { return law().stiffness(b, b.pairs[0]); }
};

// Grain 1 goes to `place`, nothing turns; gives the force on it.
Vec3 moved_to(Bench &b, Vec3 place) {
  b.prescribe(1e-7, [&](int g) { return g ? place : b.grains[0].x; }, [](int) { return Vec3{0, 0, 0}; });
  return b.grains[1].f;
}
double pulled_to(Bench &b, double stretch) { return -moved_to(b, {2e-3 + stretch, 0, 0}).x; }

// Softening in pure tension: the strength is reached at u_c, nothing is left at u_f = 2 G_f/sigma_c.
struct Softening {
  double area, k, u_c, u_f, energy;  // m2, N/m, m, m, J
};
Softening soften(Bench &b, const BondStiffness &k, double times_brittle) {
  PairRow &row = b.pairs[0];
  const double area = b.section(row).area, per_area = k.normal / area;
  const double G_f = times_brittle * 0.5 * kSigma * kSigma / per_area;
  row.failure = failure_factor(G_f, per_area, kSigma);
  return {area, k.normal, kSigma / per_area, 2.0 * G_f / kSigma, G_f * area};
}

}  // namespace

TEST_P(Options, softening_carries_a_stress_that_falls_linearly) {
  Bench b = pair({1e9, 2.6, kSigma, 1e300, {}});
  const Softening s = soften(b, stiffness(b), 3.0);
  EXPECT_NEAR(s.u_f / s.u_c, 3.0, 1e-12);
  b.load(0.0, false);
  const int steps = 997;
  for (int k = 1; k <= steps; ++k) {
    const double u = 1.2 * s.u_f * k / steps, peak = s.k * s.u_c;
    const double force = u < s.u_c ? s.k * u : (u < s.u_f ? peak * (s.u_f - u) / (s.u_f - s.u_c) : 0.0);
    ASSERT_NEAR(pulled_to(b, u), force, 1e-9 * peak) << u / s.u_c;
    ASSERT_EQ(b.pairs[0].alive, u < s.u_f ? 1.0 : 0.0);
    // the log sees the undamaged stress
    if (u < s.u_f) {
      ASSERT_NEAR(b.pairs[0].sigma / kSigma, u / s.u_c, 1e-9);
    }
  }
}

// To rounding, in however many steps: the loss of a step is exact for a load in proportion.
TEST_P(Options, monotonic_pull_dissipates_the_fracture_energy) {
  for (const int steps : {3, 10, 100, 1000})
    for (const double times_brittle : {1.2, 3.0, 20.0}) {
      Bench b = pair({1e9, 2.6, kSigma, 1e300, {}});
      const Softening s = soften(b, stiffness(b), times_brittle);
      b.load(0.0, false);
      double work = 0.0, before = 0.0, last = 0.0;
      for (int k = 1; k <= steps; ++k) {
        const double u = 1.1 * s.u_f * k / steps, now = pulled_to(b, u);
        work += 0.5 * (before + now) * (u - last);
        before = now, last = u;
      }
      EXPECT_EQ(b.pairs[0].alive, 0.0);
      EXPECT_NEAR(b.pairs[0].lost / s.energy, 1.0, 1e-9) << steps << ' ' << times_brittle;
      // the trapezoid rule misses the two kinks
      if (steps == 1000) {
        EXPECT_NEAR(work / s.energy, 1.0, 1e-3) << times_brittle;
      }
    }
}

// Tension and shear at once in a fixed proportion: work = what is lost, at the end of the road.
TEST_P(Options, softening_under_mixed_load_balances_its_energy) {
  for (const double angle : {0.3, 0.9, 1.4}) {
    Bench b = pair({1e9, 2.6, kSigma, 0.6 * kSigma, {}});
    const Softening s = soften(b, stiffness(b), 4.0);
    b.load(0.0, false);
    const int steps = 4000;
    double work = 0.0;
    Vec3 place = b.grains[1].x, force{0, 0, 0};
    for (int k = 1; k <= steps && b.pairs[0].alive != 0.0; ++k) {
      const double u = 4.0 * s.u_f * k / steps;
      const Vec3 next{2e-3 + u * std::cos(angle), u * std::sin(angle), 0};
      const Vec3 now = moved_to(b, next);
      work -= 0.5 * dot(force + now, next - place);
      place = next, force = now;
      ASSERT_NEAR(b.potential_energy() + b.lost_energy(), work, 2e-3 * s.energy) << angle << ' ' << k;
    }
    EXPECT_EQ(b.pairs[0].alive, 0.0);
    EXPECT_GT(work, 2.0 * s.energy / 4.0);
  }
}

TEST_P(Options, damaged_bond_unloads_and_reloads_along_its_secant) {
  Bench b = pair({1e9, 2.6, kSigma, 1e300, {}});
  const Softening s = soften(b, stiffness(b), 3.0);
  b.load(0.0, false);
  const double turn = 2.0 * s.u_c, at_turn = pulled_to(b, turn);
  EXPECT_NEAR(at_turn, 0.5 * s.k * s.u_c, 1e-9 * s.k * s.u_c);  // (3 - 2)/(3 - 1)
  const double stored = b.potential_energy(), lost = b.lost_energy();
  EXPECT_NEAR(stored, 0.5 * at_turn * turn, 1e-9 * stored);
  for (const double part : {0.9, 0.5, 0.01, 0.3, 0.8, 1.0}) {
    EXPECT_NEAR(pulled_to(b, part * turn), part * at_turn, 1e-9 * at_turn);
    EXPECT_EQ(b.lost_energy(), lost);
  }
  EXPECT_NEAR(b.potential_energy(), stored, 1e-12 * stored);
  // and goes on along the line
  EXPECT_NEAR(pulled_to(b, 2.5 * s.u_c), 0.25 * s.k * s.u_c, 1e-9 * s.k * s.u_c);
}

TEST_P(Options, damage_never_heals_and_spares_compression) {
  Bench b = pair({1e9, 2.6, kSigma, 1e300, {}});
  const Softening s = soften(b, stiffness(b), 3.0);
  b.load(0.0, false);
  pulled_to(b, 2.0 * s.u_c);
  const double share = b.carried(b.pairs[0]);
  EXPECT_NEAR(share, 0.25, 1e-9);  // (3/2 - 1)/(3 - 1)
  for (const double u : {-2.0, -1.0, -1e-9}) {
    EXPECT_NEAR(pulled_to(b, u * s.u_c), u * s.k * s.u_c, 1e-9 * s.k * s.u_c) << "a closed crack carries all";
    EXPECT_EQ(b.carried(b.pairs[0]), share);
    EXPECT_NEAR(b.potential_energy(), 0.5 * s.k * u * u * s.u_c * s.u_c, 1e-9 * s.energy);
  }
  EXPECT_NEAR(pulled_to(b, 1e-3 * s.u_c), share * 1e-3 * s.k * s.u_c, 1e-12 * s.k * s.u_c);
  EXPECT_EQ(b.carried(b.pairs[0]), share);
  // shear is damaged, opened or closed
  const double push = 1e-3 * s.u_c, u = 1e-3 * s.u_c;
  moved_to(b, {2e-3 - push, 0, 0});
  EXPECT_NEAR(-moved_to(b, {2e-3 - push, u, 0}).y / (share * stiffness(b).shear * u), 1.0, 1e-3);
}

// In shear the same line: nothing is left at s_f times the strength.
TEST_P(Options, softening_in_shear) {
  Bench b = pair({1e9, 2.6, 1e300, kSigma, {}});
  b.pairs[0].failure = 2.5;
  const BondStiffness k = stiffness(b);
  const double peak = kSigma * b.section(b.pairs[0]).area, u_c = peak / k.shear;
  b.load(0.0, false);
  for (const double s : {0.5, 0.99, 1.5, 2.0, 2.49}) {
    const double carried = s < 1.0 ? s : (2.5 - s) / 1.5;
    // the slide turns the bond by u/l and stretches it by u^2/(2 l)
    EXPECT_NEAR(-moved_to(b, {2e-3, s * u_c, 0}).y / peak, carried, 0.02) << s;
    EXPECT_EQ(b.pairs[0].alive, 1.0);
  }
  moved_to(b, {2e-3, 2.51 * u_c, 0});
  EXPECT_EQ(b.pairs[0].fate, BondFate::broken_in_shear);
  EXPECT_NEAR(b.pairs[0].lost / (0.5 * 2.5 * peak * u_c), 1.0, 0.05);
}

// Pressed while its shear softens away: what it carried in compression goes too, and is counted
// (but for a beam, whose contact takes it over).
TEST_P(Options, compression_of_a_bond_that_softens_away_is_lost) {
  if (law().name == "beam") return;
  Bench b = pair({1e9, 2.6, 1e300, kSigma, {}});
  b.pairs[0].failure = 2.5;
  const BondStiffness k = stiffness(b);
  const double u_c = kSigma * b.section(b.pairs[0]).area / k.shear, push = 0.3 * u_c;
  b.load(0.0, false);
  moved_to(b, {2e-3 - push, 0, 0});
  double work = 0.0;
  const Vec3 start = b.grains[1].x;
  Vec3 before = b.grains[1].f;
  const double pressed = b.potential_energy();
  EXPECT_NEAR(pressed, 0.5 * k.normal * push * push, 1e-6 * pressed);
  for (int n = 1; b.pairs[0].alive != 0.0; ++n) {
    const Vec3 at = b.grains[1].x, now = moved_to(b, start + Vec3{0, 1e-3 * n * u_c, 0});
    work -= 0.5 * dot(before + now, b.grains[1].x - at);
    before = now;
  }
  EXPECT_EQ(b.potential_energy(), 0.0);
  EXPECT_NEAR(b.lost_energy() / (work + pressed), 1.0, 1e-3);
}

// G_f below what the bond stores at its strength: it can't fall that steeply, it breaks there.
TEST_P(Options, below_the_brittle_limit_it_is_brittle) {
  for (const double times_brittle : {0.1, 0.99, 1.0}) {
    Bench b = pair({1e9, 2.6, kSigma, 1e300, {}}), plain = b;
    plain.options = false;
    const Softening s = soften(b, stiffness(b), times_brittle);
    EXPECT_EQ(b.pairs[0].failure, 1.0);
    b.load(0.0, false), plain.load(0.0, false);
    for (int k = 1; k <= 120; ++k) {
      const double u = 0.01 * k * s.u_c;
      EXPECT_EQ(pulled_to(b, u), pulled_to(plain, u)) << k;
      EXPECT_EQ(b.pairs[0].fate, plain.pairs[0].fate) << k;
      EXPECT_EQ(b.pairs[0].alive, k < 100 ? 1.0 : 0.0) << k;
    }
    EXPECT_EQ(b.lost_energy(), 0.0);  // a break isn't damping or softening
  }
}

// Both strengths are passed in one step, that of shear by more.
TEST_P(Options, neutral_options_name_the_same_mode) {
  Bench b = pair({1e9, 2.6, kSigma, 0.1 * kSigma, {}}), plain = b;
  plain.options = false;
  const double u = 3.0 * kSigma * b.section(b.pairs[0]).area / stiffness(b).normal;
  moved_to(b, {2e-3 + u, 2.0 * u, 0}), moved_to(plain, {2e-3 + u, 2.0 * u, 0});
  EXPECT_EQ(plain.pairs[0].alive, 0.0);
  EXPECT_EQ(b.pairs[0].alive, 0.0);
  EXPECT_EQ(b.pairs[0].fate, plain.pairs[0].fate);
}

TEST_P(Options, tension_modulus_acts_in_tension_alone) {
  for (const double ratio : {0.25, 1.0, 3.0}) {
    Bench b = pair();
    b.pairs[0].tension = ratio;
    const double k = stiffness(b).normal, u = 1e-7;
    b.load(0.0, false);
    double work = 0.0, before = 0.0, last = 0.0;
    const int steps = 400;  // out, back, in, back: a closed cycle whose kink lies on a step
    for (int n = 1; n <= steps; ++n) {
      const double x = u * std::sin(2.0 * kPi * n / steps), now = pulled_to(b, x);
      EXPECT_NEAR(now, (x > 0.0 ? ratio : 1.0) * k * x, 1e-8 * k * u);
      EXPECT_NEAR(b.potential_energy(), 0.5 * now * x, 1e-8 * k * u * u);
      work += 0.5 * (before + now) * (x - last);
      before = now, last = x;
    }
    EXPECT_LT(std::fabs(work), 1e-9 * k * u * u);
    // continuous at the length of bonding
    EXPECT_NEAR(pulled_to(b, 1e-6 * u), 0.0, 1e-5 * k * u);
    EXPECT_NEAR(pulled_to(b, -1e-6 * u), 0.0, 1e-5 * k * u);
    EXPECT_LT(std::fabs(pulled_to(b, -u) / pulled_to(b, u) * ratio + 1.0), 1e-8);
  }
}

// The criterion sees the stress that the bond carries, so a soft bond breaks at a larger stretch; and
// with softening the fracture energy is that of the stiffness in tension.
TEST_P(Options, tension_modulus_and_strength) {
  for (const double ratio : {0.5, 2.0}) {
    Bench b = pair({1e9, 2.6, kSigma, 1e300, {}});
    const double area = b.section(b.pairs[0]).area, k = ratio * stiffness(b).normal;
    b.pairs[0].tension = ratio;
    const double G_f = 3.0 * 0.5 * kSigma * kSigma * area / k, u_c = kSigma * area / k;
    Bench brittle = b;
    brittle.load(0.0, false), b.load(0.0, false);
    pulled_to(brittle, (1.0 - 1e-9) * u_c);
    EXPECT_EQ(brittle.pairs[0].alive, 1.0);
    pulled_to(brittle, (1.0 + 1e-9) * u_c);
    EXPECT_EQ(brittle.pairs[0].alive, 0.0);
    b.pairs[0].failure = failure_factor(G_f, k / area, kSigma);
    for (int n = 1; n <= 50; ++n) pulled_to(b, 0.07 * n * u_c);
    EXPECT_EQ(b.pairs[0].alive, 0.0);
    EXPECT_NEAR(b.pairs[0].lost / (G_f * area), 1.0, 1e-9);
  }
}

// Contact left out = contact of no stiffness; neutral options = no options. Bit for bit, breaks too.
TEST_P(Options, cost_nothing_when_off) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> u(-1, 1);
  int broken = 0;
  for (int trial = 0; trial < 60; ++trial) {
    BondCase c{1e9, 2.6, kSigma, 0.8 * kSigma, {trial % 2 ? 2e9 : 0.0, 2.0, 0.5}};
    Bench plain = pair(c, 0.8e-3);
    plain.options = false;
    for (Grain &g : plain.grains) {
      g.v = 5.0 * Vec3{u(random), u(random), flat() ? 0.0 : u(random)};
      g.w = 2000.0 * Vec3{flat() ? 0.0 : u(random), flat() ? 0.0 : u(random), u(random)};
    }
    Bench neutral = plain, apart = plain;
    neutral.options = true;
    apart.contacts = false;
    plain.load(0.0, false), neutral.load(0.0, false), apart.load(0.0, false);
    for (int k = 0; k < 300; ++k) {
      for (Bench *b : {&plain, &neutral, &apart}) b->step(3e-8);
      for (Bench *b : {&neutral, &apart}) {
        if (b == &apart && trial % 2) continue;
        for (int g = 0; g < 2; ++g) {
          // to rounding: the compiler may fuse a product and a sum in one variant and not in the other
          ASSERT_LE(length(plain.grains[g].x - b->grains[g].x), 1e-14 * length(plain.grains[g].x) + 1e-17) << trial << ' ' << k;
          ASSERT_LE(length(plain.grains[g].w - b->grains[g].w), 1e-9) << trial << ' ' << k;
        }
        ASSERT_EQ(plain.pairs[0].fate, b->pairs[0].fate) << trial << ' ' << k;
        ASSERT_NEAR(plain.pairs[0].sigma, b->pairs[0].sigma, 1e-10 * kSigma);
        ASSERT_NEAR(plain.pairs[0].tau, b->pairs[0].tau, 1e-10 * kSigma);
      }
    }
    EXPECT_EQ(neutral.lost_energy(), 0.0);
    broken += plain.pairs[0].alive == 0.0;
  }
  EXPECT_GT(broken, 10);
}

INSTANTIATE_TEST_SUITE_P(Laws, Options, testing::ValuesIn(laws_in_space_and_plane()),
                         [](const auto &info) { return name_of(info.param); });
