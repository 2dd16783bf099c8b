// SPDX-License-Identifier: GPL-2.0-or-later
//
// Energy of Norton bonds: work in = elastic + creep + yield + damping + softening (PHYSICS.md 2.5, item
// 5; 3.3), the shared options, and random states, in which nothing may make energy.
#include <gtest/gtest.h>

#include <random>

#include "norton_testbench.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

NortonType material(double m, double rate_at_1mpa) {
  NortonType t;
  t.modulus = 1e9;
  t.exponent = m;
  t.log_rate = log_rate_at(rate_at_1mpa, 1e6, m);
  return t;
}

NortonBench one_bond(const NortonType &t, bool flat = false) {
  NortonBench b(t, flat, 3e-3);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  b.norton_bond(0, 1);
  b.load(0.0, false);
  return b;
}

// Work of the ends by the mean of the loads before and after a step.
struct Path {
  double work = 0.0, peak = 0.0, off = 0.0;
};
// Grain 1 goes out and back along `swing` and turns with it, in `steps` calls that last `time`.
Path path(NortonBench b, Vec3 swing, Vec3 turn, int steps, double time) {
  const Vec3 x0 = b.grains[1].x;
  b.norton->time = time / steps;
  const double start = b.potential_energy() + b.dissipated();
  Path p;
  for (int k = 1; k <= steps; ++k) {
    const auto part = [&](int n) { return std::sin(2 * kPi * n / steps); };
    const Grain before = b.grains[1];
    const double now = part(k), gone = part(k - 1);
    b.prescribe(1.0, [&](int g) { return g ? x0 + now * swing : b.grains[0].x; },
                [&](int g) { return g ? (now - gone) * turn : Vec3{0, 0, 0}; });
    const Grain &after = b.grains[1];
    p.work -= 0.5 * dot(before.f + after.f, after.x - before.x) +
              0.5 * dot(before.t + after.t, (now - gone) * turn);
    p.peak = std::max(p.peak, b.potential_energy());
    p.off = std::max(p.off, std::fabs(p.work + start - b.potential_energy() - b.dissipated()));
  }
  return p;
}

}  // namespace

// Small motion: the balance closes at every step, however coarse the steps are for the creep. What is
// left is the bond's own turning, second order in the motion (5e-5), and the criss-cross of lateral
// motion; the sum of all ways to lose energy is far from it.
TEST(NortonEnergy, balance_closes_for_creep_and_yield) {
  for (const bool flat : {false, true})
    for (const CreepKind kind : {CreepKind::coupled, CreepKind::separate})
      for (const bool moments : {false, true}) {
        NortonType t = material(3, 1e-4);
        t.creep = kind;
        t.moments = moments;
        const double u = 4e-6;
        const Vec3 z{flat ? 0.0 : 1.0, 0, 0};
        for (const double yield : {kNever, 0.5e6}) {
          t.yield_t = t.yield_c = t.yield_s = yield;
          const Path pull = path(one_bond(t, flat), {u, 0, 0}, {0, 0, 0}, 100, 1e3);
          EXPECT_GT(pull.work, 0.1 * pull.peak);
          EXPECT_LT(pull.off, 1e-12 * pull.peak) << flat << moments;
          const Path all = path(one_bond(t, flat), {u, 0.5 * u, flat ? 0.0 : 0.3 * u},
                                {z.x * 1e-3, z.x * 2e-3, -1e-3}, 1000, 1e3);
          EXPECT_GT(all.work, 0.1 * all.peak);
          EXPECT_LT(all.off, 2e-3 * all.peak) << flat << moments;
        }
      }
}

// Damping and softening are in the balance too; another modulus in tension is elastic.
TEST(NortonEnergy, balance_closes_with_options) {
  for (const bool flat : {false, true}) {
    NortonBench b = one_bond(material(2, 1e-4), flat);
    b.norton->options = true;
    PairRow &row = b.pairs[0];
    row.own[NortonLaw::TENSION] = 0.6;
    row.own[NortonLaw::VISCOUS] = 0.3;
    const Path damped = path(b, {4e-6, 0, 0}, {0, 0, 0}, 400, 1e2);
    EXPECT_LT(damped.off, 3e-4 * damped.peak);  // the dashpot's force belongs to half a step ago
    row.own[NortonLaw::VISCOUS] = 0.0;
    row.own[NortonLaw::FAILURE] = 6.0;
    row.sigma_c = 0.6e6;
    const Path coarse = path(b, {4e-6, 0, 0}, {0, 0, 0}, 2000, 1e2);
    const Path fine = path(b, {4e-6, 0, 0}, {0, 0, 0}, 4000, 1e2);
    EXPECT_LT(fine.off, 0.7 * coarse.off);
    EXPECT_LT(fine.off, 2e-3 * fine.peak);
  }
}

// Softening under pull: the area below the curve is the fracture energy, also while it creeps slowly.
TEST(NortonEnergy, softening_takes_the_fracture_energy) {
  NortonBench b = one_bond(material(1, 1e-300));
  b.norton->options = true;
  PairRow &row = b.pairs[0];
  const double Gf = 20.0;
  row.sigma_c = 2e6;
  row.own[NortonLaw::FAILURE] = failure_factor(Gf, 1e9 / 2e-3, 2e6);
  EXPECT_NEAR(row.own[NortonLaw::FAILURE], 5.0, 1e-12);
  double work = 0.0, peak = 0.0;
  for (int k = 1; k <= 4000; ++k) {
    const double before = -b.grains[1].f.x, x = 2e-3 * (1 + 1.05e-2 * k / 4000);
    const double from = b.grains[1].x.x;
    b.prescribe(1.0, [&](int g) { return Vec3{g ? x : 0, 0, 0}; }, [](int) { return Vec3{0, 0, 0}; });
    work += 0.5 * (before - b.grains[1].f.x) * (x - from);
    peak = std::max(peak, -b.grains[1].f.x);
  }
  EXPECT_EQ(b.pairs[0].alive, 0.0);
  EXPECT_EQ(b.pairs[0].fate, BondFate::intact);  // it broke some steps ago
  EXPECT_NEAR(peak / (2e6 * kPi * 1e-6), 1.0, 2e-3);
  EXPECT_NEAR(work / (Gf * kPi * 1e-6), 1.0, 1e-3);
}

// Another modulus in tension; the force is continuous.
TEST(NortonEnergy, tension_modulus) {
  NortonBench b = one_bond(material(1, 1e-300));
  b.norton->options = true;
  b.pairs[0].own[NortonLaw::TENSION] = 0.25;
  for (const double e : {1e-3, -1e-3}) {
    b.prescribe(1.0, [&](int g) { return Vec3{g ? 2e-3 * (1 + e) : 0, 0, 0}; }, [](int) { return Vec3{0, 0, 0}; });
    EXPECT_NEAR(-b.grains[1].f.x, (e > 0 ? 0.25 : 1.0) * e * 1e9 * kPi * 1e-6, 1e-9);
  }
}

// A free chain that creeps and is damped by nothing else: kinetic + elastic + dissipated is constant.
TEST(NortonEnergy, free_chain_loses_what_creep_takes) {
  NortonType t = material(3, 30.0);
  t.moments = true;
  NortonBench b(t);
  for (int k = 0; k < 4; ++k) b.add({2e-3 * k, 0, 0}, 1e-3, 2500);
  for (int k = 0; k < 3; ++k) b.norton_bond(k, k + 1);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  for (Grain &g : b.grains) {
    g.v = 2.0 * Vec3{u(random), u(random), u(random)};
    g.w = 2000.0 * Vec3{u(random), u(random), u(random)};
  }
  const double dt = 2e-8;
  b.norton->time = dt;
  b.load(0.0, false);
  const double start = b.kinetic_energy() + b.potential_energy();
  double off = 0.0;
  for (int k = 0; k < 20000; ++k) {
    b.step(dt);
    off = std::max(off, std::fabs(b.kinetic_energy() + b.potential_energy() + b.dissipated() - start));
  }
  EXPECT_GT(b.dissipated(), 0.05 * start);
  EXPECT_LT(off, 5e-4 * start);
}

// Random materials, states and motions: always numbers; held still, a bond only loses energy; when one
// breaks, energy falls; the whole never rises.
TEST(NortonEnergy, nothing_makes_energy) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> u(-1, 1);
  int broken = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const bool flat = trial % 2;
    NortonType t = material(std::exp(1.2 * u(random)) + 0.2, std::pow(10.0, 3 + 4 * u(random)));
    t.creep = trial % 3 ? CreepKind::coupled : CreepKind::separate;
    t.moments = trial % 5 > 1;
    if (trial % 4 == 1) t.yield_t = t.yield_c = t.yield_s = 4e6;
    if (trial % 4 == 2) t.crush = 5e6;
    NortonBench b(t, flat, 2e-3);
    for (int k = 0; k < 6; ++k)
      b.add({1.9e-3 * k, 2e-4 * u(random), flat ? 0.0 : 2e-4 * u(random)}, 1e-3 * (1 + 0.2 * u(random)), 2500);
    b.norton->options = trial % 7 == 0;
    for (int k = 0; k < 5; ++k) {
      PairRow &row = b.norton_bond(k, k + 1, {2e9, 2.0, 0.5});
      row.sigma_c = 3e6 * (1.5 + u(random));
      row.tau_c = 3e6 * (1.5 + u(random));
      row.own[NortonLaw::TENSION] = 1.0 + 0.5 * u(random);
      row.own[NortonLaw::FAILURE] = 2.5 + 1.4 * u(random);
      row.own[NortonLaw::VISCOUS] = 0.5;
    }
    for (Grain &g : b.grains) {
      g.v = 4.0 * Vec3{u(random), u(random), flat ? 0.0 : u(random)};
      g.w = 2000.0 * Vec3{flat ? 0.0 : u(random), flat ? 0.0 : u(random), u(random)};
    }
    b.norton->every = 1 + trial % 3;
    const double dt = 2e-8;
    b.norton->time = dt;
    b.load(0.0, false);
    const double start = b.kinetic_energy() + b.potential_energy();
    for (int k = 0; k < 2000; ++k) {
      const double before = b.kinetic_energy() + b.potential_energy() + b.dissipated();
      b.step(dt);
      const double after = b.kinetic_energy() + b.potential_energy() + b.dissipated();
      ASSERT_TRUE(std::isfinite(after)) << trial;
      bool breaks = false;
      for (const PairRow &p : b.pairs) breaks = breaks || p.fate != BondFate::intact;
      if (breaks && !b.norton->options) {
        EXPECT_LT(after, before + 1e-6 * start) << "trial " << trial << " step " << k;
      }
      ASSERT_LT(after, 1.02 * start) << trial;
    }
    // held still: elastic energy only falls, and by what is booked
    double elastic = b.potential_energy(), booked = b.dissipated();
    const double rounding = 1e-13 * elastic + 1e-32;  // J; of positions, where little is left
    for (int k = 0; k < 30; ++k) {
      b.norton->time = std::pow(10.0, 6 * u(random));
      b.prescribe(1.0, [&](int g) { return b.grains[g].x; }, [](int) { return Vec3{0, 0, 0}; });
      const double now = b.potential_energy(), spent = b.dissipated();
      ASSERT_TRUE(std::isfinite(now) && std::isfinite(spent));
      EXPECT_LE(now, elastic + rounding) << trial;
      EXPECT_GE(spent, booked * (1 - 1e-14) - rounding) << trial;
      if (!b.norton->options) {
        EXPECT_NEAR(elastic - now, spent - booked, 1e-9 * elastic + 1e-12 * spent + rounding) << trial;
      }
      elastic = now, booked = spent;
    }
    for (const PairRow &p : b.pairs) broken += p.alive == 0.0;
  }
  EXPECT_GT(broken, 80);  // the fuzz does reach breaks
}

// Wild numbers straight into a block: no NaN comes out of numbers.
TEST(NortonEnergy, wild_states_stay_numbers) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 400; ++trial) {
    NortonType t = material(0.2 + 20 * std::fabs(u(random)), std::pow(10.0, 30 * u(random)));
    t.modulus = std::pow(10.0, 9 + 3 * u(random));
    t.moments = true;
    t.creep = trial % 2 ? CreepKind::coupled : CreepKind::separate;
    NortonBench b = one_bond(t, trial % 3 == 0);
    b.norton->options = trial % 4 == 0;
    b.pairs[0].own[NortonLaw::FAILURE] = 3.0;
    b.pairs[0].sigma_c = b.pairs[0].tau_c = 1e9;
    for (int k = 0; k < 20; ++k) {
      b.norton->time = std::pow(10.0, 200 * u(random));
      const Vec3 x{2e-3 * (1.3 + u(random)), 1e-3 * u(random), trial % 3 ? 1e-3 * u(random) : 0.0};
      b.prescribe(1.0, [&](int g) { return g ? x : Vec3{0, 0, 0}; },
                  [&](int) { return 0.3 * Vec3{trial % 3 ? u(random) : 0.0, trial % 3 ? u(random) : 0.0, u(random)}; });
      ASSERT_TRUE(std::isfinite(length(b.grains[1].f) + length(b.grains[1].t))) << trial << " " << k;
      ASSERT_TRUE(std::isfinite(b.pairs[0].own[NortonLaw::STRAIN] + b.dissipated())) << trial << " " << k;
    }
  }
}
