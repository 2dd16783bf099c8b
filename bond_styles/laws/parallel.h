// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the parallel bond: a disc of elastic cement between two grains that carries normal and shear
// force, bending and twisting moment, and breaks when the stress at its rim reaches a strength.
//
// Law: Potyondy & Cundall 2004, Int. J. Rock Mech. Min. Sci. 41, 1329-1364, sec. 2.2, eqs. 11-16,
// in total form for the normal force (an incremental one drifts with the time step) and in
// incremental, rotation-carried form for the others:
//     F_n  = kbar_n A (d - d_0)                 tension positive
//     F_s += kbar_s A du_s,   M_t += kbar_s J dtheta_t,   M_b += kbar_n I dtheta_b     (acting on i)
//     kbar_n = E_b / (R_i + R_j)  Pa/m,  kbar_s = kbar_n / (k_n/k_s)
//     R_b = lambda min(R_i, R_j)
//     3D: A = pi R_b^2,  I = pi R_b^4/4,  J = pi R_b^4/2
//     2D (disc of thickness t): A = 2 R_b t,  I = 2 R_b^3 t/3,  no twist
//     sigma = F_n/A + beta |M_b| R_b/I     breaks when sigma >= sigma_c   (looked at first)
//     tau   = |F_s|/A + beta |M_t| R_b/J   breaks when tau >= tau_c - sigma_n tan(phi_b)
// sigma_n = F_n/A alone, without the moment part (PFC's later form with cohesion tau_c and friction
// angle phi_b; phi_b = 0 is the law of 2004). beta is the moment contribution factor.
// Names: "bend" is about an axis across the bond, "twist" about the bond. Papers differ.
//
// Compression never breaks the bond in tension: F_n has its sign in the criterion.
// On a break the bond's force and moment vanish at once and its state is set to zero; the grain
// contact in parallel is computed by grain_contact.h and is not touched.
//
// Options (bond_options.h): another modulus in tension, softening, a dashpot parallel to the bond. The
// stresses above are then those of the undamaged elastic forces, which are what the state holds.
//
// Units: m, N, N m, Pa. Failure: none; NaN in, NaN out (the caller watches). Limits: strength is
// looked at once a step, so the overshoot is rate x dt x stiffness.
#ifndef BONDLAB_LAWS_PARALLEL_H
#define BONDLAB_LAWS_PARALLEL_H

#include <cmath>

#include "bond_options.h"
#include "bond_section.h"
#include "grain_contact.h"

namespace bondlab::laws {

// Constants of a bond type.
struct ParallelParameters {
  double modulus = 0.0;       // E_b, Pa
  double ratio = 1.0;         // k_n/k_s of the bond, 1
  double lambda = 1.0;        // radius multiplier, 1
  double beta = 1.0;          // moment contribution factor, 1
  double tan_phi = 0.0;       // tangent of the bond's friction angle, 1
  double thickness = 1.0;     // t of 2D discs, m
};

// Arrays of one block of bonds. Shapes: [kBlock] each. Constants of the type are broadcast by the
// caller, so that a block may mix types.
struct ParallelArrays3 {
  // constants
  const double* rest;      // d_0, distance at bonding, m
  const double* radius;    // R_b, m
  const double* stiffness; // kbar_n, Pa/m
  const double* ratio;     // k_n/k_s of the bond
  const double* beta;
  const double* tan_phi;
  const double* sigma_c;   // Pa
  const double* tau_c;     // Pa
  // state, read; written when advancing
  double *alive;           // 1 intact, 0 broken
  double *fsx, *fsy, *fsz; // shear force on i, N
  double *mbx, *mby, *mbz; // bending moment on i, N m
  double *mt;              // twisting moment on i, N m
  // report of the step, written
  double *sigma, *tau;     // rim stresses before any break, Pa
  double* fate;            // BondFate as a number: doubles alone keep the loop vectorised
};

struct ParallelArrays2 {
  const double *rest, *radius, *stiffness, *ratio, *beta, *tan_phi, *sigma_c, *tau_c;
  double thickness;        // m
  double *alive;
  double *fs;              // shear force on i along t = z x e, N
  double *mb;              // bending moment on i about z, N m
  double *sigma, *tau;
  double* fate;
};

// A bond's trial state without its directions, one lane; the same for 3D and 2D.
struct ParallelTrial {
  double fn, fs, mb, mt;         // effective loads: normal with its sign, the others' sizes; N, N m
  double kn, ks, opening;        // Pa/m; kn as in compression; E_t/E_c where fn pulls, else 1
  double alive, sigma_c, tau_c, tan_phi, rim;  // rim = beta R_b
  double failure, worst;         // softening, state of the last step
};
struct ParallelLane {
  double hold;                  // 1 intact, 0 broken
  double carried_n, carried_s;  // shares of the effective loads that act
  double sigma, tau, fate;
  double worst, softened;       // state; energy that softening takes in this step, J
};

// Criterion and softening.
template <bool advance, bool options>
[[gnu::always_inline]] inline ParallelLane parallel_lane(const ParallelTrial& in, const BondSection& at) {
  ParallelLane r;
  const double sigma_n = in.fn * at.per_area;
  const double sigma = sigma_n + in.rim * in.mb * at.per_bend;
  const double tau = in.fs * at.per_area + in.rim * in.mt * at.per_twist;
  const double shear_strength = in.tau_c - sigma_n * in.tan_phi;
  bool tension = sigma >= in.sigma_c;
  bool shear = tau >= shear_strength;
  double share = 1.0;
  r.worst = r.softened = 0.0;
  if constexpr (options) {
    // s of a bond whose shear strength is used up by tension alone is without bound
    const double opened = sigma / in.sigma_c;
    const double slid = shear_strength > 0.0 ? tau / shear_strength : (shear ? 1e300 : 0.0);
    const double factor = opened > slid ? opened : slid;
    r.worst = !advance || in.worst > factor ? in.worst : factor;
    share = integrity(r.worst, in.failure);
    const bool broken = r.worst >= in.failure;
    // brittle: tension is looked at first; softening: the larger of the two rules
    tension = broken & ((opened >= slid) | ((in.failure <= 1.0) & (opened >= 1.0)));
    shear = broken & !tension;
    const double pressed = in.fn > 0.0 ? 0.0 : in.fn;
    const double closed = 0.5 * pressed * pressed * at.per_area / in.kn;
    const double stored = option_energy(in.fn > 0.0 ? in.fn : 0.0, in.fs * in.fs, in.mb * in.mb, in.mt * in.mt,
                                        in.kn * in.opening, in.ks, in.kn, at);
    r.softened = in.alive * softening_loss(in.worst, r.worst, in.failure, stored, closed);
  }
  r.hold = advance ? ((tension | shear) ? 0.0 : in.alive) : in.alive;
  r.carried_s = r.hold * share;
  r.carried_n = in.fn > 0.0 ? r.carried_s : r.hold;
  r.sigma = in.alive * sigma;
  r.tau = in.alive * tau;
  r.fate = !advance || in.alive == 0.0 ? 0.0 : (tension ? 1.0 : (shear ? 2.0 : 0.0));
  return r;
}

// The dashpots beside the bond's springs, N s/m and N m s per step: `viscous` in steps.
struct ParallelDashpots {
  double normal, shear, bend, twist;
};
inline ParallelDashpots parallel_dashpots(double viscous, double kn, double ks, const BondSection& at) {
  const double vn = viscous * kn, vs = viscous * ks;
  return {vn * at.area, vs * at.area, vn * at.bend, vs * at.twist};
}

// One block in 3D: bond and grain contact together; `out` gets their sum.
// advance = false computes the loads of the stored state and changes nothing (set-up of a run).
// options, contact = false leave these parts out; their pointers are then not read.
template <bool advance, bool options = false, bool contact = true>
void parallel_block_3d(const Kinematics3& k, const ParallelArrays3& a, const ContactParameters& c,
                       double* __restrict csx, double* __restrict csy, double* __restrict csz,
                       PairLoads3& out, const OptionArrays& o = {}) {
  // Local restrict pointers: through the structs the compiler must reload them at every store.
  const double *__restrict rest = a.rest, *__restrict radius = a.radius,
               *__restrict stiffness = a.stiffness, *__restrict ratio = a.ratio,
               *__restrict beta = a.beta, *__restrict tan_phi = a.tan_phi,
               *__restrict sigma_c = a.sigma_c, *__restrict tau_c = a.tau_c,
               *__restrict reference = c.reference, *__restrict kn_c = c.kn,
               *__restrict ks_c = c.ks, *__restrict mu_c = c.mu;
  double *__restrict alive_b = a.alive, *__restrict sigma_b = a.sigma, *__restrict tau_b = a.tau,
         *__restrict fate_b = a.fate;
  double *__restrict fsx = a.fsx, *__restrict fsy = a.fsy, *__restrict fsz = a.fsz,
         *__restrict mbx = a.mbx, *__restrict mby = a.mby, *__restrict mbz = a.mbz,
         *__restrict mt_b = a.mt;
  const double *__restrict tension_o = o.tension, *__restrict failure_o = o.failure,
               *__restrict viscous_o = o.viscous;
  double *__restrict worst_o = o.worst, *__restrict lost_o = o.lost;
#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const Vec3 d{k.dx[b], k.dy[b], k.dz[b]}, u{k.ux[b], k.uy[b], k.uz[b]};
    const PairStep3 p(d, u, {k.sx[b], k.sy[b], k.sz[b]}, {k.qx[b], k.qy[b], k.qz[b]});
    ContactForce3 grain{0.0, {0.0, 0.0, 0.0}};
    if constexpr (contact)
      grain = contact_force(p, Vec3{csx[b], csy[b], csz[b]}, reference[b], kn_c[b], ks_c[b], mu_c[b]);
    const double R = radius[b], R2 = R * R, inverse = 1.0 / (R2 * ratio[b]);
    const BondSection section = round_section(R, inverse * ratio[b]);
    const double kn = stiffness[b], ks = kn * (inverse * R2), alive = alive_b[b];
    double fn = kn * section.area * (p.distance - rest[b]);
    double opening = 1.0, failure = 1.0, worst = 0.0, viscous = 0.0;
    if constexpr (options) {  // read before any choice is made: a load in a branch isn't vectorised
      opening = tension_o[b], failure = failure_o[b], worst = worst_o[b], viscous = viscous_o[b];
      opening = fn > 0.0 ? opening : 1.0;
      fn *= opening;
    }
    const Vec3 fs = p.carried(Vec3{fsx[b], fsy[b], fsz[b]}) + (ks * section.area) * p.shear;
    const Vec3 mb = p.carried(Vec3{mbx[b], mby[b], mbz[b]}) + (kn * section.bend) * p.bend;
    const double mt = mt_b[b] + ks * section.twist * p.twist;
    const ParallelLane r = parallel_lane<advance, options>(
        {fn, std::sqrt(dot(fs, fs)), std::sqrt(dot(mb, mb)), std::fabs(mt), kn, ks, opening, alive, sigma_c[b],
         tau_c[b], tan_phi[b], beta[b] * R, failure, worst},
        section);
    sigma_b[b] = r.sigma, tau_b[b] = r.tau, fate_b[b] = r.fate;

    // The contact comes last: blocks with and without one must round alike.
    double along = r.carried_n * fn, twist = r.carried_s * mt;
    Vec3 across = r.carried_s * fs, bend = r.carried_s * mb;
    if constexpr (options) {  // dashpots, with the motion of the step
      const ParallelDashpots v = parallel_dashpots(viscous * r.hold, kn, ks, section);
      const double stretch = stretched(p, u, d);
      along += v.normal * stretch, twist += v.twist * p.twist;
      across = across + v.shear * p.shear, bend = bend + v.bend * p.bend;
      if constexpr (advance) {
        lost_o[b] += r.softened + v.normal * stretch * stretch + v.shear * dot(p.shear, p.shear) +
                     v.bend * dot(p.bend, p.bend) + v.twist * p.twist * p.twist;
        worst_o[b] = r.worst;
      }
    }

    across = grain.shear + across;
    along -= grain.normal;
    const Vec3 force = across + along * p.e, moment = bend + twist * p.e;
    const double arm = p.distance * k.per_both[b];
    const double ai = arm * k.ri[b], aj = arm * k.rj[b];
    const Vec3 lever = cross(p.e, across);
    out.fx[b] = force.x, out.fy[b] = force.y, out.fz[b] = force.z;
    out.tix[b] = moment.x + ai * lever.x, out.tiy[b] = moment.y + ai * lever.y;
    out.tiz[b] = moment.z + ai * lever.z;
    out.tjx[b] = aj * lever.x - moment.x, out.tjy[b] = aj * lever.y - moment.y;
    out.tjz[b] = aj * lever.z - moment.z;
    if (advance) {
      alive_b[b] = r.hold;
      fsx[b] = r.hold * fs.x, fsy[b] = r.hold * fs.y, fsz[b] = r.hold * fs.z;
      mbx[b] = r.hold * mb.x, mby[b] = r.hold * mb.y, mbz[b] = r.hold * mb.z;
      mt_b[b] = r.hold * mt;
      if constexpr (contact) csx[b] = grain.shear.x, csy[b] = grain.shear.y, csz[b] = grain.shear.z;
    }
  }
}

// The same in the plane.
template <bool advance, bool options = false, bool contact = true>
void parallel_block_2d(const Kinematics2& k, const ParallelArrays2& a, const ContactParameters& c,
                       double* __restrict cs, PairLoads2& out, const OptionArrays& o = {}) {
  const double *__restrict rest = a.rest, *__restrict radius = a.radius,
               *__restrict stiffness = a.stiffness, *__restrict ratio = a.ratio,
               *__restrict beta = a.beta, *__restrict tan_phi = a.tan_phi,
               *__restrict sigma_c = a.sigma_c, *__restrict tau_c = a.tau_c,
               *__restrict reference = c.reference, *__restrict kn_c = c.kn,
               *__restrict ks_c = c.ks, *__restrict mu_c = c.mu;
  double *__restrict alive_b = a.alive, *__restrict sigma_b = a.sigma, *__restrict tau_b = a.tau,
         *__restrict fate_b = a.fate, *__restrict fs_b = a.fs, *__restrict mb_b = a.mb;
  const double *__restrict tension_o = o.tension, *__restrict failure_o = o.failure,
               *__restrict viscous_o = o.viscous;
  double *__restrict worst_o = o.worst, *__restrict lost_o = o.lost;
  const double thickness = a.thickness;
#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const PairStep2 p(k.dx[b], k.dy[b], k.ux[b], k.uy[b], k.s[b]);
    ContactForce2 grain{0.0, 0.0};
    if constexpr (contact) grain = contact_force(p, cs[b], reference[b], kn_c[b], ks_c[b], mu_c[b]);
    const BondSection section = strip_section(radius[b], thickness);
    const double kn = stiffness[b], ks = kn / ratio[b], alive = alive_b[b];
    double fn = kn * section.area * (p.distance - rest[b]);
    double opening = 1.0, failure = 1.0, worst = 0.0, viscous = 0.0;
    if constexpr (options) {
      opening = tension_o[b], failure = failure_o[b], worst = worst_o[b], viscous = viscous_o[b];
      opening = fn > 0.0 ? opening : 1.0;
      fn *= opening;
    }
    const double fs = fs_b[b] + ks * section.area * p.shear;
    const double mb = mb_b[b] + kn * section.bend * k.q[b];
    const ParallelLane r = parallel_lane<advance, options>(
        {fn, std::fabs(fs), std::fabs(mb), 0.0, kn, ks, opening, alive, sigma_c[b], tau_c[b], tan_phi[b],
         beta[b] * radius[b], failure, worst},
        section);
    sigma_b[b] = r.sigma, tau_b[b] = r.tau, fate_b[b] = r.fate;

    double along = r.carried_n * fn, across = r.carried_s * fs, bend = r.carried_s * mb;
    if constexpr (options) {
      const ParallelDashpots v = parallel_dashpots(viscous * r.hold, kn, ks, section);
      const double stretch = stretched(p, k.ux[b], k.uy[b], k.dx[b], k.dy[b]);
      along += v.normal * stretch, across += v.shear * p.shear, bend += v.bend * k.q[b];
      if constexpr (advance) {
        lost_o[b] += r.softened + v.normal * stretch * stretch + v.shear * p.shear * p.shear +
                     v.bend * k.q[b] * k.q[b];
        worst_o[b] = r.worst;
      }
    }

    along -= grain.normal, across += grain.shear;
    const double arm = p.distance * k.per_both[b];
    out.fx[b] = along * p.ex - across * p.ey;
    out.fy[b] = along * p.ey + across * p.ex;
    out.ti[b] = bend + arm * k.ri[b] * across;
    out.tj[b] = arm * k.rj[b] * across - bend;
    if (advance) {
      alive_b[b] = r.hold;
      fs_b[b] = r.hold * fs;
      mb_b[b] = r.hold * mb;
      if constexpr (contact) cs[b] = grain.shear;
    }
  }
}

// Elastic energy of an intact bond, J. Forces N, moments N m, stiffness Pa/m.
inline double parallel_energy(double fn, double fs, double mb, double mt, double kn, double ks,
                              const BondSection& s) {
  double energy = 0.5 * fn * fn / (kn * s.area) + 0.5 * mb * mb / (kn * s.bend);
  if (ks > 0.0) {
    energy += 0.5 * fs * fs / (ks * s.area);
    if (s.twist > 0.0) energy += 0.5 * mt * mt / (ks * s.twist);
  }
  return energy;
}

}  // namespace bondlab::laws

#endif
