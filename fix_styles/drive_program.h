// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the programme of a loading machine: one displacement as a function of time, with rate steps,
// holds at a displacement or at a load, and unload-reload cycles.
//
// Method. The drive cruises at a speed. Events wait, each for a displacement or a load that the
// drive, moving forward, must have reached; of those that have theirs the first in order is begun,
// once the one before is over:
//     speed V    cruise at V from now on
//     hold T     stand still for T, then go on
//     keep T     stand still, then hold the load by a servo for T, then go on
//     unload S   go back until the load is S times what it was, then go forward again
//     end        stand still for good
// Every change of speed is half a cosine wave of length `ramp` (platen_motion.h), and within a
// phase the displacement is a closed form of the time: no drift, whatever the time step. Times of
// `hold` and `keep` count from standstill. An event is looked for once a step, so it is reached
// within one step's motion, and stopping takes another V ramp/2.
// `excused` is 1 while the load may fall without the specimen failing: from the start of an
// unloading until the drive is back where that began, and during a hold.
// The servo is v = G (target - load), at most v_max: forward raises the load. It is stable while
// G k dt < 1 with k the stiffness of what is loaded.
//
// Units: s, m, m/s; the load in what the deck's variable has. Failure: none; a NaN load triggers
// nothing and stops the servo's sense, which fix curve reports. Limits: one load; forward means a
// positive displacement.
#ifndef BONDLAB_DRIVE_PROGRAM_H
#define BONDLAB_DRIVE_PROGRAM_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "platen_motion.h"

namespace bondlab {

struct DriveEvent {
  enum class Trigger { displacement, load };
  enum class Action { speed, hold, keep, unload, end };
  Trigger trigger = Trigger::displacement;
  double where = 0.0;  // m, or load
  Action action = Action::end;
  double value = 0.0;  // m/s, s, s, share
  double gain = 0.0, limit = 0.0;  // keep: m/s per unit of load, m/s
  bool load_given = false;         // keep: a load of its own instead of the one found
  double load = 0.0;
};

// All doubles, so that a restart file can hold it as a list.
struct DriveState {
  enum Phase { cruising, stopping, holding, keeping, unloading, ended };
  double displacement = 0.0, speed = 0.0;
  double phase = cruising;
  double start = 0.0, origin = 0.0;  // of the present phase: time, displacement
  double from = 0.0, to = 0.0;       // speeds between which the phase changes
  double cruise = 0.0;
  double begun = 0.0;    // bit k: event k is done or under way
  double current = -1.0;  // the one under way, or the last
  double target = 0.0;    // load of a servo or an unloading
  double back = 0.0;      // where the last unloading began, m
  double excused = 0.0;
};

class DriveProgram {
 public:
  double speed = 0.0, ramp = 0.0;
  std::vector<DriveEvent> events;
  static constexpr std::size_t most_events = 52;  // bits of a double

  bool needs_load() const {
    return std::any_of(events.begin(), events.end(), looks_at_load);
  }
  // As long as an event that looks at the load is ahead or under way: finding it costs a sum.
  bool needs_load(const DriveState &s) const {
    const auto begun = static_cast<std::uint64_t>(s.begun);
    for (std::size_t k = 0; k < events.size(); ++k)
      if (looks_at_load(events[k]) &&
          (!(begun >> k & 1) || (s.phase != DriveState::cruising && s.current == double(k))))
        return true;
    return false;
  }

  void start(DriveState &s) const {
    s = DriveState{};
    s.cruise = s.to = speed;
  }

  // To `time`, dt after the last call; `load` is that of the last step.
  void advance(DriveState &s, double time, double dt, double load) const {
    decide(s, time - dt, load);
    if (s.phase == DriveState::keeping) {
      const DriveEvent &e = current(s);
      s.speed = std::clamp(e.gain * (s.target - load), -e.limit, e.limit);
      s.displacement += s.speed * dt;
      return;
    }
    const double t = time - s.start;
    s.speed = s.from + (s.to - s.from) * ramp_speed(t, ramp);
    s.displacement = s.origin + s.from * t + (s.to - s.from) * ramp_distance(t, ramp);
  }

 private:
  static bool looks_at_load(const DriveEvent &e) {
    return e.trigger == DriveEvent::Trigger::load || e.action == DriveEvent::Action::keep ||
           e.action == DriveEvent::Action::unload;
  }

  const DriveEvent &current(const DriveState &s) const {
    return events[static_cast<std::size_t>(s.current)];
  }

  void enter(DriveState &s, DriveState::Phase phase, double time, double to) const {
    s.phase = phase;
    s.start = time;
    s.origin = s.displacement;
    s.from = s.speed;
    s.to = to;
  }

  void decide(DriveState &s, double time, double load) const {
    const double t = time - s.start;
    switch (static_cast<int>(s.phase)) {
      case DriveState::cruising:
        if (s.excused != 0.0 && s.displacement > s.back) s.excused = 0.0;
        begin_event(s, time, load);
        return;
      case DriveState::stopping:
        if (t < ramp) return;
        if (current(s).action == DriveEvent::Action::end) {
          enter(s, DriveState::ended, time, 0.0);
        } else if (current(s).action == DriveEvent::Action::keep) {
          s.target = current(s).load_given ? current(s).load : load;
          enter(s, DriveState::keeping, time, 0.0);
        } else {
          s.excused = 1.0;
          enter(s, DriveState::holding, time, 0.0);
        }
        return;
      case DriveState::holding:
      case DriveState::keeping:
        if (t < current(s).value) return;
        if (s.phase == DriveState::holding) s.back = s.displacement;
        enter(s, DriveState::cruising, time, s.cruise);
        return;
      case DriveState::unloading:
        if (t >= ramp && load <= s.target) enter(s, DriveState::cruising, time, s.cruise);
    }
  }

  void begin_event(DriveState &s, double time, double load) const {
    const auto begun = static_cast<std::uint64_t>(s.begun);
    std::size_t k = 0;
    for (; k < events.size(); ++k) {
      const double reached =
          events[k].trigger == DriveEvent::Trigger::load ? load : s.displacement;
      if (!(begun >> k & 1) && reached >= events[k].where) break;
    }
    if (k == events.size()) return;
    const DriveEvent &e = events[k];
    s.begun = static_cast<double>(begun | std::uint64_t(1) << k);
    s.current = static_cast<double>(k);
    switch (e.action) {
      case DriveEvent::Action::speed:
        s.cruise = e.value;
        enter(s, DriveState::cruising, time, s.cruise);
        return;
      case DriveEvent::Action::unload:
        s.target = e.value * load;
        s.back = s.displacement;
        s.excused = 1.0;
        enter(s, DriveState::unloading, time, -s.cruise);
        return;
      case DriveEvent::Action::hold:
      case DriveEvent::Action::keep:
      case DriveEvent::Action::end:
        enter(s, DriveState::stopping, time, 0.0);
    }
  }
};

}  // namespace bondlab

#endif
