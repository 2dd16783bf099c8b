// SPDX-License-Identifier: GPL-2.0-or-later
//
// A test named after each bug that PHYSICS.md 3.0-3.2 reports from a public code and that any bond law
// could have, for every law of law_cases.h. Bonds cut at the edges of a periodic box, and bonds that
// break on one rank only, are tests of the engine (tests/engine/periodic_test.cpp, ranks_test.cpp); what
// one law alone can get wrong is in its own tests.
#include <gtest/gtest.h>

#include <random>

#include "law_cases.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

constexpr double kE = 1e9;  // Pa

class BugsOfOthers : public testing::TestWithParam<LawAndSpace> {
 protected:
  const LawCase &law() const { return GetParam()(); }
  bool flat() const { return GetParam().flat; }
  Bench pair(double distance = 2e-3, double r2 = 1e-3, BondCase c = {}) const {
    c.modulus = kE;
    Bench b(flat(), 4e-3);
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({distance, 0, 0}, r2, 2500);
    law().bond(b, 0, 1, c);
    b.load(0.0, false);
    return b;
  }
};

// One step: grain 1 goes to x, the grains turn by a and c.
void go(Bench &b, Vec3 x, Vec3 a = {0, 0, 0}, Vec3 c = {0, 0, 0}) {
  b.prescribe(1e-7, [&](int g) { return g ? x : b.grains[0].x; }, [&](int g) { return g ? c : a; });
}
// The whole turns about z once, in `steps`; `x` is where grain 1 is before.
void turn_once(Bench &b, int steps) {
  const Vec3 x0 = b.grains[0].x, x1 = b.grains[1].x, spin{0, 0, 2.0 * kPi / steps};
  for (int k = 1; k <= steps; ++k)
    b.prescribe(1e-7, [&](int g) { return x0 + rotated(g ? x1 - x0 : Vec3{0, 0, 0}, static_cast<double>(k) * spin); },
                [&](int) { return spin; });
}

}  // namespace

// Loss of (angle^2)/2 a step: 2 % of the force in one turn of 1000 steps.
TEST_P(BugsOfOthers, projection_without_renormalisation_relaxes_a_turning_bond) {
  Bench b = pair();
  go(b, {2e-3, 5e-7, 0}, {0, 0, -1e-4}, {0, 0, 2e-4});
  const double force = length(b.grains[1].f), ti = b.grains[0].t.z, tj = b.grains[1].t.z;
  turn_once(b, 1000);
  EXPECT_NEAR(length(b.grains[1].f) / force, 1.0, 1e-5);
  EXPECT_NEAR(b.grains[0].t.z / ti, 1.0, 1e-5);
  EXPECT_NEAR(b.grains[1].t.z / tj, 1.0, 1e-5);
}

// (r1 w1 - r2 w2)/r is half the rotation for equal radii, and follows the whole for unequal ones.
TEST_P(BugsOfOthers, radius_weighted_spins_halve_the_rotation) {
  Bench b = pair();
  const double angle = 1e-6;
  go(b, {2e-3, 0, 0}, {0, 0, -0.5 * angle}, {0, 0, 0.5 * angle});
  const double EI_l = kE * b.section(b.pairs[0]).bend / 2e-3;
  EXPECT_NEAR(b.grains[0].t.z / (EI_l * angle), 1.0, 1e-6);
  EXPECT_NEAR(b.grains[1].t.z / (-EI_l * angle), 1.0, 1e-6);
  if (!flat()) {
    Bench c = pair();
    go(c, {2e-3, 0, 0}, {0, 0, 0}, {angle, 0, 0});
    EXPECT_NEAR(c.grains[0].t.x / (kE / 2.6 * c.section(c.pairs[0]).twist / 2e-3 * angle), 1.0, 1e-6);
  }
  Bench unequal = pair(1.5e-3, 0.5e-3);
  turn_once(unequal, 4000);
  EXPECT_LT(length(unequal.grains[0].t) + length(unequal.grains[1].t), 1e-7 * EI_l);
}

// |F_n| in the criterion.
TEST_P(BugsOfOthers, size_of_the_normal_force_breaks_bonds_in_compression) {
  Bench b = pair(2e-3, 1e-3, {kE, 2.6, 5e6, 4e6, {}});
  for (int k = 1; k <= 50; ++k) go(b, {2e-3 * (1.0 - 1e-3 * k), 0, 0});  // ten times the strength
  EXPECT_EQ(b.pairs[0].alive, 1.0);
  EXPECT_GT(b.grains[1].f.x, 9.0 * 5e6 * b.section(b.pairs[0]).area);
}

TEST_P(BugsOfOthers, arms_of_both_radii_on_a_bond_of_another_length) {
  for (const double distance : {1.4e-3, 1.7e-3, 2.2e-3}) {
    Bench b = pair(distance, 0.7e-3);
    go(b, {distance, 1e-6, 0}, {0, 0, 1e-4}, {0, 0, -3e-4});
    const Vec3 d = b.grains[1].x, sum = b.grains[0].t + b.grains[1].t - cross(d, b.grains[0].f);
    EXPECT_GT(length(b.grains[0].f), 0.1);
    EXPECT_LT(length(sum), 1e-12 * (length(b.grains[0].t) + length(b.grains[1].t)));
  }
}

TEST_P(BugsOfOthers, incremental_normal_force_drifts) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1, 1);
  Bench b = pair();
  for (int k = 0; k < 3000; ++k) go(b, {2e-3 + 1e-4 * u(random), 5e-4 * u(random), flat() ? 0.0 : 5e-4 * u(random)});
  go(b, {2e-3, 0, 0});
  EXPECT_LT(std::fabs(b.grains[1].f.x), 1e-9);
}

// Rest length R1 + R2 whatever the distance is: the act of bonding loads bond and contact.
TEST_P(BugsOfOthers, bonding_at_a_gap_or_overlap_loads_the_pair) {
  for (const double distance : {1.9e-3, 2e-3, 2.15e-3}) {
    Bench b = pair(distance, 1e-3, {kE, 2.6, 1e300, 1e300, {5e9, 2.0, 0.5}});
    go(b, {distance, 0, 0});
    EXPECT_LT(length(b.grains[0].f), 1e-8);
    EXPECT_LT(length(b.grains[0].t) + length(b.grains[1].t), 1e-11);
  }
}

// (r_out - r_in) of a hollow section, or the mean radius, in place of the outer one.
TEST_P(BugsOfOthers, extreme_fibre_is_not_at_the_outer_radius) {
  Bench b = pair();
  const double angle = 1e-4;
  go(b, {2e-3, 0, 0}, {0, 0, -0.5 * angle}, {0, 0, 0.5 * angle});
  EXPECT_NEAR(b.pairs[0].sigma / (kE * angle / 2e-3 * 1e-3), 1.0, 1e-6);  // E kappa R
}

TEST_P(BugsOfOthers, criterion_once_a_step_overshoots_by_more_than_one_step) {
  for (const int steps : {50, 500}) {
    Bench b = pair(2e-3, 1e-3, {kE, 2.6, 5e6, 1e300, {}});
    double stress = 0.0;
    for (int k = 1; b.pairs[0].alive != 0.0 && k <= 2 * steps; ++k) {
      go(b, {2e-3 * (1.0 + 5e-3 * (k - 0.3) / steps), 0, 0});
      stress = b.pairs[0].sigma;
    }
    EXPECT_EQ(b.pairs[0].fate, BondFate::broken_in_tension);
    EXPECT_GE(stress, 5e6);
    EXPECT_LT(stress, 5e6 * (1.0 + 1.0 / steps));
  }
}

// The bond's shear force and moments go with the bond, they are not handed to the contact.
TEST_P(BugsOfOthers, broken_bond_leaves_its_shear_force_in_the_contact) {
  Bench b = pair(2e-3, 1e-3, {kE, 2.6, 1e300, 4e6, {2e9, 2.0, 0.5}});
  const double press = 1e-7, slip = 4e6 / (kE / 2.6 / 2e-3);  // m, at the strength
  go(b, {2e-3 - press, 0, 0});
  for (int k = 1; b.pairs[0].alive != 0.0 && k < 1000; ++k) {
    const double a = 1.2e-3 * k * slip / 2e-3;  // about the first grain, at the same distance
    go(b, (2e-3 - press) * Vec3{std::cos(a), std::sin(a), 0});
  }
  ASSERT_EQ(b.pairs[0].alive, 0.0);
  // what is left is the contact: its normal force, and friction at most
  const Vec3 e = unit(b.grains[1].x);
  const double normal = dot(b.grains[1].f, e), shear = length(b.grains[1].f - normal * e);
  EXPECT_NEAR(normal / (b.pairs[0].kn * press), 1.0, 1e-6);
  EXPECT_LE(shear, 0.5 * normal * (1.0 + 1e-12));
  EXPECT_GT(4e6 * b.section(b.pairs[0]).area, 10.0 * shear);  // the bond carried much more
}

// Shear without minus half the bend: the force from a turn isn't the torque from a move.
TEST_P(BugsOfOthers, shear_that_forgets_half_the_bend_is_not_reciprocal) {
  const double u = 1e-9, angle = 1e-6;
  Bench move = pair(), turn = pair(), turn_i = pair();
  go(move, {2e-3, u, 0});
  go(turn, {2e-3, 0, 0}, {0, 0, 0}, {0, 0, angle});
  go(turn_i, {2e-3, 0, 0}, {0, 0, angle}, {0, 0, 0});
  EXPECT_NEAR(move.grains[1].t.z / u / (turn.grains[1].f.y / angle), 1.0, 1e-5);
  EXPECT_NEAR(move.grains[0].t.z / u / (turn_i.grains[1].f.y / angle), 1.0, 1e-5);
  EXPECT_NEAR(turn.grains[0].t.z / turn_i.grains[1].t.z, 1.0, 1e-5);
}

// arccos of a number close to one: a bend of 1e-9 is rounded away.
TEST_P(BugsOfOthers, arccos_loses_small_bends) {
  for (const double angle : {1e-7, 1e-9}) {
    Bench b = pair();
    go(b, {2e-3, 0, 0}, {0, 0, -0.5 * angle}, {0, 0, 0.5 * angle});
    EXPECT_NEAR(b.grains[0].t.z / (kE * b.section(b.pairs[0]).bend / 2e-3 * angle), 1.0, 1e-5) << angle;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, BugsOfOthers, testing::ValuesIn(laws_in_space_and_plane()),
                         [](const auto &info) { return name_of(info.param); });
