// SPDX-License-Identifier: GPL-2.0-or-later
//
// The series of a step's turn and spin: bounds that pair_geometry.h promises.
#include "pair_geometry.h"

#include <gtest/gtest.h>

#include <random>

using namespace bondlab::laws;

namespace {

// v turned by |r| about r.
Vec3 turned(Vec3 v, Vec3 r) {
  const double angle = std::sqrt(dot(r, r));
  const Vec3 n = (1.0 / angle) * r;
  return std::cos(angle) * v + std::sin(angle) * cross(n, v) + ((1.0 - std::cos(angle)) * dot(n, v)) * n;
}

struct Error {
  double length = 0.0, angle = 0.0, across = 0.0;  // relative; of the carried vector
};

// A vector across a bond that turns and spins as a rigid body by `angle` in one step.
Error carried(double angle, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> any;
  const auto draw = [&] { return Vec3{any(random), any(random), any(random)}; };
  Error worst;
  for (int k = 0; k < 200; ++k) {
    const Vec3 d0 = 2e-3 * draw(), axis = draw();
    const Vec3 r = (angle / std::sqrt(dot(axis, axis))) * axis, d = turned(d0, r);
    const Vec3 v0 = cross(d0, draw());
    const PairStep3 p(d, d - d0, r, {0, 0, 0});
    const Vec3 v = p.carried(v0), right = turned(v0, r), off = v - right;
    const double size = std::sqrt(dot(v0, v0));
    worst.length = std::max(worst.length, std::fabs(std::sqrt(dot(v, v)) / size - 1.0));
    worst.angle = std::max(worst.angle, std::sqrt(dot(off, off)) / size);
    worst.across = std::max(worst.across, std::fabs(dot(v, p.e)) / size);
  }
  return worst;
}

}  // namespace

TEST(PairGeometry, carried_vector_keeps_its_length) {
  EXPECT_LT(carried(1e-6, 1).length, 1.5e-15);
  EXPECT_LT(carried(0.03, 2).length, 1.5e-15);
  EXPECT_LT(carried(0.15, 3).length, 1e-9);
}

TEST(PairGeometry, carried_vector_stays_across_the_bond) {
  for (const double angle : {1e-6, 0.03, 0.15}) EXPECT_LT(carried(angle, 4).across, 1e-9 * angle + 1.5e-15);
}

// To the third order of the angle: the rotation vector's split into turn and spin.
TEST(PairGeometry, carried_vector_turns_with_the_body) {
  EXPECT_LT(carried(0.03, 5).angle, 0.03 * 0.03 * 0.03);
  EXPECT_LT(carried(0.015, 5).angle, 0.13 * carried(0.03, 5).angle);
}
