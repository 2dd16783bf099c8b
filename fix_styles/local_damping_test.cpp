// SPDX-License-Identifier: GPL-2.0-or-later
#include "local_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace bondlab;

TEST(LocalDamping, ReducesWhatSpeedsUpAndIncreasesWhatSlowsDown) {
  EXPECT_DOUBLE_EQ(locally_damped(10.0, 1e-9, 0.7), 3.0);
  EXPECT_DOUBLE_EQ(locally_damped(10.0, -1e-9, 0.7), 17.0);
  EXPECT_DOUBLE_EQ(locally_damped(-10.0, -5.0, 0.7), -3.0);
  EXPECT_DOUBLE_EQ(locally_damped(-10.0, 5.0, 0.7), -17.0);
}

TEST(LocalDamping, DoesNothingAtRest) {
  EXPECT_EQ(locally_damped(10.0, 0.0, 0.7), 10.0);
  EXPECT_EQ(locally_damped(-10.0, -0.0, 0.7), -10.0);
  EXPECT_EQ(locally_damped(0.0, 3.0, 0.7), 0.0);
}

TEST(LocalDamping, NaNIsNotHidden) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(locally_damped(nan, 1.0, 0.7)));
}

TEST(LocalDamping, PartOfDampingIsWhatWasAdded) {
  for (const double alpha : {0.0, 0.3, 0.7})
    for (const double force : {-3.0, 0.0, 2.0})
      for (const double velocity : {-1.0, 0.0, 0.5}) {
        const double damped = locally_damped(force, velocity, alpha);
        EXPECT_NEAR(damping_part(damped, velocity, alpha), damped - force, 2e-15) << force << ' ' << velocity;
      }
}

TEST(LocalDamping, ArraysOfAnyLength) {
  for (std::size_t n = 0; n < 40; ++n) {
    std::vector<double> f(n), v(n);
    for (std::size_t k = 0; k < n; ++k) f[k] = 1.0 + k, v[k] = static_cast<int>(k % 3) - 1;
    damp_locally(f.data(), v.data(), n, 0.5);
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_EQ(f[k], (1.0 + k) * (1.0 - 0.5 * (static_cast<int>(k % 3) - 1)));
  }
}

TEST(LocalDamping, OscillatorLosesTheAmplitudeOfTheClosedForm) {
  // Leap-frog. The velocity seen by the damping is half a step old, so a turning point is met to a
  // step: relative error of the amplitude alpha dt^2 omega^2 each, 1e-7 at 20,000 steps a cycle.
  const double alpha = 0.3, dt = 2 * std::acos(-1.0) / 20000;
  double x = 1.0, v = 0.0, f = -x, last_v = 0.0;  // k = m = 1
  std::vector<double> turning_points;
  for (int step = 0; step < 100000 && turning_points.size() < 6; ++step) {
    v += 0.5 * dt * f;
    const double last_x = x;
    x += dt * v;
    if (last_v * v < 0.0) turning_points.push_back(std::fabs(last_x));
    last_v = v;
    f = -x;
    damp_locally(&f, &v, 1, alpha);
    v += 0.5 * dt * f;
  }
  ASSERT_EQ(turning_points.size(), 6u);
  const double ratio = std::sqrt((1 - alpha) / (1 + alpha));
  for (std::size_t i = 0; i < turning_points.size(); ++i)
    EXPECT_NEAR(turning_points[i] / std::pow(ratio, i + 1), 1.0, 1e-6) << i;
}

}  // namespace
