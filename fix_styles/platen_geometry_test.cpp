// SPDX-License-Identifier: GPL-2.0-or-later
#include "platen_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace bondlab;

constexpr double tolerance = 1e-14;  // lengths are of order 1, formulas a few operations

void expect_vector(Vec3 a, Vec3 b) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

PlatenGeometry make(Surface s, Vec3 point, Vec3 direction, double radius, bool inside) {
  return {s, point, (1.0 / length(direction)) * direction, radius, inside};
}

TEST(PlatenGeometry, Plane) {
  const auto p = make(Surface::plane, {0, 1, 0}, {0, -2, 0}, 0, false);
  const PlatenTouch t = touch(p, {0.3, 0.7, 0.2}, 0.25);
  EXPECT_NEAR(t.gap, 0.05, tolerance);
  expect_vector(t.normal, {0, -1, 0});
  expect_vector(t.point, {0.3, 1, 0.2});
  EXPECT_NEAR(touch(p, {0, 0.8, 0}, 0.25).gap, -0.05, tolerance);
}

TEST(PlatenGeometry, CylinderOutsideAndInside) {
  const auto outside = make(Surface::cylinder, {1, 2, 9}, {0, 0, 1}, 0.5, false);
  PlatenTouch t = touch(outside, {1, 3, -4}, 0.6);
  EXPECT_NEAR(t.gap, -0.1, tolerance);
  expect_vector(t.normal, {0, 1, 0});
  expect_vector(t.point, {1, 2.5, -4});
  const auto inside = make(Surface::cylinder, {1, 2, 9}, {0, 0, 1}, 2.0, true);
  t = touch(inside, {1, 3, -4}, 0.6);
  EXPECT_NEAR(t.gap, 0.4, tolerance);
  expect_vector(t.normal, {0, -1, 0});
  expect_vector(t.point, {1, 4, -4});
}

TEST(PlatenGeometry, ObliqueCylinderIgnoresThePlaceAlongItsAxis) {
  const auto p = make(Surface::cylinder, {0.1, -0.2, 0.3}, {1, 2, -2}, 0.5, false);
  const PlatenTouch a = touch(p, {2, 1, 1}, 0.3);
  const PlatenTouch b = touch(p, Vec3{2, 1, 1} + 3.7 * p.direction, 0.3);
  EXPECT_NEAR(a.gap, b.gap, tolerance);
  EXPECT_NEAR(dot(a.normal, p.direction), 0.0, tolerance);
  EXPECT_NEAR(length(a.normal), 1.0, tolerance);
}

TEST(PlatenGeometry, SphereOutsideAndInside) {
  const auto outside = make(Surface::sphere, {0, 0, 1}, {0, 0, 1}, 0.5, false);
  PlatenTouch t = touch(outside, {0, 0.6, 1.8}, 0.25);
  EXPECT_NEAR(t.gap, 0.25, tolerance);
  expect_vector(t.normal, {0, 0.6, 0.8});
  expect_vector(t.point, {0, 0.3, 1.4});
  const auto inside = make(Surface::sphere, {0, 0, 1}, {0, 0, 1}, 2.0, true);
  t = touch(inside, {0, 0.6, 1.8}, 0.25);
  EXPECT_NEAR(t.gap, 0.75, tolerance);
  expect_vector(t.normal, {0, -0.6, -0.8});
}

TEST(PlatenGeometry, TheNormalIsTheGradientOfTheGap) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const double h = 1e-6;
  for (Surface s : {Surface::plane, Surface::cylinder, Surface::sphere})
    for (bool inside : {false, true})
      for (int k = 0; k < 50; ++k) {
        const auto p =
            make(s, {u(random), u(random), u(random)}, {u(random), u(random), 1.1}, 3.0, inside);
        const Vec3 x{u(random), u(random), u(random)};
        const Vec3 n = touch(p, x, 0.1).normal;
        const auto slope = [&](Vec3 e) {
          return (touch(p, x + h * e, 0.1).gap - touch(p, x - h * e, 0.1).gap) / (2 * h);
        };
        // Central differences: h^2/distance^2 and rounding 1e-16/h.
        const double r = s == Surface::plane ? 1.0 : length(across(p, x - p.point));
        const double allowed = h * h / (r * r) + 1e-9;
        EXPECT_NEAR(slope({1, 0, 0}), n.x, allowed);
        EXPECT_NEAR(slope({0, 1, 0}), n.y, allowed);
        EXPECT_NEAR(slope({0, 0, 1}), n.z, allowed);
      }
}

TEST(PlatenGeometry, OnTheAxisTheNormalIsStillAUnitVector) {
  for (Vec3 d : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
    const auto p = make(Surface::cylinder, {0, 0, 0}, d, 1.0, true);
    const PlatenTouch t = touch(p, {0, 0, 0}, 0.2);
    EXPECT_NEAR(t.gap, 0.8, tolerance);
    EXPECT_NEAR(length(t.normal), 1.0, tolerance);
    EXPECT_NEAR(dot(t.normal, d), 0.0, tolerance);
  }
}

TEST(PlatenGeometry, TheQuickSweepAgreesWithTheGap) {
  int apart = 0;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (const PlatenGeometry &p : {make(Surface::plane, {0.1, 0.2, 0.3}, {1, 2, 3}, 0, false),
                                  make(Surface::cylinder, {0.1, 0.2, 0.3}, {1, 2, 3}, 0.4, false),
                                  make(Surface::cylinder, {0.1, 0.2, 0.3}, {1, 2, 3}, 0.9, true),
                                  make(Surface::cylinder, {0.1, 0.2, 0.3}, {1, 2, 3}, 0.1, true),
                                  make(Surface::sphere, {0.1, 0.2, 0.3}, {0, 0, 1}, 0.4, false),
                                  make(Surface::sphere, {0.1, 0.2, 0.3}, {0, 0, 1}, 0.9, true)}) {
    const std::size_t n = 1003;
    std::vector<double> x(3 * n), radius(n);
    std::vector<unsigned char> near(n, 7);
    for (double &c : x) c = u(random);
    for (std::size_t i = 0; i < n; ++i) {
      radius[i] = 0.2 + 0.1 * u(random);
      if (i % 3 == 0) {  // put it at touch, a hair off
        const Vec3 c{x[3 * i], x[3 * i + 1], x[3 * i + 2]};
        radius[i] += touch(p, c, radius[i]).gap * (1.0 + (i % 2 ? 1e-12 : -1e-12));
        if (i % 9 == 0) radius[i] *= 1.0 - 1e-7;  // clearly off
        if (!(radius[i] > 0.0)) radius[i] = 0.2;
      }
    }
    mark_near(p, x.data(), radius.data(), n, near.data());
    int touching = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double gap = touch(p, {x[3 * i], x[3 * i + 1], x[3 * i + 2]}, radius[i]).gap;
      if (gap < 0.0) {
        ++touching;
        ASSERT_EQ(near[i], 1) << i;
      } else if (gap > 2e-9 * radius[i]) {
        ASSERT_EQ(near[i], 0) << i;
      }
    }
    EXPECT_GT(touching, 50);
    apart += static_cast<int>(n) - touching;
  }
  EXPECT_GT(apart, 1000);
}

TEST(PlatenGeometry, ClosingTheGapMakesItZero) {
  std::vector<PlatenGeometry> platens = {make(Surface::plane, {0, -2, 0}, {0.1, 1, 0}, 0, false),
                                         make(Surface::cylinder, {0, -3, 0}, {0, 0, 1}, 0.5, false),
                                         make(Surface::cylinder, {0, 0, 0}, {0, 0, 1}, 4.0, true),
                                         make(Surface::sphere, {0, 0, 3}, {0, 0, 1}, 0.5, false),
                                         make(Surface::sphere, {0, 0, 0}, {0, 0, 1}, 4.0, true)};
  for (PlatenGeometry p : platens) {
    const Vec3 x{0.2, 0.3, -0.1};
    close_gap(p, touch(p, x, 0.25).gap);
    EXPECT_NEAR(touch(p, x, 0.25).gap, 0.0, tolerance);
  }
}

TEST(PlatenGeometry, TravelEndsAtTouch) {
  // Pushed up from below: a plane, a round anvil, and the wall of a hollow jaw.
  const Vec3 up{0, 1, 0}, x{0.2, 0.3, 0};
  for (PlatenGeometry p : {make(Surface::plane, {0, -2, 0}, {0.1, 1, 0}, 0, false),
                           make(Surface::cylinder, {0, -3, 0}, {0, 0, 1}, 0.5, false),
                           make(Surface::sphere, {0, -3, 0}, {0, 0, 1}, 0.5, false),
                           make(Surface::cylinder, {0, -1, 0}, {0, 0, 1}, 5.0, true)}) {
    const double s = travel_to_touch(p, up, x, 0.25);
    EXPECT_GT(s, 0.0);
    p.point = p.point + s * up;
    EXPECT_NEAR(touch(p, x, 0.25).gap, 0.0, tolerance);
    EXPECT_GT(touch(p, x, 0.25).normal.y, 0.0);  // from below, not from the other side
  }
}

TEST(PlatenGeometry, APlatenThatPassesByNeverTouches) {
  EXPECT_TRUE(std::isinf(travel_to_touch(make(Surface::plane, {0, 0, 0}, {0, 1, 0}, 0, false),
                                         {1, 0, 0}, {0, 1, 0}, 0.1)));
  EXPECT_TRUE(std::isinf(travel_to_touch(make(Surface::cylinder, {0, -3, 0}, {0, 0, 1}, 0.5, false),
                                         {0, 1, 0}, {2, 0, 0}, 0.25)));
  EXPECT_TRUE(std::isinf(travel_to_touch(make(Surface::cylinder, {0, -3, 0}, {0, 0, 1}, 0.5, false),
                                         {0, 0, 1}, {0, 0, 0}, 0.25)));
}

}  // namespace
