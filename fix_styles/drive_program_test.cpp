// SPDX-License-Identifier: GPL-2.0-or-later
#include "drive_program.h"

#include <gtest/gtest.h>

namespace {

using namespace bondlab;
using Trigger = DriveEvent::Trigger;
using Action = DriveEvent::Action;

constexpr double dt = 1e-4;
constexpr double stiffness = 2000.0;  // load per m

struct Track {
  std::vector<double> time, displacement, speed, phase, excused;
};

// The drive loads a spring, which sees the displacement of the last step.
Track run(const DriveProgram &program, double duration) {
  DriveState s;
  program.start(s);
  Track track;
  for (int k = 1; k * dt <= duration; ++k) {
    const double load = program.needs_load(s) ? stiffness * s.displacement : -1e30;
    program.advance(s, k * dt, dt, load);
    track.time.push_back(k * dt);
    track.displacement.push_back(s.displacement);
    track.speed.push_back(s.speed);
    track.phase.push_back(s.phase);
    track.excused.push_back(s.excused);
  }
  return track;
}

DriveProgram at_speed(double speed, double ramp, std::vector<DriveEvent> events = {}) {
  DriveProgram p;
  p.speed = speed;
  p.ramp = ramp;
  p.events = std::move(events);
  return p;
}

TEST(DriveProgram, WithoutEventsIsTheSmoothRamp) {
  const Track t = run(at_speed(0.2, 0.05), 0.3);
  for (std::size_t k = 0; k < t.time.size(); ++k) {
    ASSERT_DOUBLE_EQ(t.displacement[k], 0.2 * ramp_distance(t.time[k], 0.05));
    ASSERT_DOUBLE_EQ(t.speed[k], 0.2 * ramp_speed(t.time[k], 0.05));
  }
}

TEST(DriveProgram, SpeedIsTheSlopeOfTheDisplacementThroughAllPhases) {
  const Track t = run(at_speed(0.2, 0.01,
                               {{Trigger::displacement, 0.01, Action::speed, 0.05},
                                {Trigger::displacement, 0.012, Action::hold, 0.02},
                                {Trigger::displacement, 0.014, Action::unload, 0.5}}),
                      1.0);
  for (std::size_t k = 1; k < t.time.size(); ++k) {
    const double slope = (t.displacement[k] - t.displacement[k - 1]) / dt;
    // error of the trapezoidal rule, dt^2 v''/12, with the largest v'' of a cosine ramp
    const double error = dt * dt / 12 * 0.5 * 0.2 * (pi / 0.01) * (pi / 0.01);
    ASSERT_NEAR(slope, 0.5 * (t.speed[k] + t.speed[k - 1]), error) << t.time[k];
    ASSERT_LT(std::fabs(t.speed[k] - t.speed[k - 1]), 0.2 * pi / 0.01 * dt) << t.time[k];
  }
}

TEST(DriveProgram, ARateStepChangesTheSpeedAtItsPlace) {
  const Track t =
      run(at_speed(0.2, 0.0, {{Trigger::displacement, 0.01, Action::speed, 0.02}}), 0.2);
  for (std::size_t k = 0; k < t.time.size(); ++k)
    ASSERT_DOUBLE_EQ(t.speed[k], t.displacement[k] < 0.01 + 0.5 * 0.02 * dt ? 0.2 : 0.02) << k;
}

TEST(DriveProgram, AHoldLastsAsLongAsAskedAndMovesNothing) {
  const Track t =
      run(at_speed(0.2, 0.01, {{Trigger::displacement, 0.01, Action::hold, 0.05}}), 0.3);
  double first = 0, last = 0, place = 0;
  for (std::size_t k = 0; k < t.time.size(); ++k)
    if (t.phase[k] == DriveState::holding) {
      if (first == 0) first = t.time[k], place = t.displacement[k];
      last = t.time[k];
      ASSERT_EQ(t.speed[k], 0.0);
      ASSERT_EQ(t.displacement[k], place);
    }
  EXPECT_NEAR(last - first, 0.05, 2.1 * dt);
  EXPECT_NEAR(place, 0.01 + 0.2 * 0.01 / 2, 0.2 * dt);  // where it was seen, and the way to stop
  EXPECT_NEAR(t.speed.back(), 0.2, 1e-12);              // and on
}

TEST(DriveProgram, AKeptLoadComesToItsTargetWhateverItWas) {
  DriveEvent keep{Trigger::load, 20.0, Action::keep, 0.2, 0.05, 0.5};
  for (const bool given : {false, true}) {
    keep.load_given = given;
    keep.load = 30.0;
    const Track t = run(at_speed(0.1, 0.01, {keep}), 0.25);
    const double expected = given ? 30.0 : 20.0 + stiffness * 0.1 * 0.005;
    ASSERT_EQ(t.phase.back(), DriveState::keeping);
    // seen within a step of 20 N, the load it stopped at is within two steps' motion of the closed form
    EXPECT_NEAR(stiffness * t.displacement.back(), expected, given ? 0.02 : 2 * stiffness * 0.1 * dt);
  }
}

TEST(DriveProgram, UnloadingGoesBackToItsShareAndForwardAgain) {
  const Track t = run(at_speed(0.1, 0.002, {{Trigger::load, 40.0, Action::unload, 0.25}}), 0.6);
  double lowest = 1.0;
  for (std::size_t k = 0; k < t.time.size(); ++k)
    if (t.phase[k] == DriveState::unloading) lowest = t.displacement[k];
  // 10 N, and half a ramp of overshoot behind it
  EXPECT_NEAR(stiffness * lowest, 10.0, stiffness * 0.1 * (2 * dt));
  EXPECT_GT(stiffness * t.displacement.back(), 40.0);
}

TEST(DriveProgram, AFallOfTheLoadIsExcusedFromUnloadingUntilTheDriveIsBack) {
  const Track t = run(at_speed(0.1, 0.002, {{Trigger::load, 40.0, Action::unload, 0.25}}), 0.6);
  std::size_t first = 0, last = 0;
  for (std::size_t k = 0; k < t.time.size(); ++k)
    if (t.excused[k] != 0.0) {
      if (first == 0) first = k;
      last = k;
    }
  ASSERT_GT(first, 0u);
  EXPECT_NEAR(stiffness * t.displacement[first], 40.0, stiffness * 0.1 * 2 * dt);
  EXPECT_NEAR(t.displacement[last], t.displacement[first], 0.1 * 2 * dt);
  for (std::size_t k = first; k <= last; ++k) ASSERT_EQ(t.excused[k], 1.0);
}

TEST(DriveProgram, EventsComeWhenTheirPlaceIsReachedWhateverTheirOrder) {
  const Track t = run(at_speed(0.1, 0.002,
                               {{Trigger::displacement, 0.03, Action::hold, 0.01},
                                {Trigger::displacement, 0.01, Action::speed, 0.2},
                                {Trigger::load, 40.0, Action::hold, 0.01}}),
                      0.6);
  std::vector<double> holds;
  for (std::size_t k = 1; k < t.time.size(); ++k)
    if (t.phase[k] == DriveState::holding && t.phase[k - 1] != DriveState::holding)
      holds.push_back(t.displacement[k]);
  ASSERT_EQ(holds.size(), 2u);
  EXPECT_NEAR(holds[0], 0.02 + 0.2 * 0.001, 0.2 * 2 * dt);
  EXPECT_NEAR(holds[1], 0.03 + 0.2 * 0.001, 0.2 * 2 * dt);
  EXPECT_DOUBLE_EQ(t.speed.back(), 0.2);
}

TEST(DriveProgram, EndStandsStillForGood) {
  const Track t = run(at_speed(0.1, 0.002, {{Trigger::displacement, 0.01, Action::end}}), 0.5);
  EXPECT_EQ(t.phase.back(), DriveState::ended);
  EXPECT_EQ(t.speed.back(), 0.0);
  EXPECT_NEAR(t.displacement.back(), 0.01 + 0.1 * 0.001, 0.1 * dt);
}

TEST(DriveProgram, OnlyEventsThatLookAtTheLoadNeedIt) {
  EXPECT_FALSE(at_speed(1, 0, {{Trigger::displacement, 1, Action::hold, 1}}).needs_load());
  EXPECT_TRUE(at_speed(1, 0, {{Trigger::load, 1, Action::hold, 1}}).needs_load());
  EXPECT_TRUE(at_speed(1, 0, {{Trigger::displacement, 1, Action::unload, 1}}).needs_load());
}

}  // namespace
