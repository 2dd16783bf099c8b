// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how far a platen has moved and how fast it moves: a speed reached by a smooth ramp, or a
// servo that holds a force.
//
// Method. Ramp: the speed rises as half a cosine wave, so that neither speed nor acceleration jumps
// and the specimen is not rung like a bell (PHYSICS.md 5.1),
//     v(t) = V (1 - cos(pi t/T))/2,   d(t) = V (t - (T/pi) sin(pi t/T))/2   for t < T,
//     v(t) = V,                       d(t) = V (t - T/2)                    after.
// The displacement is this closed form of the time, not a sum over steps: no drift, and a restart
// lands on the same bits.
// Servo: v = G (F - F_target), clipped to +-v_max, with F the force on the platen: the platen gives
// way to what pushes it until the push is as wanted. For a contact stiffness k (all touching
// particles, in series with the specimen) it settles without overshoot if G k dt < 1.
//
// Source: elementary. Units: s, m, m/s, N, m/(s N). Failure: none.
#ifndef BONDLAB_PLATEN_MOTION_H
#define BONDLAB_PLATEN_MOTION_H

#include <algorithm>
#include <cmath>

namespace bondlab {

inline constexpr double pi = 3.14159265358979323846;

// Displacement for V = 1 m/s, m.
inline double ramp_distance(double time, double ramp) {
  if (time <= 0.0) return 0.0;
  if (time >= ramp) return time - 0.5 * ramp;
  return 0.5 * (time - ramp / pi * std::sin(pi * time / ramp));
}

// Speed as a fraction of V. Zero at the start even without a ramp.
inline double ramp_speed(double time, double ramp) {
  if (time <= 0.0) return 0.0;
  if (time >= ramp) return 1.0;
  return 0.5 * (1.0 - std::cos(pi * time / ramp));
}

inline double servo_speed(double force, double target, double gain, double limit) {
  return std::clamp(gain * (force - target), -limit, limit);
}

}  // namespace bondlab

#endif
