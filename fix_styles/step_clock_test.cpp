// SPDX-License-Identifier: GPL-2.0-or-later
#include "step_clock.h"

#include <gtest/gtest.h>

namespace {

using bondlab::StepClock;

TEST(StepClock, OnePieceAndManyGiveTheSameBits) {
  StepClock one, many;
  one.start(0.0, 0, 2e-7);
  many.start(0.0, 0, 2e-7);
  one.advance(6000, 2e-7);
  for (int step : {1234, 1235, 3350, 6000}) many.advance(step, 2e-7);
  EXPECT_EQ(one.now, many.now);
  EXPECT_EQ(one.now, 6000 * 2e-7);
  EXPECT_EQ(one.at(3350), 3350 * 2e-7);
}

TEST(StepClock, GoesOnWhenTheTimeStepChanges) {
  StepClock c;
  c.start(1.0, 100, 0.5);
  c.advance(104, 0.5);
  c.advance(105, 0.25);
  EXPECT_EQ(c.now, 3.25);
  c.advance(106, 0.25);
  EXPECT_EQ(c.now, 3.5);
  c.advance(107, 0.5);
  EXPECT_EQ(c.now, 4.0);
}

TEST(StepClock, RenumberedStepsKeepTheTime) {
  StepClock c;
  c.start(0.0, 0, 0.5);
  c.advance(10, 0.5);
  c.renumber(1000, 10);
  EXPECT_EQ(c.now, 5.0);
  c.advance(1002, 0.5);
  EXPECT_EQ(c.now, 6.0);
}

TEST(StepClock, KnowsWhetherItRuns) {
  StepClock c;
  EXPECT_FALSE(c.started());
  c.start(0.0, 0, 1.0);
  EXPECT_TRUE(c.started());
}

}  // namespace
