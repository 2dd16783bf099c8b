// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the contact of two grains: linear springs with Coulomb friction, for unbonded pairs and, in
// parallel to the bond, for bonded ones.
//
// Law (Potyondy & Cundall 2004, sec. 2.1): normal stiffness of a grain from a modulus,
//     k = 4 R E_c (3D sphere),  k = 2 t E_c (2D disc of thickness t),   N/m
// two grains in series, k_n = k_i k_j / (k_i + k_j); shear stiffness k_s = k_n / (k_n/k_s);
//     F_n = k_n max(0, d_ref - d)            no tension
//     F_s += k_s du_s, then |F_s| <= mu F_n.
//
// d_ref is R_i + R_j for a new pair. For a pair that was bonded it is the distance at bonding, until
// the pair first separates: otherwise the contact of a packing with overlaps or gaps would be loaded
// by the act of bonding (PHYSICS.md 3.1). Nothing here depends on whether the bond is alive, so a
// break leaves the contact force as it was.
//
// Units: m, N, N/m. Failure: none; a NaN coming in goes out. Limits: no rolling resistance, no
// viscous term (damping is a fix).
#ifndef BONDLAB_LAWS_GRAIN_CONTACT_H
#define BONDLAB_LAWS_GRAIN_CONTACT_H

#include <cmath>

#include "bond_batch.h"
#include "pair_geometry.h"

namespace bondlab::laws {

inline double grain_stiffness_3d(double radius, double modulus) { return 4.0 * radius * modulus; }
inline double grain_stiffness_2d(double thickness, double modulus) {
  return 2.0 * thickness * modulus;
}
inline double in_series(double a, double b) { return a > 0.0 && b > 0.0 ? a * b / (a + b) : 0.0; }

// Constants of one block of contacts. Shapes: [kBlock] each.
struct ContactParameters {
  const double* reference;  // d_ref, m
  const double* kn;         // N/m
  const double* ks;         // N/m
  const double* mu;         // 1
};

struct ContactForce3 {
  double normal;  // compression positive, N
  Vec3 shear;     // on i, N
};

inline ContactForce3 contact_force(const PairStep3& p, Vec3 stored, double reference, double kn,
                                   double ks, double mu) {
  const double overlap = reference - p.distance;
  const double normal = overlap > 0.0 ? kn * overlap : 0.0;
  Vec3 fs = p.carried(stored) + ks * p.shear;
  const double size = std::sqrt(dot(fs, fs)), limit = mu * normal;
  const double keep = size > limit ? limit / size : 1.0;  // limit is 0 when apart
  return {normal, keep * fs};
}

struct ContactForce2 {
  double normal, shear;  // N; shear on i along t = z x e
};

inline ContactForce2 contact_force(const PairStep2& p, double stored, double reference, double kn,
                                   double ks, double mu) {
  const double overlap = reference - p.distance;
  const double normal = overlap > 0.0 ? kn * overlap : 0.0;
  const double fs = stored + ks * p.shear, limit = mu * normal;
  return {normal, fs > limit ? limit : (fs < -limit ? -limit : fs)};
}

// A whole block of unbonded contacts, 3D. shear_*: state, [kBlock], read; written when `advance`.
inline void contact_block_3d(const Kinematics3& k, const ContactParameters& c, bool advance,
                             double* __restrict shear_x, double* __restrict shear_y,
                             double* __restrict shear_z, PairLoads3& out) {
  const double keep_state = advance ? 1.0 : 0.0;
  const double *__restrict reference = c.reference, *__restrict kn = c.kn, *__restrict ks = c.ks,
               *__restrict mu = c.mu;
#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const PairStep3 p({k.dx[b], k.dy[b], k.dz[b]}, {k.ux[b], k.uy[b], k.uz[b]},
                      {k.sx[b], k.sy[b], k.sz[b]}, {k.qx[b], k.qy[b], k.qz[b]});
    const Vec3 stored{shear_x[b], shear_y[b], shear_z[b]};
    const ContactForce3 f = contact_force(p, stored, reference[b], kn[b], ks[b], mu[b]);
    const Vec3 force = f.shear - f.normal * p.e;
    const double arm = p.distance * k.per_both[b];
    const Vec3 moment = cross(p.e, f.shear);
    out.fx[b] = force.x, out.fy[b] = force.y, out.fz[b] = force.z;
    const double ai = arm * k.ri[b], aj = arm * k.rj[b];
    out.tix[b] = ai * moment.x, out.tiy[b] = ai * moment.y, out.tiz[b] = ai * moment.z;
    out.tjx[b] = aj * moment.x, out.tjy[b] = aj * moment.y, out.tjz[b] = aj * moment.z;
    shear_x[b] = keep_state != 0.0 ? f.shear.x : stored.x;
    shear_y[b] = keep_state != 0.0 ? f.shear.y : stored.y;
    shear_z[b] = keep_state != 0.0 ? f.shear.z : stored.z;
  }
}

// The same in the plane.
inline void contact_block_2d(const Kinematics2& k, const ContactParameters& c, bool advance,
                             double* __restrict shear, PairLoads2& out) {
  const double keep_state = advance ? 1.0 : 0.0;
  const double *__restrict reference = c.reference, *__restrict kn = c.kn, *__restrict ks = c.ks,
               *__restrict mu = c.mu;
#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const PairStep2 p(k.dx[b], k.dy[b], k.ux[b], k.uy[b], k.s[b]);
    const double stored = shear[b];
    const ContactForce2 f = contact_force(p, stored, reference[b], kn[b], ks[b], mu[b]);
    out.fx[b] = -f.normal * p.ex - f.shear * p.ey;
    out.fy[b] = -f.normal * p.ey + f.shear * p.ex;
    const double arm = p.distance * k.per_both[b];
    out.ti[b] = arm * k.ri[b] * f.shear;
    out.tj[b] = arm * k.rj[b] * f.shear;
    shear[b] = keep_state != 0.0 ? f.shear : stored;
  }
}

// Elastic energy of a contact, J.
inline double contact_energy(double normal, double shear, double kn, double ks) {
  return (kn > 0.0 ? 0.5 * normal * normal / kn : 0.0) +
         (ks > 0.0 ? 0.5 * shear * shear / ks : 0.0);
}

}  // namespace bondlab::laws

#endif
