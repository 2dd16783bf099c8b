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

// Cross-section of a bond. Areas m^2, second moments m^4.
struct BondSection {
  double area, bend, twist;
};
inline constexpr double kPi = 3.14159265358979323846;
inline BondSection round_section(double radius) {
  const double r2 = radius * radius, area = kPi * r2;
  return {area, 0.25 * area * r2, 0.5 * area * r2};
}
inline BondSection strip_section(double radius, double thickness) {
  return {2.0 * radius * thickness, 2.0 / 3.0 * radius * radius * radius * thickness, 0.0};
}

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
    const PairStep3 p({k.dx[b], k.dy[b], k.dz[b]}, {k.ux[b], k.uy[b], k.uz[b]},
                      {k.sx[b], k.sy[b], k.sz[b]}, {k.qx[b], k.qy[b], k.qz[b]});
    ContactForce3 grain{0.0, {0.0, 0.0, 0.0}};
    if constexpr (contact)
      grain = contact_force(p, Vec3{csx[b], csy[b], csz[b]}, reference[b], kn_c[b], ks_c[b], mu_c[b]);
    const BondSection section = round_section(radius[b]);
    const double kn = stiffness[b], ks = kn / ratio[b], alive = alive_b[b];
    double fn = kn * section.area * (p.distance - rest[b]);
    double opening = 1.0, failure = 1.0, viscous = 0.0, worst_before = 0.0;
    if constexpr (options) {  // read before any choice is made: a load in a branch isn't vectorised
      opening = tension_o[b], failure = failure_o[b], viscous = viscous_o[b];
      worst_before = worst_o[b];
      opening = fn > 0.0 ? opening : 1.0;
      fn *= opening;
    }
    const Vec3 fs = p.carried(Vec3{fsx[b], fsy[b], fsz[b]}) + (ks * section.area) * p.shear;
    const Vec3 mb = p.carried(Vec3{mbx[b], mby[b], mbz[b]}) + (kn * section.bend) * p.bend;
    const double mt = mt_b[b] + ks * section.twist * p.twist;

    const double inverse_area = 1.0 / section.area;
    const double rim = beta[b] * radius[b];
    const double sigma_n = fn * inverse_area;
    const double sigma = sigma_n + rim * std::sqrt(dot(mb, mb)) / section.bend;
    const double tau =
        std::sqrt(dot(fs, fs)) * inverse_area + rim * std::fabs(mt) / section.twist;
    const double shear_strength = tau_c[b] - sigma_n * tan_phi[b];
    bool tension = sigma >= sigma_c[b];
    bool shear = tau >= shear_strength;
    double hold, share = 1.0, worst = 0.0;
    if constexpr (options) {
      // s of a bond whose shear strength is used up by tension alone is without bound
      const double opened = sigma / sigma_c[b];
      const double slid = shear_strength > 0.0 ? tau / shear_strength : (shear ? 1e300 : 0.0);
      const double factor = opened > slid ? opened : slid;
      worst = !advance || worst_before > factor ? worst_before : factor;
      share = integrity(worst, failure);
      const bool broken = worst >= failure;
      // brittle: tension is looked at first; softening: the larger of the two rules
      tension = broken & ((opened >= slid) | ((failure <= 1.0) & (opened >= 1.0)));
      shear = broken & !tension;
    }
    hold = advance ? ((tension | shear) ? 0.0 : alive) : alive;
    sigma_b[b] = alive * sigma;
    tau_b[b] = alive * tau;
    fate_b[b] = !advance || alive == 0.0 ? 0.0 : (tension ? 1.0 : (shear ? 2.0 : 0.0));

    Vec3 fs_out = hold * fs, mb_out = hold * mb;
    double fn_out = hold * fn, mt_out = hold * mt;
    if constexpr (options) {
      fs_out = share * fs_out, mb_out = share * mb_out, mt_out *= share;
      fn_out *= fn > 0.0 ? share : 1.0;
      const double pressed = fn > 0.0 ? 0.0 : fn;
      const double closed = 0.5 * pressed * pressed / (kn * section.area);
      const double stored = option_energy(fn > 0.0 ? fn : 0.0, dot(fs, fs), dot(mb, mb), mt * mt,
                                          kn * opening, ks, kn,
                                          section.area, section.bend, section.twist);
      // dashpots, with the motion of the step
      const double vn = viscous * hold * kn * section.area;
      const double vs = viscous * hold * ks * section.area;
      const double vb = viscous * hold * kn * section.bend;
      const double vt = viscous * hold * ks * section.twist;
      const double stretch = stretched(p, Vec3{k.ux[b], k.uy[b], k.uz[b]}, Vec3{k.dx[b], k.dy[b], k.dz[b]});
      fn_out += vn * stretch;
      fs_out = fs_out + vs * p.shear;
      mb_out = mb_out + vb * p.bend;
      mt_out += vt * p.twist;
      if constexpr (advance) {
        lost_o[b] += alive * softening_loss(worst_before, worst, failure, stored, closed) + vn * stretch * stretch +
                     vs * dot(p.shear, p.shear) + vb * dot(p.bend, p.bend) + vt * p.twist * p.twist;
        worst_o[b] = worst;
      }
    }

    const Vec3 across = grain.shear + fs_out;
    const Vec3 force = across + (fn_out - grain.normal) * p.e;
    const Vec3 moment = mb_out + mt_out * p.e;
    const double arm = p.distance / (k.ri[b] + k.rj[b]);
    const double ai = arm * k.ri[b], aj = arm * k.rj[b];
    const Vec3 lever = cross(p.e, across);
    out.fx[b] = force.x, out.fy[b] = force.y, out.fz[b] = force.z;
    out.tix[b] = moment.x + ai * lever.x, out.tiy[b] = moment.y + ai * lever.y;
    out.tiz[b] = moment.z + ai * lever.z;
    out.tjx[b] = aj * lever.x - moment.x, out.tjy[b] = aj * lever.y - moment.y;
    out.tjz[b] = aj * lever.z - moment.z;
    if (advance) {
      alive_b[b] = hold;
      fsx[b] = hold * fs.x, fsy[b] = hold * fs.y, fsz[b] = hold * fs.z;
      mbx[b] = hold * mb.x, mby[b] = hold * mb.y, mbz[b] = hold * mb.z;
      mt_b[b] = hold * mt;
      if constexpr (contact) csx[b] = grain.shear.x, csy[b] = grain.shear.y, csz[b] = grain.shear.z;
    }
  }
}

// The same in the plane.
template <bool advance, bool options = false, bool contact = true>
void parallel_block_2d(const Kinematics2& k, const ParallelArrays2& a, const ContactParameters& c,
                       double* __restrict cs, PairLoads2& out, const OptionArrays& o = {}) {
  // Local restrict pointers: through the structs the compiler must reload them at every store.
  const double *__restrict rest = a.rest, *__restrict radius = a.radius,
               *__restrict stiffness = a.stiffness, *__restrict ratio = a.ratio,
               *__restrict beta = a.beta, *__restrict tan_phi = a.tan_phi,
               *__restrict sigma_c = a.sigma_c, *__restrict tau_c = a.tau_c,
               *__restrict reference = c.reference, *__restrict kn_c = c.kn,
               *__restrict ks_c = c.ks, *__restrict mu_c = c.mu;
  double *__restrict alive_b = a.alive, *__restrict sigma_b = a.sigma, *__restrict tau_b = a.tau,
         *__restrict fate_b = a.fate;
  double *__restrict fs_b = a.fs, *__restrict mb_b = a.mb;
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
    double opening = 1.0, failure = 1.0, viscous = 0.0, worst_before = 0.0;
    if constexpr (options) {  // read before any choice is made: a load in a branch isn't vectorised
      opening = tension_o[b], failure = failure_o[b], viscous = viscous_o[b];
      worst_before = worst_o[b];
      opening = fn > 0.0 ? opening : 1.0;
      fn *= opening;
    }
    const double fs = fs_b[b] + ks * section.area * p.shear;
    const double mb = mb_b[b] + kn * section.bend * k.q[b];

    const double inverse_area = 1.0 / section.area;
    const double sigma_n = fn * inverse_area;
    const double sigma = sigma_n + beta[b] * radius[b] * std::fabs(mb) / section.bend;
    const double tau = std::fabs(fs) * inverse_area;
    const double shear_strength = tau_c[b] - sigma_n * tan_phi[b];
    bool tension = sigma >= sigma_c[b];
    bool shear = tau >= shear_strength;
    double hold, share = 1.0, worst = 0.0;
    if constexpr (options) {
      const double opened = sigma / sigma_c[b];
      const double slid = shear_strength > 0.0 ? tau / shear_strength : (shear ? 1e300 : 0.0);
      const double factor = opened > slid ? opened : slid;
      worst = !advance || worst_before > factor ? worst_before : factor;
      share = integrity(worst, failure);
      const bool broken = worst >= failure;
      // brittle: tension is looked at first; softening: the larger of the two rules
      tension = broken & ((opened >= slid) | ((failure <= 1.0) & (opened >= 1.0)));
      shear = broken & !tension;
    }
    hold = advance ? ((tension | shear) ? 0.0 : alive) : alive;
    sigma_b[b] = alive * sigma;
    tau_b[b] = alive * tau;
    fate_b[b] = !advance || alive == 0.0 ? 0.0 : (tension ? 1.0 : (shear ? 2.0 : 0.0));

    double fn_out = hold * fn, fs_out = hold * fs, mb_out = hold * mb;
    if constexpr (options) {
      fs_out *= share, mb_out *= share;
      fn_out *= fn > 0.0 ? share : 1.0;
      const double pressed = fn > 0.0 ? 0.0 : fn;
      const double closed = 0.5 * pressed * pressed / (kn * section.area);
      const double stored = option_energy(fn > 0.0 ? fn : 0.0, fs * fs, mb * mb, 0.0,
                                          kn * opening, ks, kn,
                                          section.area, section.bend, 1.0);
      const double vn = viscous * hold * kn * section.area;
      const double vs = viscous * hold * ks * section.area;
      const double vb = viscous * hold * kn * section.bend;
      const double stretch = stretched(p, k.ux[b], k.uy[b], k.dx[b], k.dy[b]);
      fn_out += vn * stretch, fs_out += vs * p.shear, mb_out += vb * k.q[b];
      if constexpr (advance) {
        lost_o[b] += alive * softening_loss(worst_before, worst, failure, stored, closed) + vn * stretch * stretch +
                     vs * p.shear * p.shear + vb * k.q[b] * k.q[b];
        worst_o[b] = worst;
      }
    }

    const double along = fn_out - grain.normal, across = grain.shear + fs_out;
    const double arm = p.distance / (k.ri[b] + k.rj[b]);
    out.fx[b] = along * p.ex - across * p.ey;
    out.fy[b] = along * p.ey + across * p.ex;
    out.ti[b] = mb_out + arm * k.ri[b] * across;
    out.tj[b] = arm * k.rj[b] * across - mb_out;
    if (advance) {
      alive_b[b] = hold;
      fs_b[b] = hold * fs;
      mb_b[b] = hold * mb;
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
