// SPDX-License-Identifier: GPL-2.0-or-later
#include "platen_law.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace bondlab;

const double pi = std::acos(-1.0);
const PlatenContact contact{1e6, 4e5, 0.5};
const Vec3 up{0, 1, 0};

TEST(PlatenLaw, StiffnessOfTheParticleAlone) {
  EXPECT_DOUBLE_EQ((PlatenStiffness{PlatenStiffness::Kind::modulus, 30e9, 0.0}.normal(2e-3)),
                   4 * 2e-3 * 30e9);
  EXPECT_DOUBLE_EQ((PlatenStiffness{PlatenStiffness::Kind::modulus, 30e9, 0.01}.normal(2e-3)),
                   2 * 0.01 * 30e9);
  EXPECT_DOUBLE_EQ((PlatenStiffness{PlatenStiffness::Kind::per_radius, pi * 10e9, 0}.normal(2e-3)),
                   pi * 10e9 * 2e-3);
}

TEST(PlatenLaw, NormalForceIsTotal) {
  PlatenHistory h;
  const PlatenForce f = platen_force(contact, 3e-6, up, {0, -1, 0}, true, h);
  EXPECT_DOUBLE_EQ(f.force.y, 3.0);
  EXPECT_EQ(f.force.x, 0.0);
  EXPECT_DOUBLE_EQ(f.energy, 0.5 * 3.0 * 3e-6);
}

TEST(PlatenLaw, ShearOpposesTheMotionAndIsLimitedByFriction) {
  PlatenHistory h;
  PlatenForce f = platen_force(contact, 1e-5, up, {2e-6, 0, 0}, true, h);
  EXPECT_DOUBLE_EQ(f.force.x, -4e5 * 2e-6);  // sticks: 0.8 N of 5 N
  EXPECT_DOUBLE_EQ(f.energy, 0.5 * 10.0 * 1e-5 + 0.5 * 0.8 * 2e-6);
  f = platen_force(contact, 1e-5, up, {1e-3, 0, 1e-3}, true, h);
  EXPECT_NEAR(std::hypot(f.force.x, f.force.z), 5.0, 1e-12);  // slides: mu F_n
  // Unloading the normal force takes the shear force down with it.
  f = platen_force(contact, 2e-6, up, {0, 0, 0}, true, h);
  EXPECT_NEAR(std::hypot(f.force.x, f.force.z), 1.0, 1e-12);
}

TEST(PlatenLaw, WithoutFrictionThereIsNoShear) {
  PlatenHistory h;
  const PlatenForce f = platen_force({1e6, 1e6, 0.0}, 1e-5, up, {1e-3, 0, 0}, true, h);
  EXPECT_EQ(f.force.x, 0.0);
  EXPECT_TRUE(h.touching());
}

TEST(PlatenLaw, HistoryStaysWhenNotAdvancing) {
  PlatenHistory h;
  const PlatenForce f = platen_force(contact, 1e-5, up, {2e-6, 0, 0}, true, h);
  const PlatenHistory before = h;
  const PlatenForce again = platen_force(contact, 1e-5, up, {5e-6, 0, 0}, false, h);
  EXPECT_EQ(again.force.x, f.force.x);
  EXPECT_EQ(again.force.y, f.force.y);
  EXPECT_EQ(again.energy, f.energy);
  EXPECT_EQ(h.shear.x, before.shear.x);
  EXPECT_EQ(h.normal.y, before.normal.y);
}

TEST(PlatenLaw, ClosedShearCycleInStickReturnsAllWork) {
  PlatenHistory h;
  double work = 0.0;
  const int steps = 1000;
  for (int k = 0; k < 2 * steps; ++k) {  // a circle in the plane of the platen, there and back
    const double a = 2 * pi * (k < steps ? k : 2 * steps - k) / steps;
    const double b = 2 * pi * (k < steps ? k + 1 : 2 * steps - k - 1) / steps;
    const Vec3 du{1e-6 * (std::cos(b) - std::cos(a)), 0, 1e-6 * (std::sin(b) - std::sin(a))};
    const Vec3 before = h.shear;
    const PlatenForce f = platen_force(contact, 1e-5, up, du, true, h);
    work += 0.5 * dot(f.force + before, du);
  }
  EXPECT_NEAR(length(h.shear), 0.0, 1e-12);
  EXPECT_NEAR(work, 0.0, 1e-18);  // of 4e-7 J that went in and out
}

TEST(PlatenLaw, CarriedShearKeepsItsLengthAndItsAngleOnACurvedPlaten) {
  // Around a cylinder about z, 100 turns: a force with parts along and across the axis. Carrying
  // keeps both; projection would lose 1 - cos(step) of the part across at every step.
  Vec3 force{3, 0, 4};
  Vec3 n0{0, 1, 0};
  const int steps = 1000, turns = 100;
  for (int k = 1; k <= steps * turns; ++k) {
    const double a = 2 * pi * k / steps;
    const Vec3 n{std::sin(a), std::cos(a), 0};
    force = carried_with_normal(force, n0, n);
    n0 = n;
  }
  EXPECT_NEAR(force.x, 3.0, 1e-9);
  EXPECT_NEAR(force.y, 0.0, 1e-9);
  EXPECT_NEAR(force.z, 4.0, 1e-9);
}

TEST(PlatenLaw, CarryingIsTheSameInATurnedFrame) {
  // Objectivity: turning the whole scene turns the answer.
  const auto turned = [](Vec3 v) {  // about (1,1,1) by 120 degrees
    return Vec3{v.z, v.x, v.y};
  };
  const Vec3 n0{0.6, 0.8, 0}, n{0, 1, 0}, v{-0.8 * 2, 0.6 * 2, 5};
  const Vec3 a = turned(carried_with_normal(v, n0, n));
  const Vec3 b = carried_with_normal(turned(v), turned(n0), turned(n));
  EXPECT_NEAR(length(a - b), 0.0, 1e-15);
  EXPECT_NEAR(length(a), length(v), 1e-14);
  EXPECT_NEAR(dot(carried_with_normal(v, n0, n), n), 0.0, 1e-14);
}

TEST(PlatenLaw, NormalTurnedOverStartsAfresh) {
  const Vec3 v = carried_with_normal({1, 0, 0}, {0, 1, 0}, {0, -1, 0});
  EXPECT_EQ(length(v), 0.0);
}

}  // namespace
