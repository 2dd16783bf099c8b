// SPDX-License-Identifier: GPL-2.0-or-later
#include "platen_motion.h"

#include <gtest/gtest.h>

namespace {

using namespace bondlab;

TEST(PlatenMotion, StartsFromRestAndEndsAtFullSpeed) {
  EXPECT_EQ(ramp_speed(0.0, 2.0), 0.0);
  EXPECT_EQ(ramp_distance(0.0, 2.0), 0.0);
  EXPECT_EQ(ramp_speed(-1.0, 2.0), 0.0);
  EXPECT_EQ(ramp_speed(2.0, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(ramp_speed(1.0, 2.0), 0.5);
  EXPECT_DOUBLE_EQ(ramp_distance(2.0, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(ramp_distance(5.0, 2.0), 4.0);
}

TEST(PlatenMotion, WithoutRampTheSpeedIsFullFromTheStart) {
  EXPECT_EQ(ramp_speed(0.0, 0.0), 0.0);
  EXPECT_EQ(ramp_speed(1e-9, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(ramp_distance(3.0, 0.0), 3.0);
}

TEST(PlatenMotion, SpeedIsTheSlopeOfTheDistance) {
  const double h = 1e-5;
  for (double t = 0.01; t < 3.0; t += 0.01) {
    const double slope = (ramp_distance(t + h, 2.0) - ramp_distance(t - h, 2.0)) / (2 * h);
    EXPECT_NEAR(slope, ramp_speed(t, 2.0), 1e-9) << t;  // h^2 pi^2/12 and rounding 1e-16/h
  }
}

TEST(PlatenMotion, AccelerationIsBoundedAndZeroAtBothEnds) {
  const double h = 1e-4;
  const double peak = 0.25 * pi;  // V pi/(2 T), T = 2
  for (double t = h; t < 3.0; t += 0.01) {
    const double a = (ramp_speed(t + h, 2.0) - ramp_speed(t - h, 2.0)) / (2 * h);
    EXPECT_LE(a, peak * (1 + 1e-6));
    EXPECT_GE(a, 0.0);
  }
  EXPECT_LT(ramp_speed(h, 2.0) / h, 1e-3);
  EXPECT_LT((1.0 - ramp_speed(2.0 - h, 2.0)) / h, 1e-3);
}

TEST(PlatenMotion, ServoPushesTowardsItsForceAndIsLimited) {
  EXPECT_DOUBLE_EQ(servo_speed(0.0, 100.0, 1e-3, 1.0), -0.1);  // too little push from above: down
  EXPECT_DOUBLE_EQ(servo_speed(150.0, 100.0, 1e-3, 1.0), 0.05);
  EXPECT_EQ(servo_speed(0.0, 1e9, 1e-3, 0.2), -0.2);
  EXPECT_EQ(servo_speed(1e9, 0.0, 1e-3, 0.2), 0.2);
  EXPECT_EQ(servo_speed(100.0, 100.0, 1e-3, 0.2), 0.0);
}

}  // namespace
