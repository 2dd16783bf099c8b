// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the contact of a particle with a rigid platen: linear springs and Coulomb friction.
//
// Law. Stiffness of the particle alone, the platen being rigid (Potyondy & Cundall 2004, sec. 2.1;
// PHYSICS.md 3.1), or proportional to the radius (ESyS-Particle: pi E_b r per touching sphere, that
// is K = pi E_b):
//     k_n = 4 R E (sphere),  2 t E (disc of thickness t),  K R;      k_s = k_n / (k_n/k_s)
//     F_n = k_n max(0, -gap), total: no drift and independent of the time step
//     F_s <- carried with the normal;  F_s -= k_s du_s;  |F_s| <= mu F_n.
// du_s is the motion of the particle at the contact point relative to the platen over the step,
// across the normal. The contact point is the point of the platen nearest to the particle, for the
// force on the particle and on the platen alike, so that angular momentum balances.
// Carrying is the smallest rotation that takes the old normal to the new one,
//     v' = v - (v.n) (n0 + n) / (1 + n0.n),
// which keeps the length; projecting on the new plane would let the force creep away along a curved
// platen. A platen does not turn, so there is no spin about the normal.
//
// Units: m, N, N/m, J. Failure: none; a NaN coming in goes out. Limits: no rolling resistance, no
// adhesion, no viscous term (damping is a fix); the normal turns by less than pi a step.
#ifndef BONDLAB_PLATEN_LAW_H
#define BONDLAB_PLATEN_LAW_H

#include <cmath>

#include "laws/grain_contact.h"
#include "platen_geometry.h"

namespace bondlab {

struct PlatenStiffness {
  enum class Kind { modulus, per_radius };
  Kind kind = Kind::modulus;
  double value = 0.0;      // E in Pa, or K in N/m2
  double thickness = 0.0;  // of discs, m; 0 for spheres

  double normal(double radius) const {
    if (kind == Kind::per_radius) return value * radius;
    return thickness > 0.0 ? laws::grain_stiffness_2d(thickness, value)
                           : laws::grain_stiffness_3d(radius, value);
  }
};

// What a particle remembers of a platen. No contact: both are zero vectors.
struct PlatenHistory {
  Vec3 shear{0, 0, 0};   // on the particle, N
  Vec3 normal{0, 0, 0};  // when shear was stored

  bool touching() const { return dot(normal, normal) > 0.0; }
};

struct PlatenContact {
  double kn, ks;    // N/m
  double friction;  // mu
};

struct PlatenForce {
  Vec3 force;     // on the particle, N
  double energy;  // in the springs, J
};

inline Vec3 carried_with_normal(Vec3 v, Vec3 n0, Vec3 n) {
  const double turn = 1.0 + dot(n0, n);
  if (turn < 1e-12) return {0, 0, 0};  // turned over: nothing of the old contact is left
  return v - (dot(v, n) / turn) * (n0 + n);
}

// For overlap > 0. `motion`: displacement of the particle's point of contact relative to the platen
// over the step, m. With advance = false the force is that of the stored state, which stays.
inline PlatenForce platen_force(const PlatenContact &c, double overlap, Vec3 normal, Vec3 motion,
                                bool advance, PlatenHistory &history) {
  const double fn = c.kn * overlap;
  Vec3 shear = history.shear;
  if (advance) {
    if (history.touching()) shear = carried_with_normal(shear, history.normal, normal);
    shear = shear - c.ks * (motion - dot(motion, normal) * normal);
    const double size = length(shear), limit = c.friction * fn;
    if (size > limit) shear = (limit / size) * shear;
    history.shear = shear;
    history.normal = normal;
  }
  const double shear_energy = c.ks > 0.0 ? 0.5 * dot(shear, shear) / c.ks : 0.0;
  return {fn * normal + shear, 0.5 * fn * overlap + shear_energy};
}

}  // namespace bondlab

#endif
