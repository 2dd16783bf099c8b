// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a break leaves, the pitfalls about a bond's history (PHYSICS.md 3.1), blocks of lanes, and
// random states.
#include <gtest/gtest.h>

#include <random>

#include "chain_testbench.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

constexpr double kE = 1e12;
constexpr double kUnit = 10e6 * 2e-3 / kE;  // stretch of the bond at its strength, m

Bench reference_bond() {
  Bench b;
  b.add({0, 0, 0}, 1e-3, 2500, true);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  ParallelParameters p;
  p.modulus = kE;
  p.ratio = 2.6;
  PairRow &row = b.bond(0, 1, p);
  row.sigma_c = 10e6;
  row.tau_c = 8e6;
  return b;
}

}  // namespace

// Named after the flaw: an incremental normal force drifts with the step. After thousands of steps of
// up to 0.1 mm there and back (kilonewtons) nothing is left along the bond.
TEST(Pitfall, incremental_normal_force_drifts) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1, 1);
  Bench b = reference_bond();
  b.pairs[0].sigma_c = b.pairs[0].tau_c = 1e300;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 next = {2e-3 + 1e-4 * u(random), 5e-4 * u(random), 5e-4 * u(random)};
    b.prescribe(1e-7, [&](int g) { return g ? next : Vec3{0, 0, 0}; }, [](int) { return Vec3{0, 0, 0}; });
  }
  b.prescribe(1e-7, [](int g) { return Vec3{2e-3 * g, 0, 0}; }, [](int) { return Vec3{0, 0, 0}; });
  EXPECT_EQ(b.normal_force(b.pairs[0]), 0.0);
  EXPECT_LT(std::fabs(b.pairs[0].force.x), 1e-15 * length(b.pairs[0].fs));  // the shear force's rounding
}

// Named after the flaw: strength is looked at once a step, so it overshoots by the load's growth in
// a step, which falls with the step.
TEST(Pitfall, criterion_once_a_step_overshoots_by_one_step_at_most) {
  for (const int steps : {50, 500}) {
    Bench b = reference_bond();
    const double rate = kUnit / steps;  // sigma_c is reached after `steps`
    double stress = 0.0;
    for (int k = 1; k <= 2 * steps && b.pairs[0].alive != 0.0; ++k) {
      b.prescribe(1e-7, [&](int g) { return Vec3{g * (2e-3 + rate * (k - 0.3)), 0, 0}; }, [](int) { return Vec3{0, 0, 0}; });
      stress = b.pairs[0].sigma;
    }
    EXPECT_EQ(b.pairs[0].fate, BondFate::broken_in_tension);
    EXPECT_GE(stress, 10e6);
    EXPECT_LT(stress, 10e6 * (1 + 1.0 / steps));
  }
}

// Named after the flaw: a broken bond's shear force or moments live on in the contact.
TEST(Pitfall, bond_force_is_dropped_not_transferred) {
  for (const bool flat : {false, true}) {
    Bench b(flat, 3e-3);
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({1.99e-3, 0, 0}, 1e-3, 2500);
    ParallelParameters p;
    p.modulus = 1e9;
    b.bond(0, 1, p, {2e9, 2.0, 0.5});
    PairRow &row = b.pairs[0];
    row.rest -= 1e-6;        // the bond is pulled,
    row.reference += 1e-5;  // the contact pressed
    row.fs = flat ? Vec3{5, 0, 0} : Vec3{0, 3, 4};
    row.mb = flat ? Vec3{1e-3, 0, 0} : Vec3{0, 1e-3, 0};
    row.mt = flat ? 0 : 1e-3;
    row.cs = flat ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    row.tau_c = 1.0;  // breaks now
    Bench alone = b;  // the same contact without the bond
    PairRow &other = alone.pairs[0];
    other.alive = other.mt = 0.0;
    other.fs = other.mb = {0, 0, 0};
    other.rest = alone.distance(0, 1);
    b.load(1e-7);
    alone.load(1e-7);
    EXPECT_EQ(row.fate, BondFate::broken_in_shear);
    for (int g = 0; g < 2; ++g) {  // exactly: breaking takes the bond's own load and nothing else
      EXPECT_EQ(length(b.grains[g].f - alone.grains[g].f), 0.0);
      EXPECT_EQ(length(b.grains[g].t - alone.grains[g].t), 0.0);
    }
    EXPECT_GT(length(b.grains[0].f), 1.0);
    EXPECT_EQ(length(b.pairs[0].fs) + length(b.pairs[0].mb) + std::fabs(b.pairs[0].mt), 0.0);
    // and it stays away
    for (int k = 0; k < 100; ++k) {
      b.grains[1].v = alone.grains[1].v = {0, 1e-3, 0};
      b.grains[1].x.y = alone.grains[1].x.y += 1e-10;
      b.load(1e-7);
      alone.load(1e-7);
    }
    EXPECT_EQ(length(b.grains[0].f - alone.grains[0].f), 0.0);
    EXPECT_EQ(b.pairs[0].fate, BondFate::intact);  // reported once
    EXPECT_EQ(b.pairs[0].sigma, 0.0);
  }
}

// History never advances during the set-up of a run, and nothing breaks in it.
TEST(Pitfall, set_up_changes_nothing) {
  for (const bool flat : {false, true}) {
    Bench b(flat, 3e-3);
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({2.01e-3, 0, 0}, 1e-3, 2500);
    ParallelParameters p;
    p.modulus = 1e9;
    b.bond(0, 1, p, {2e9, 2.0, 0.5});
    PairRow &row = b.pairs[0];
    row.rest = 2e-3;
    row.fs = flat ? Vec3{5, 0, 0} : Vec3{0, 3, 4};
    row.mb = flat ? Vec3{1e-3, 0, 0} : Vec3{0, 1e-3, 0};
    row.sigma_c = row.tau_c = 1.0;  // far beyond its strength
    const PairRow before = row;
    b.load(0.0, false);
    EXPECT_EQ(row.alive, 1.0);
    EXPECT_EQ(row.fate, BondFate::intact);
    EXPECT_EQ(length(row.fs - before.fs) + length(row.mb - before.mb), 0.0);
    EXPECT_GT(length(b.grains[0].f), 1.0);  // loads are there
  }
}

// A lane's bits don't depend on its place in the block or on its neighbours.
TEST(Block, lanes_do_not_depend_on_their_place) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const bool flat : {false, true}) {
    Bench many(flat, 2e-3);
    const int pairs = 150;  // two whole blocks and a part
    for (int k = 0; k < pairs; ++k) {
      many.add({5e-3 * k, 0, 0}, 1e-3 * (1 + 0.3 * u(random)), 2500);
      many.add({5e-3 * k + 2e-3, 1e-4 * u(random), flat ? 0 : 1e-4 * u(random)}, 1e-3, 2500);
    }
    ParallelParameters p;
    p.modulus = 1e9;
    for (int k = 0; k < pairs; ++k) {
      PairRow &row = many.bond(2 * k, 2 * k + 1, p, {1e9, 2.0, 0.4});
      row.sigma_c = row.tau_c = 1e6;
    }
    for (Grain &g : many.grains) {
      g.v = 2.0 * Vec3{u(random), u(random), flat ? 0 : u(random)};
      g.w = 500.0 * Vec3{flat ? 0 : u(random), flat ? 0 : u(random), u(random)};
    }
    std::vector<Bench> single;
    for (int k = 0; k < pairs; ++k) {
      Bench one(flat, 2e-3);
      one.grains = {many.grains[2 * k], many.grains[2 * k + 1]};
      one.pairs = {many.pairs[k]};
      one.pairs[0].i = 0, one.pairs[0].j = 1;
      single.push_back(one);
    }
    many.load(0.0, false);
    for (int s = 0; s < 30; ++s) many.step(5e-8);
    int broken = 0;
    for (int k = 0; k < pairs; ++k) {
      single[k].load(0.0, false);
      for (int s = 0; s < 30; ++s) single[k].step(5e-8);
      for (int g = 0; g < 2; ++g) {
        EXPECT_EQ(length(single[k].grains[g].x - many.grains[2 * k + g].x), 0.0);
        EXPECT_EQ(length(single[k].grains[g].t - many.grains[2 * k + g].t), 0.0);
      }
      broken += many.pairs[k].alive == 0.0;
    }
    EXPECT_GT(broken, 10);
    EXPECT_LT(broken, pairs);
  }
}

// Random states, large and small: always numbers, newton's third law, state zero once broken.
TEST(Fuzz, no_state_gives_nan) {
  std::mt19937 random(101);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 3000; ++trial) {
    const bool flat = trial % 2;
    const double scale = std::pow(10.0, 3 * u(random));
    Bench b(flat, 1e-3 * scale);
    const Vec3 direction{u(random), u(random), flat ? 0.0 : u(random)};
    b.add({0, 0, 0}, 1e-3 * scale, 2500);
    b.add((1.5e-3 * scale * (1 + 0.5 * u(random))) * unit(direction), 0.5e-3 * scale, 2500);
    ParallelParameters p;
    p.modulus = std::pow(10.0, 9 + 2 * u(random));
    p.ratio = std::pow(10.0, u(random));
    p.beta = trial % 5 ? 1.0 : 0.0;
    p.lambda = 1.0 + 0.5 * u(random);
    p.tan_phi = trial % 7 ? 0.0 : 1.0;
    const double modulus = trial % 3 ? 1e9 : 0.0;
    PairRow &row = b.bond(0, 1, p, {modulus, 2.0, trial % 4 ? 0.5 : 0.0});
    row.sigma_c = std::pow(10.0, 7 + 2 * u(random));
    row.tau_c = std::pow(10.0, 7 + 2 * u(random));
    b.load(0.0, false);
    for (int k = 0; k < 20; ++k) {
      const double speed = std::pow(10.0, 1 + 2 * u(random)), dt = 1e-7 * scale;
      for (Grain &g : b.grains) {
        g.v = speed * Vec3{u(random), u(random), flat ? 0.0 : u(random)};
        g.w = (speed / scale * 1e2) * Vec3{flat ? 0.0 : u(random), flat ? 0.0 : u(random), u(random)};
        g.x = g.x + dt * g.v;
      }
      const bool was_alive = b.pairs[0].alive != 0.0;
      const Bench before = b;
      b.load(dt);
      const PairRow &r = b.pairs[0];
      ASSERT_TRUE(std::isfinite(length(b.grains[0].f) + length(b.grains[0].t) + length(b.grains[1].t)));
      ASSERT_EQ(length(b.grains[0].f + b.grains[1].f), 0.0);
      if (r.alive == 0.0) {
        ASSERT_EQ(length(r.fs) + length(r.mb) + std::fabs(r.mt), 0.0);
        ASSERT_EQ(r.fate == BondFate::intact, !was_alive);
      } else {
        ASSERT_LT(r.sigma, r.sigma_c);
        ASSERT_EQ(r.fate, BondFate::intact);
      }
      if (was_alive && r.alive == 0.0) {
        // the same step without its strength keeps at least as much energy
        Bench strong = before;
        strong.pairs[0].sigma_c = strong.pairs[0].tau_c = 1e300;
        strong.load(dt);
        ASSERT_LE(b.potential_energy(), strong.potential_energy());
      }
    }
  }
}
