// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the part of a Norton bond's step that has no directions, one lane: what is left of the trial
// stresses after creep and yield, whether the bond stands, what it carries, and where the energy went.
//
// See norton.h for the law. Energy: over a step with the irreversible displacement p the ends' work is
// 1/2 (F_old + F_new) (dF/k + p), of which 1/2 (F_old + F_new) p is lost; so what is returned here closes
// the balance with the work of the trapezoid rule, which is the one velocity Verlet keeps, to rounding.
// The same code serves the round section and the strip of 2D, whose twist terms are zero.
// Units: Pa, m, J. Failure: none, NaN in, NaN out. Limits: selects of numbers only, no branches and no
// truth values kept, so that the loop around it vectorises.
#ifndef BONDLAB_LAWS_NORTON_LANE_H
#define BONDLAB_LAWS_NORTON_LANE_H

#include <cmath>

#include "bond_options.h"
#include "bond_section.h"
#include "norton_step.h"

namespace bondlab::laws {

struct NortonTrial {
  double stress, tau2, bend2, twist2;     // Pa, Pa2, (N m)2
  double stress_old, tau_old, bend_old, twist_old;  // of the last step; but the first, its product
                                                    // with the trial value
  double lost_n, lost_s, lost_b, lost_t;  // shares that creep
  double modulus_n, modulus, shear;       // E of the stress' side, E, G/E
  double length, radius, beta, alive;
  double sigma_c, tau_c, crush_c, yield_t, yield_c, yield_s;
  double failure, worst;  // softening
  double remains;         // 0: no strain remains of what yield cuts off
};

struct NortonLane {
  double stress;                           // Pa
  double keep_s, keep_b, keep_t;           // what is left of trial shear force and moments
  double hold;                             // 1 intact, 0 broken
  double carried_n, carried_s;             // shares of the effective forces that act
  double sigma, tau, fate;
  double strain, dissipated, worst, lost;  // changes of the state; `worst` itself
};

template <bool advance, bool options>
[[gnu::always_inline]] inline NortonLane norton_lane(const NortonTrial &in, const BondSection &at) {
  NortonLane r;
  const double crept = in.stress - in.stress * in.lost_n;
  const double below = crept > in.yield_t ? in.yield_t : crept;
  const double s = below < -in.yield_c ? -in.yield_c : below;
  const double tau_trial = std::sqrt(in.tau2), tau_crept = tau_trial - tau_trial * in.lost_s;
  const double tau_now = tau_crept > in.yield_s ? in.yield_s : tau_crept;
  r.stress = s;
  const double capped = tau_now / (tau_crept > 0.0 ? tau_crept : 1.0);  // 1 but where it yields
  const double lost_s = in.lost_s + (1.0 - in.lost_s) * (1.0 - capped);
  r.keep_s = 1.0 - lost_s;
  r.keep_b = 1.0 - in.lost_b, r.keep_t = 1.0 - in.lost_t;

  const double rim = in.beta * in.radius;
  const double bend = rim * (r.keep_b * std::sqrt(in.bend2)) * at.per_bend;
  const double tau = tau_now + rim * (r.keep_t * std::sqrt(in.twist2)) * at.per_twist;
  const double sigma = s + bend, pressed = bend - s;
  const double per_modulus = 1.0 / in.modulus, per_shear = 1.0 / (in.modulus * in.shear);
  const double per_normal = options ? 1.0 / in.modulus_n : per_modulus;
  const double half_length = 0.5 * in.length, half_volume = half_length * at.area;
  double share = 1.0, before = 1.0;  // of the effective load that is carried, and at the last step
  double stands, cause;
  r.worst = 0.0;
  if constexpr (options) {
    const double in_tension = sigma / in.sigma_c, in_shear = tau / in.tau_c;
    const double crushed = pressed / in.crush_c;
    const double other = in_shear > crushed ? in_shear : crushed;
    const double factor = in_tension > other ? in_tension : other;
    const double reached = factor > in.worst ? factor : in.worst;
    r.worst = !advance || in.alive == 0.0 ? in.worst : reached;
    share = integrity(r.worst, in.failure);
    before = integrity(in.worst, in.failure);
    stands = share == 0.0 ? 0.0 : in.alive;
    // brittle: in the order of the branch below; softening: the largest of the three rules
    const bool brittle = in.failure <= 1.0;
    const bool torn = (in_tension >= other) | (brittle & (in_tension >= 1.0));
    const bool slid = (in_shear >= crushed) | (brittle & (in_shear >= 1.0));
    cause = torn ? 1.0 : (slid ? 2.0 : 3.0);
  } else {
    const double no_crushing = pressed >= in.crush_c ? 0.0 : in.alive;
    const double no_shear = tau >= in.tau_c ? 0.0 : no_crushing;
    stands = sigma >= in.sigma_c ? 0.0 : no_shear;
    cause = sigma >= in.sigma_c ? 1.0 : (tau >= in.tau_c ? 2.0 : 3.0);
  }
  r.hold = advance ? stands : in.alive;
  r.carried_s = r.hold * share;
  r.carried_n = s > 0.0 ? r.carried_s : r.hold;
  r.sigma = in.alive * sigma;
  r.tau = in.alive * tau;
  r.fate = r.hold == in.alive ? 0.0 : cause;

  const double cut = in.remains * (crept - s);
  r.strain = in.alive * (in.stress * in.lost_n + cut) * per_normal;
  const double normal = (in.stress_old + s) * (in.stress * in.lost_n + cut) * per_normal;
  const double shear = lost_s * (in.tau_old + r.keep_s * in.tau2) * per_shear;
  const double moments =
      in.lost_b * (in.bend_old + r.keep_b * in.bend2) * per_modulus * at.per_bend +
      in.lost_t * (in.twist_old + r.keep_t * in.twist2) * per_shear * at.per_twist;
  // Creep comes before softening in a step: it takes from what the bond carried until then.
  const double open = in.stress > 0.0 ? before : 1.0;
  r.dissipated = in.alive * (half_volume * (open * normal + before * shear) +
                             half_length * before * moments);
  r.lost = 0.0;
  if constexpr (options) {
    // Softening eats of the energy that the share scales.
    const double opening = s > 0.0 ? s * s * per_normal : 0.0;
    const double scaled =
        half_volume * (opening + tau_now * tau_now * per_shear) +
        half_length * (in.bend2 * (r.keep_b * r.keep_b) * per_modulus * at.per_bend +
                       in.twist2 * (r.keep_t * r.keep_t) * per_shear * at.per_twist);
    // With the last of it goes what the bond carried in compression.
    const double closed = s > 0.0 ? 0.0 : half_volume * s * s * per_normal;
    r.lost = in.alive * softening_loss(in.worst, r.worst, in.failure, scaled, closed);
  }
  return r;
}

// Elastic energy of an intact bond, J. Effective forces N, moments N m; share: carried part.
inline double norton_energy(double stress, double modulus_n, double fs, double mb, double mt,
                            double modulus, double shear, double length, double share,
                            const BondSection &at) {
  const double G = modulus * shear;
  const double normal = stress * stress / modulus_n * at.area * (stress > 0.0 ? share : 1.0);
  const double rest = fs * fs / G * at.per_area + mb * mb / modulus * at.per_bend +
                      mt * mt / G * at.per_twist;
  return 0.5 * length * (normal + share * rest);
}

}  // namespace bondlab::laws

#endif
