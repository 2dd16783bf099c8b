// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the solid bond with creep: a cylinder of a material that is elastic at once and flows in time
// by Norton's power law, yields, and breaks when the stress at its rim reaches a strength.
//
// Law. Source: the solid bond of Dosta, Kozhar & Antonyuk in a reading that repairs the printed
// equations (seed paper 002, eqs. 10-15; every difference is listed in bond_norton.md):
//     strain   e = (d - d_0)/L, d the distance of the centres, L the bond's length
//     stress   s = E (e - e_p)              e_p: irreversible strain, a state of the bond
//     F_s += G A/L du_s,  M_t += G J/L dtheta_t,  M_b += E I/L dtheta_b
// and in a step, in this order: elastic trial; creep at held strain (norton_step.h: exact split
// step); yield, perfectly plastic, what is cut off added to e_p so that unloading is elastic (shear
// stress: radially, by its own yield stress); criterion
//     sigma = s + beta |M_b| R_b/I  >= sigma_max          tension (looked at first)
//     tau   = |F_s|/A + beta |M_t| R_b/J >= tau_max       shear
//     -s + beta |M_b| R_b/I >= crush_max                  crushing, never by default
// "bend" is about an axis across the bond, "twist" about the bond (the printed names are swapped).
// Sections as in parallel.h, options shared by all laws in bond_options.h. Stresses in creep and
// criteria are effective ones: softening scales what the bond carries, not what its material feels.
//
// Energy: what creep and yield take from the elastic energy is added to `dissipated` (norton_lane.h).
// Temperature: the caller hands over E(T), ln A(T) and strengths (temperature.h). Stored forces belong
// to the modulus they were computed with (`modulus_then`) and follow a change of it.
// Rate factor: a run c times faster than the laboratory gives the same curve with c A while it is
// quasi-static; the caller adds ln c to ln A.
// Creep may be advanced every n-th step only, with log_time = ln(n dt): the stress is then off by at
// most h/2, h = E A s^(m-1) n dt the share that creeps in such a step (norton_creep_test.cpp).
//
// Units: m, N, N m, Pa, s. Failure: none; NaN in, NaN out (the caller watches).
// Limits: strength is looked at once a step; moments don't yield; no thermal strain.
#ifndef BONDLAB_LAWS_NORTON_H
#define BONDLAB_LAWS_NORTON_H

#include <cmath>

#include "grain_contact.h"
#include "norton_lane.h"

namespace bondlab::laws {

inline constexpr double kNever = 1e300;  // a strength that is never reached, Pa

// Arrays of one block of bonds; shapes [kBlock].
struct NortonConstants {
  const double *length;                       // L, m
  const double *radius;                       // R_b, m
  const double *modulus;                      // E now, Pa
  const double *shear;                        // G/E
  const double *beta;                         // share of the moments in the criterion
  const double *sigma_c, *tau_c, *crush_c;    // strengths, Pa
  const double *yield_t, *yield_c, *yield_s;  // in tension, compression, shear, Pa
  const double *exponent;                     // m
  const double *log_creep;                    // ln A now, A in Pa^-m/s, with the rate factor
  const double *log_shear;                    // ln(A_s/A)
  const double *bend_shape;                   // c_b of norton_step.h
};
// State, read; written when advancing.
struct NortonArrays3 {
  NortonConstants c;
  const double *rest;          // d_0, m
  double *alive;               // 1 intact, 0 broken
  double *strain;              // e_p
  double *modulus_then;        // E of the stored forces, Pa; 0: a new bond
  double *dissipated;          // by creep and yield, J
  double *fsx, *fsy, *fsz;     // effective shear force on i, N
  double *mbx, *mby, *mbz;     // effective bending moment on i, N m
  double *mt;                  // effective twisting moment on i, N m
  double *sigma, *tau, *fate;  // report of the step, as in parallel.h
};
struct NortonArrays2 {
  NortonConstants c;
  double thickness;  // m
  const double *rest;
  double *alive, *strain, *modulus_then, *dissipated;
  double *fs;  // along t = z x e, N
  double *mb;  // about z, N m
  double *sigma, *tau, *fate;
};

// What creeps in this step: `none` and false in the steps between.
struct NortonStep {
  CreepKind creep = CreepKind::none;
  bool moments = false;
  double log_time = 0.0;  // ln of the time that creeps, s
  // Printed form: the stress is cut at its yield stress, but no strain remains of it.
  bool cut_only = false;
};

// Trial state of a block and how it is put together again: what passes between the loops.
struct alignas(64) NortonBlock {
  CreepBlock creep;
  double bend2[kBlock], twist2[kBlock];
  // of the last step, see NortonTrial
  double stress_old[kBlock], tau_old[kBlock], bend_old[kBlock], twist_old[kBlock];
  double lane[7][kBlock];  // what the lanes say, by the columns below

  enum { STRESS, KEEP_S, KEEP_B, KEEP_T, HOLD, CARRIED_N, CARRIED_S };
};

// Reduced stresses of the moments, then creep of everything.
inline void norton_creep(NortonBlock &t, const NortonConstants &c, const NortonStep &step,
                         bool advance, bool flat, double thickness) {
  if (advance && step.moments) {
    const double *__restrict radius = c.radius, *__restrict exponent = c.exponent,
                 *__restrict shape = c.bend_shape, *__restrict modulus = c.modulus,
                 *__restrict shear = c.shear;
    const double stiff = flat ? 2.0 / 3.0 : 0.25 * kPi;
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const double R = radius[b], m = exponent[b], cube = R * R * (flat ? thickness : R);
      const double per_bend = 1.0 / (shape[b] * cube);
      const double per_twist = (3.0 * m + 1.0) / (2.0 * kPi * m * cube);  // 1/(c_t R^3)
      t.creep.bend2[b] = t.bend2[b] * (per_bend * per_bend);
      t.creep.twist2[b] = t.twist2[b] * (per_twist * per_twist);
      t.creep.bend[b] = modulus[b] * stiff / shape[b];
      t.creep.twist[b] = modulus[b] * shear[b] * (3.0 * m + 1.0) / (4.0 * m);  // G (pi/2)/c_t
    }
  }
  creep_stresses(t.creep, advance ? step.creep : CreepKind::none, c.exponent, c.log_creep,
                 c.log_shear, step.log_time);
  creep_moments(t.creep, advance && step.moments, c.exponent, c.log_creep, c.log_shear,
                step.log_time);
}

// Creep, yield, criterion and state of a block: everything between trial forces and loads. `a` is
// NortonArrays3 or 2; viscous_work: [kBlock] of this step, J.
template <bool advance, bool options, bool flat, class Arrays>
void norton_finish(NortonBlock &t, const Arrays &a, const OptionArrays &o, const NortonStep &step,
                   double thickness, const double *__restrict viscous_work) {
  const NortonConstants &c = a.c;
  norton_creep(t, c, step, advance, flat, thickness);
  const double *__restrict length = c.length, *__restrict radius = c.radius,
               *__restrict modulus = c.modulus, *__restrict ratio = c.shear,
               *__restrict beta = c.beta, *__restrict sigma_c = c.sigma_c,
               *__restrict tau_c = c.tau_c, *__restrict crush_c = c.crush_c,
               *__restrict yield_t = c.yield_t, *__restrict yield_c = c.yield_c,
               *__restrict yield_s = c.yield_s, *__restrict failure = o.failure;
  double *__restrict alive = a.alive, *__restrict strain = a.strain,
         *__restrict then = a.modulus_then, *__restrict dissipated = a.dissipated,
         *__restrict sigma = a.sigma, *__restrict tau = a.tau, *__restrict fate = a.fate,
         *__restrict worst = o.worst, *__restrict lost = o.lost;
  const double remains = step.cut_only ? 0.0 : 1.0;
#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const BondSection section =
        flat ? strip_section(radius[b], thickness) : round_section(radius[b]);
    const NortonTrial in{t.creep.stress[b], t.creep.tau2[b], t.bend2[b], t.twist2[b],
                         t.stress_old[b], t.tau_old[b], t.bend_old[b], t.twist_old[b],
                         t.creep.lost_normal[b], t.creep.lost_shear[b], t.creep.lost_bend[b],
                         t.creep.lost_twist[b], t.creep.modulus[b], modulus[b], ratio[b], length[b],
                         radius[b], beta[b], alive[b], sigma_c[b], tau_c[b], crush_c[b], yield_t[b],
                         yield_c[b], yield_s[b], options ? failure[b] : 1.0,
                         options ? worst[b] : 0.0, remains};
    const NortonLane r = norton_lane<advance, options>(in, section);
    t.lane[NortonBlock::STRESS][b] = r.stress;
    t.lane[NortonBlock::KEEP_S][b] = r.keep_s;
    t.lane[NortonBlock::KEEP_B][b] = r.keep_b;
    t.lane[NortonBlock::KEEP_T][b] = r.keep_t;
    t.lane[NortonBlock::HOLD][b] = r.hold;
    t.lane[NortonBlock::CARRIED_N][b] = r.carried_n * section.area * r.stress;
    t.lane[NortonBlock::CARRIED_S][b] = r.carried_s;
    sigma[b] = r.sigma, tau[b] = r.tau, fate[b] = r.fate;
    if constexpr (advance) {
      alive[b] = r.hold;
      strain[b] += r.strain;
      dissipated[b] += r.dissipated;
      then[b] = modulus[b];
      if constexpr (options) {
        worst[b] = r.worst;
        lost[b] += r.lost + r.hold * viscous_work[b];
      }
    }
  }
}

// E of the side of the bond's stress, the trial stress and that of the last step; stretch: change of
// the strain.
template <bool options>
[[gnu::always_inline]] inline void norton_normal(NortonBlock &t, int b, double elastic,
                                                 double stretch, double E, double shear,
                                                 double tension) {
  const double before = elastic - stretch;
  double En = E, old = E;
  if constexpr (options) {
    const double open = E * tension;
    En = elastic > 0.0 ? open : E;
    old = before > 0.0 ? open : E;
  }
  t.creep.stress[b] = En * elastic;
  t.stress_old[b] = old * before;
  t.creep.modulus[b] = En;
  t.creep.shear[b] = E * shear;
}

// One block in 3D: bond and grain contact together; `out` gets their sum.
// advance = false computes the loads of the stored state and changes nothing (set-up of a run).
// options, contact = false leave these parts out; their pointers are then not read.
template <bool advance, bool options = false, bool contact = true>
void norton_block_3d(const Kinematics3 &k, const NortonArrays3 &a, const NortonStep &step,
                     const ContactParameters &grains, double *__restrict csx,
                     double *__restrict csy, double *__restrict csz, PairLoads3 &out,
                     const OptionArrays &o = {}) {
  struct alignas(64) Forces {
    double e[3][kBlock], distance[kBlock], f[3][kBlock], m[3][kBlock], mt[kBlock];
    double g[3][kBlock], push[kBlock];                            // grain contact
    double vn[kBlock], vf[3][kBlock], vm[3][kBlock], vt[kBlock];  // dashpots
    double work[kBlock];
  } w;
  NortonBlock t;
  double *__restrict fsx = a.fsx, *__restrict fsy = a.fsy, *__restrict fsz = a.fsz,
         *__restrict mbx = a.mbx, *__restrict mby = a.mby, *__restrict mbz = a.mbz,
         *__restrict mt_b = a.mt;
  {
    const double *__restrict rest = a.rest, *__restrict length = a.c.length,
                 *__restrict radius = a.c.radius, *__restrict modulus = a.c.modulus,
                 *__restrict shear = a.c.shear, *__restrict strain = a.strain,
                 *__restrict then = a.modulus_then, *__restrict tension = o.tension,
                 *__restrict viscous = o.viscous;
    const double *__restrict reference = grains.reference, *__restrict kn_c = grains.kn,
                 *__restrict ks_c = grains.ks, *__restrict mu_c = grains.mu;
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const Vec3 d{k.dx[b], k.dy[b], k.dz[b]}, u{k.ux[b], k.uy[b], k.uz[b]};
      const PairStep3 p(d, u, {k.sx[b], k.sy[b], k.sz[b]}, {k.qx[b], k.qy[b], k.qz[b]});
      if constexpr (contact) {
        const ContactForce3 g = contact_force(p, Vec3{csx[b], csy[b], csz[b]}, reference[b],
                                              kn_c[b], ks_c[b], mu_c[b]);
        w.g[0][b] = g.shear.x, w.g[1][b] = g.shear.y, w.g[2][b] = g.shear.z, w.push[b] = g.normal;
      }
      const BondSection section = round_section(radius[b]);
      const double E = modulus[b], per_length = 1.0 / length[b];
      const double kn = E * per_length, ks = kn * shear[b];
      const double scale = then[b] > 0.0 ? E / then[b] : 1.0;
      const Vec3 fs_old = p.carried(scale * Vec3{fsx[b], fsy[b], fsz[b]});
      const Vec3 mb_old = p.carried(scale * Vec3{mbx[b], mby[b], mbz[b]});
      const Vec3 fs = fs_old + (ks * section.area) * p.shear;
      const Vec3 mb = mb_old + (kn * section.bend) * p.bend;
      const double mt_old = scale * mt_b[b], mt = mt_old + ks * section.twist * p.twist;
      const double stretch = stretched(p, u, d), per_area2 = 1.0 / (section.area * section.area);
      w.e[0][b] = p.e.x, w.e[1][b] = p.e.y, w.e[2][b] = p.e.z, w.distance[b] = p.distance;
      w.f[0][b] = fs.x, w.f[1][b] = fs.y, w.f[2][b] = fs.z;
      w.m[0][b] = mb.x, w.m[1][b] = mb.y, w.m[2][b] = mb.z, w.mt[b] = mt;
      t.bend2[b] = dot(mb, mb), t.twist2[b] = mt * mt;
      t.bend_old[b] = dot(mb_old, mb), t.twist_old[b] = mt_old * mt;
      t.creep.tau2[b] = dot(fs, fs) * per_area2;
      t.tau_old[b] = dot(fs_old, fs) * per_area2;
      norton_normal<options>(t, b, (p.distance - rest[b]) * per_length - strain[b],
                             stretch * per_length, E, shear[b], options ? tension[b] : 1.0);
      if constexpr (options) {
        const double vis = viscous[b];
        const double vn = vis * kn * section.area, vs = vis * ks * section.area;
        const double vb = vis * kn * section.bend, vt = vis * ks * section.twist;
        w.vn[b] = vn * stretch, w.vt[b] = vt * p.twist;
        w.vf[0][b] = vs * p.shear.x, w.vf[1][b] = vs * p.shear.y, w.vf[2][b] = vs * p.shear.z;
        w.vm[0][b] = vb * p.bend.x, w.vm[1][b] = vb * p.bend.y, w.vm[2][b] = vb * p.bend.z;
        w.work[b] = vn * stretch * stretch + vs * dot(p.shear, p.shear) + vb * dot(p.bend, p.bend) +
                    vt * p.twist * p.twist;
      }
    }
  }
  norton_finish<advance, options, false>(t, a, o, step, 0.0, w.work);
#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const Vec3 e{w.e[0][b], w.e[1][b], w.e[2][b]};
    const double keep_b = t.lane[NortonBlock::KEEP_B][b];
    const double hold = t.lane[NortonBlock::HOLD][b], carried = t.lane[NortonBlock::CARRIED_S][b];
    const Vec3 fs = t.lane[NortonBlock::KEEP_S][b] * Vec3{w.f[0][b], w.f[1][b], w.f[2][b]};
    const Vec3 mb = keep_b * Vec3{w.m[0][b], w.m[1][b], w.m[2][b]};
    const double mt = t.lane[NortonBlock::KEEP_T][b] * w.mt[b];
    Vec3 across = carried * fs, moment = carried * (mb + mt * e);
    double along = t.lane[NortonBlock::CARRIED_N][b];
    if constexpr (options) {
      across = across + hold * Vec3{w.vf[0][b], w.vf[1][b], w.vf[2][b]};
      along += hold * w.vn[b];
      moment = moment + hold * (Vec3{w.vm[0][b], w.vm[1][b], w.vm[2][b]} + w.vt[b] * e);
    }
    if constexpr (contact) {
      across = across + Vec3{w.g[0][b], w.g[1][b], w.g[2][b]};
      along -= w.push[b];
    }
    const Vec3 force = across + along * e;
    const double arm = w.distance[b] * k.per_both[b];
    const double ai = arm * k.ri[b], aj = arm * k.rj[b];
    const Vec3 lever = cross(e, across);
    out.fx[b] = force.x, out.fy[b] = force.y, out.fz[b] = force.z;
    out.tix[b] = moment.x + ai * lever.x, out.tiy[b] = moment.y + ai * lever.y;
    out.tiz[b] = moment.z + ai * lever.z;
    out.tjx[b] = aj * lever.x - moment.x, out.tjy[b] = aj * lever.y - moment.y;
    out.tjz[b] = aj * lever.z - moment.z;
    if constexpr (advance) {
      fsx[b] = hold * fs.x, fsy[b] = hold * fs.y, fsz[b] = hold * fs.z;
      mbx[b] = hold * mb.x, mby[b] = hold * mb.y, mbz[b] = hold * mb.z;
      mt_b[b] = hold * mt;
      if constexpr (contact) csx[b] = w.g[0][b], csy[b] = w.g[1][b], csz[b] = w.g[2][b];
    }
  }
}

// The same in the plane.
template <bool advance, bool options = false, bool contact = true>
void norton_block_2d(const Kinematics2 &k, const NortonArrays2 &a, const NortonStep &step,
                     const ContactParameters &grains, double *__restrict cs, PairLoads2 &out,
                     const OptionArrays &o = {}) {
  struct alignas(64) Forces {
    double ex[kBlock], ey[kBlock], distance[kBlock], f[kBlock], m[kBlock];
    double g[kBlock], push[kBlock], vn[kBlock], vf[kBlock], vm[kBlock], work[kBlock];
  } w;
  NortonBlock t;
  double *__restrict fs_b = a.fs, *__restrict mb_b = a.mb;
  {
    const double *__restrict rest = a.rest, *__restrict length = a.c.length,
                 *__restrict radius = a.c.radius, *__restrict modulus = a.c.modulus,
                 *__restrict shear = a.c.shear, *__restrict strain = a.strain,
                 *__restrict then = a.modulus_then, *__restrict tension = o.tension,
                 *__restrict viscous = o.viscous;
    const double *__restrict reference = grains.reference, *__restrict kn_c = grains.kn,
                 *__restrict ks_c = grains.ks, *__restrict mu_c = grains.mu;
    const double thickness = a.thickness;
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const PairStep2 p(k.dx[b], k.dy[b], k.ux[b], k.uy[b], k.s[b]);
      if constexpr (contact) {
        const ContactForce2 g = contact_force(p, cs[b], reference[b], kn_c[b], ks_c[b], mu_c[b]);
        w.g[b] = g.shear, w.push[b] = g.normal;
      }
      const BondSection section = strip_section(radius[b], thickness);
      const double E = modulus[b], per_length = 1.0 / length[b];
      const double kn = E * per_length, ks = kn * shear[b];
      const double scale = then[b] > 0.0 ? E / then[b] : 1.0;
      const double fs_old = scale * fs_b[b], fs = fs_old + ks * section.area * p.shear;
      const double mb_old = scale * mb_b[b], mb = mb_old + kn * section.bend * k.q[b];
      const double stretch = stretched(p, k.ux[b], k.uy[b], k.dx[b], k.dy[b]);
      const double per_area2 = 1.0 / (section.area * section.area);
      w.ex[b] = p.ex, w.ey[b] = p.ey, w.distance[b] = p.distance, w.f[b] = fs, w.m[b] = mb;
      t.bend2[b] = mb * mb, t.twist2[b] = 0.0;
      t.bend_old[b] = mb_old * mb, t.twist_old[b] = 0.0;
      t.creep.tau2[b] = fs * fs * per_area2;
      t.tau_old[b] = fs_old * fs * per_area2;
      norton_normal<options>(t, b, (p.distance - rest[b]) * per_length - strain[b],
                             stretch * per_length, E, shear[b], options ? tension[b] : 1.0);
      if constexpr (options) {
        const double vis = viscous[b];
        const double vn = vis * kn * section.area, vs = vis * ks * section.area;
        const double vb = vis * kn * section.bend;
        w.vn[b] = vn * stretch, w.vf[b] = vs * p.shear, w.vm[b] = vb * k.q[b];
        w.work[b] = vn * stretch * stretch + vs * p.shear * p.shear + vb * k.q[b] * k.q[b];
      }
    }
  }
  norton_finish<advance, options, true>(t, a, o, step, a.thickness, w.work);
#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const double hold = t.lane[NortonBlock::HOLD][b], carried = t.lane[NortonBlock::CARRIED_S][b];
    const double fs = t.lane[NortonBlock::KEEP_S][b] * w.f[b];
    const double mb = t.lane[NortonBlock::KEEP_B][b] * w.m[b];
    double along = t.lane[NortonBlock::CARRIED_N][b], across = carried * fs, moment = carried * mb;
    if constexpr (options)
      along += hold * w.vn[b], across += hold * w.vf[b], moment += hold * w.vm[b];
    if constexpr (contact) along -= w.push[b], across += w.g[b];
    const double arm = w.distance[b] * k.per_both[b];
    out.fx[b] = along * w.ex[b] - across * w.ey[b];
    out.fy[b] = along * w.ey[b] + across * w.ex[b];
    out.ti[b] = moment + arm * k.ri[b] * across;
    out.tj[b] = arm * k.rj[b] * across - moment;
    if constexpr (advance) {
      fs_b[b] = hold * fs;
      mb_b[b] = hold * mb;
      if constexpr (contact) cs[b] = w.g[b];
    }
  }
}

}  // namespace bondlab::laws

#endif
