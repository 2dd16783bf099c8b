// SPDX-License-Identifier: GPL-2.0-or-later
#include "gauge_strain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace bondlab;
using Point = std::array<double, 3>;

std::vector<Point> box(int count, Point lo, Point hi, int seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::vector<Point> points(count);
  for (Point &p : points)
    for (int d = 0; d < 3; ++d) p[d] = lo[d] + (hi[d] - lo[d]) * u(random);
  return points;
}

GaugeStrain measure(Gauge gauge, const std::vector<Point> &points,
                    const std::array<Point, 3> &gradient, Point shift) {
  for (const Point &X : points) {
    Point u = shift;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) u[i] += gradient[i][j] * X[j];
    gauge.add(X.data(), u.data());
  }
  return gauge.strain();
}

GaugeSettings flat() {
  GaugeSettings s;
  s.axial = 1;
  s.thickness = 0.01;
  s.lateral = GaugeSettings::strips;
  s.across = 0;
  s.strip = 0.005;
  return s;
}

// Rounding: displacements of 1e-3 x 0.1 m on top of a shift of 0.01 m, 1e-16/1e-5.
constexpr double tolerance = 1e-14;

TEST(GaugeStrain, ExactForHomogeneousStrainInThePlane) {
  GaugeFrame f;
  f.lo = 0.0, f.hi = 0.1, f.left = -0.025, f.right = 0.025;
  const auto points = box(2000, {-0.025, 0, 0}, {0.025, 0.1, 0}, 1);
  const GaugeStrain g = measure(Gauge(flat(), f), points,
                                {{{2.5e-4, 0, 0}, {0, -1e-3, 0}, {0, 0, 0}}}, {0.01, -0.02, 0});
  EXPECT_NEAR(g.axial, 1e-3, tolerance);
  EXPECT_NEAR(g.lateral, 2.5e-4, tolerance);
  EXPECT_GT(g.top, 100);
  EXPECT_GT(g.bottom, 100);
  EXPECT_GT(g.flank, 100);
}

TEST(GaugeStrain, ExactForHomogeneousStrainOfACylinder) {
  for (int axial = 0; axial < 3; ++axial) {
    GaugeSettings s = flat();
    s.axial = axial;
    s.lateral = GaugeSettings::shell;
    const int a = axial == 0 ? 1 : 0, b = axial == 2 ? 1 : 2;
    std::vector<Point> points;
    for (Point p : box(8000, {-0.025, -0.025, -0.025}, {0.025, 0.025, 0.025}, 2)) {
      if (std::hypot(p[a], p[b]) > 0.025) continue;
      p[axial] = 2 * p[axial] + 0.05;  // 0 to 0.1
      p[a] += 0.003;                   // off the origin
      points.push_back(p);
    }
    GaugeFrame f;
    f.lo = 0, f.hi = 0.1, f.centre[0] = 0.003, f.radius = 0.025;
    // the mean of the shell, as the fix finds it
    Gauge finder(s, f);
    double n = 0, mean[2] = {0, 0};
    for (const Point &p : points)
      if (finder.in_shell(p.data())) n += 1, mean[0] += p[a], mean[1] += p[b];
    f.shell_centre[0] = mean[0] / n, f.shell_centre[1] = mean[1] / n;
    std::array<Point, 3> gradient{};
    gradient[axial][axial] = -1e-3;
    gradient[a][a] = gradient[b][b] = 2.5e-4;
    const GaugeStrain g = measure(Gauge(s, f), points, gradient, {0.01, -0.02, 0.03});
    EXPECT_NEAR(g.axial, 1e-3, tolerance) << axial;
    EXPECT_NEAR(g.lateral, 2.5e-4, tolerance) << axial;
    EXPECT_EQ(g.flank, n);
  }
}

TEST(GaugeStrain, ASmallTurnIsNoStrain) {
  GaugeFrame f;
  f.lo = 0.0, f.hi = 0.1, f.left = -0.025, f.right = 0.025;
  const auto points = box(2000, {-0.025, 0, 0}, {0.025, 0.1, 0}, 1);
  const GaugeStrain g =
      measure(Gauge(flat(), f), points, {{{0, -1e-6, 0}, {1e-6, 0, 0}, {0, 0, 0}}}, {0, 0, 0});
  // Layers and strips have a mean position that is not quite on the axis: |w| times that.
  EXPECT_NEAR(g.axial, 0.0, 1e-6 * 0.1);
  EXPECT_NEAR(g.lateral, 0.0, 1e-6 * 0.2);
}

TEST(GaugeStrain, OrderOfParticlesDoesNotMatter) {
  GaugeFrame f;
  f.lo = 0.0, f.hi = 0.1, f.left = -0.025, f.right = 0.025;
  auto points = box(500, {-0.025, 0, 0}, {0.025, 0.1, 0}, 3);
  const std::array<Point, 3> gradient{{{2.5e-4, 1e-5, 0}, {3e-5, -1e-3, 0}, {0, 0, 0}}};
  const GaugeStrain a = measure(Gauge(flat(), f), points, gradient, {1, 2, 3});
  std::mt19937_64 random(4);
  std::shuffle(points.begin(), points.end(), random);
  const GaugeStrain b = measure(Gauge(flat(), f), points, gradient, {1, 2, 3});
  EXPECT_EQ(a.axial, b.axial);
  EXPECT_EQ(a.lateral, b.lateral);
}

TEST(GaugeStrain, AnEmptyLayerGivesNaN) {
  GaugeFrame f;
  f.lo = 0.0, f.hi = 0.1, f.left = -0.025, f.right = 0.025;
  const auto points = box(100, {-0.025, 0, 0}, {0.025, 0.04, 0}, 5);  // nothing at 75 %
  const GaugeStrain g = measure(Gauge(flat(), f), points, {}, {0, 0, 0});
  EXPECT_TRUE(std::isnan(g.axial));
  EXPECT_EQ(g.top, 0);
}

TEST(GaugeStrain, WithoutLateralGaugeLateralIsNaN) {
  GaugeSettings s = flat();
  s.lateral = GaugeSettings::none;
  GaugeFrame f;
  f.lo = 0.0, f.hi = 0.1;
  const auto points = box(500, {-0.025, 0, 0}, {0.025, 0.1, 0}, 3);
  const GaugeStrain g = measure(Gauge(s, f), points, {{{0, 0, 0}, {0, -1e-3, 0}, {0, 0, 0}}}, {});
  EXPECT_NEAR(g.axial, 1e-3, tolerance);
  EXPECT_TRUE(std::isnan(g.lateral));
}

TEST(Extent, CoversParticlesWithTheirRadii) {
  Extent e;
  e.add(1.0, 0.25);
  e.add(-2.0, 0.5);
  EXPECT_EQ(e.lo, -2.5);
  EXPECT_EQ(e.hi, 1.25);
  e.add(-1.5, 3.0);  // reaches beyond both, its centre doesn't
  EXPECT_EQ(e.lo, -4.5);
  EXPECT_EQ(e.hi, 1.5);
}

}  // namespace
