// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: local damping (Cundall): every component of force and torque is reduced while it speeds a
// particle up and increased while it slows it down.
//
// Law: F' = F - alpha |F| sign(v) for each degree of freedom; nothing where v = 0. An oscillator
// loses amplitude by sqrt((1-alpha)/(1+alpha)) each half cycle, which is a damping ratio of
// alpha/pi whatever its frequency (PHYSICS.md 3.4). Method: a loop over the contiguous components
// without branches, which compilers vectorise; |F| sign(v) is a copied sign bit, and v = 0 a
// select.
//
// Source: Cundall 1987, "Distinct element models of rock and soil structure"; Itasca PFC manual.
// Units: any; alpha in [0, 1). Failure: none; NaN stays NaN. Limits: not Galilean invariant: the
// reference at rest is that of the platens; wrong for free flight, impact and waves.
#ifndef BONDLAB_LOCAL_DAMPING_H
#define BONDLAB_LOCAL_DAMPING_H

#include <cmath>
#include <cstddef>

namespace bondlab {

inline double locally_damped(double force, double velocity, double alpha) {
  const double against = std::copysign(alpha * force, velocity);  // of size |alpha F|
  return force - (velocity == 0.0 ? 0.0 : against);
}

// The part of a damped force that damping added: locally_damped() backwards. alpha < 1.
inline double damping_part(double damped, double velocity, double alpha) {
  const double speeds_up = damped * velocity;
  if (speeds_up == 0.0) return 0.0;
  return speeds_up > 0.0 ? -alpha / (1.0 - alpha) * damped : alpha / (1.0 + alpha) * damped;
}

inline void damp_locally(double *__restrict force, const double *__restrict velocity,
                         std::size_t count, double alpha) {
  for (std::size_t k = 0; k < count; ++k) force[k] = locally_damped(force[k], velocity[k], alpha);
}

}  // namespace bondlab

#endif
