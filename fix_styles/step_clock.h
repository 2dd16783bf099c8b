// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the time at a step, the same bits whether a run is done in one piece, in several, or after a
// restart.
//
// Method: time = base + (step - base step) dt, with a new base only when dt changes. The engine's
// own time is rounded anew at every end of a run, and a restart file doesn't hold it.
//
// Units: s. Failure: none.
#ifndef BONDLAB_STEP_CLOCK_H
#define BONDLAB_STEP_CLOCK_H

#include <cstdint>

namespace bondlab {

struct StepClock {
  double base = 0.0;       // s
  double base_step = 0.0;  // a whole number; double, so that a restart is a list of doubles
  double dt = 0.0;         // s; 0: not started
  double now = 0.0;        // s
  double step = 0.0;

  bool started() const { return dt > 0.0; }
  void start(double time, std::int64_t at_step, double time_step) {
    base = now = time;
    base_step = step = static_cast<double>(at_step);
    dt = time_step;
  }
  // To a later step with the time step that led there since the last call.
  void advance(std::int64_t to_step, double time_step) {
    if (time_step != dt) {
      base = now;
      base_step = step;
      dt = time_step;
    }
    step = static_cast<double>(to_step);
    now = base + (step - base_step) * dt;
  }
  double at(std::int64_t any_step) const {
    return base + (static_cast<double>(any_step) - base_step) * dt;
  }
  // Steps are numbered anew; time goes on.
  void renumber(std::int64_t to, std::int64_t from) {
    base_step += static_cast<double>(to - from);
    step += static_cast<double>(to - from);
  }
};

}  // namespace bondlab

#endif
