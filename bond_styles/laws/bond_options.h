// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what every bond law can do besides its own formulas, each off by default: a different modulus
// in tension, softening after the peak with a fracture energy, viscous damping in the bond.
//
// A law is compiled twice, with and without them, so they cost nothing when off. Methods:
//
// Tension modulus. The normal stiffness is multiplied by E_t/E_c while the bond is longer than at
// bonding. The force is continuous, the energy 1/2 k (d - d_0)^2 with the k of its side.
//
// Softening (linear, irreversible; the usual secant damage of cohesive zones, e.g. Bazant & Oh 1983,
// Mater. Struct. 16, 155-177). Let s be the bond's load factor: the largest of the ratios stress over
// strength of its criterion, computed from the undamaged (effective) forces. With s_max the largest s
// so far, the bond carries the share
//     w = 1                                  s_max <= 1
//     w = (s_f / s_max - 1) / (s_f - 1)      1 < s_max < s_f
//     w = 0, the bond is broken              s_max >= s_f
// of its effective force and moment, but the whole of a compressive normal force (a crack closes).
// On a monotonic path the carried stress falls linearly with the stretch, and the area under the
// curve is the fracture energy G_f = 1/2 sigma_c^2 s_f / k with k the stiffness per area (Pa/m), so
//     s_f = 2 G_f k / sigma_c^2.     s_f <= 1: brittle, the bond breaks at s = 1.
// (k that of tension where the tension modulus differs.) The dissipation of a step is integrated exactly
// for a load that grows in proportion, so G_f comes out to rounding in any number of steps.
//
// Damping. A dashpot in parallel to each of the bond's springs, proportional to its stiffness:
// F = k tau_v du/dt with tau_v = 2 zeta / omega_0, omega_0 = sqrt(k_n A / m), m = m_i m_j/(m_i + m_j)
// (zeta: share of the critical damping of the axial vibration of the two). The dashpot's force is not
// part of the stresses of the criterion. It shortens the stable step by sqrt(1 + zeta^2) - zeta.
//
// Units: Pa, m, s, J/m2. Failure: none; parameters are checked by the caller.
// Limits: damage is one number a bond, the same for force and moments.
#ifndef BONDLAB_LAWS_BOND_OPTIONS_H
#define BONDLAB_LAWS_BOND_OPTIONS_H

#include <cmath>

#include "bond_section.h"
#include "pair_geometry.h"

namespace bondlab::laws {

// One block of bonds; shapes [kBlock] each. Null pointers in a law compiled without options.
struct OptionArrays {
  const double* tension = nullptr;  // E_t/E_c, 1: the same
  const double* failure = nullptr;  // s_f; 1: brittle
  const double* viscous = nullptr;  // tau_v / dt, 0: none
  double* worst = nullptr;          // state: s_max, read; written when advancing
  double* lost = nullptr;           // state: energy dissipated by damping and softening so far, J
};

// The share w of its effective load that a bond carries; 0: broken. One formula for all cases and a
// single choice at the end, so that loops over it are vectorised: (s_f - s)/(s_f - 1)/s, with nothing
// left at s = 1 if the bond is brittle.
inline double integrity(double worst, double failure) {
  const double span = failure > 1.0 ? failure - 1.0 : 1.0, reached = worst > 1.0 ? worst : 1.0;
  const double falling = (failure - reached) / (span * reached);
  const double left = falling > 0.0 ? falling : 0.0;
  return worst < 1.0 ? 1.0 : left;
}

// Energy that softening takes in a step, J: s_max goes from `before` to `worst`, at which the effective
// forces store `stored`. In proportional loading the stored energy at s is stored (s/worst)^2, and
// -integral of it dw, w as above, is (w_before - w_worst) stored at the geometric mean of the two s.
// With the last of it goes what the bond carried in compression, `closed`. A brittle break is not
// counted.
inline double softening_loss(double before, double worst, double failure, double stored,
                             double closed = 0.0) {
  const double from = before > 1.0 ? before : 1.0, to = worst < failure ? worst : failure;
  const double share = integrity(from, failure) - integrity(to, failure);
  const double gone = worst >= failure ? closed : 0.0;
  const double loss = share * stored * (from / worst) * (to / worst) + gone;
  return failure > 1.0 && to > from ? loss : 0.0;
}

// Elastic energy of effective forces, J, as far as damage takes it: tensile normal force, shear, bend
// and twist. Forces squared but the normal one; stiffness Pa/m.
inline double option_energy(double fn, double fs2, double mb2, double mt2, double kn, double ks,
                            double kb, const BondSection& at) {
  const double soft = ks > 0.0 ? 1.0 / ks : 0.0;
  return 0.5 * (fn * fn * at.per_area / kn + soft * (fs2 * at.per_area + mt2 * at.per_twist) +
                mb2 * at.per_bend / kb);
}

// Change of the distance of a pair over a step, m, without the cancellation of two distances:
// u.(d + d_0) / (|d| + |d_0|).
inline double stretched(const PairStep3& p, Vec3 u, Vec3 d) { return dot(u, d + (d - u)) * p.per_sum; }
inline double stretched(const PairStep2& p, double ux, double uy, double dx, double dy) {
  return (ux * (dx + dx - ux) + uy * (dy + dy - uy)) * p.per_sum;
}

// s_f of a bond with fracture energy G_f (J/m2), stiffness k per area (Pa/m) and strength (Pa).
inline double failure_factor(double fracture_energy, double stiffness, double strength) {
  const double factor = 2.0 * fracture_energy * stiffness / (strength * strength);
  return factor > 1.0 ? factor : 1.0;
}

// tau_v of a pair with normal stiffness k (N/m) and masses m_i, m_j (kg), damping ratio zeta.
inline double viscous_time(double zeta, double k, double mi, double mj) {
  return k > 0.0 ? 2.0 * zeta * std::sqrt(mi * mj / ((mi + mj) * k)) : 0.0;
}

}  // namespace bondlab::laws

#endif
