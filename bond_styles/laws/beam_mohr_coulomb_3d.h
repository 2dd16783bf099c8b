// SPDX-License-Identifier: GPL-2.0-or-later
// Job: one block of beam bonds in 3D; law, method and limits: see beam_mohr_coulomb.h, which
// includes this file.
#ifndef BONDLAB_LAWS_BEAM_MOHR_COULOMB_3D_H
#define BONDLAB_LAWS_BEAM_MOHR_COULOMB_3D_H

#include "beam_mohr_coulomb.h"

namespace bondlab::laws {

// Bond and contact together; `out` gets their sum. advance = false computes the loads of the stored
// state and changes nothing (set-up of a run). options = false: `opt` isn't looked at.
template <bool advance, bool options>
void beam_block_3d(const Kinematics3 &k, const Orientations3 &o, const BeamArrays3 &a,
                   const OptionArrays &opt, const ContactParameters &c, double *__restrict csx,
                   double *__restrict csy, double *__restrict csz, PairLoads3 &out) {
  // Local restrict pointers: through the structs the compiler must reload them at every store.
  const double *__restrict rest_b = a.rest, *__restrict radius_b = a.radius,
                           *__restrict modulus = a.modulus, *__restrict shear_b = a.shear,
                           *__restrict twist_b = a.twist, *__restrict factor_b = a.bend_factor,
                           *__restrict beta1 = a.beta1, *__restrict beta2 = a.beta2,
                           *__restrict tan_phi = a.tan_phi, *__restrict cohesion = a.cohesion,
                           *__restrict cutoff = a.cutoff, *__restrict point = a.point;
  const double *__restrict iw = a.iw, *__restrict ix = a.ix, *__restrict iy = a.iy,
                           *__restrict iz = a.iz, *__restrict jw = a.jw, *__restrict jx = a.jx,
                           *__restrict jy = a.jy, *__restrict jz = a.jz;
  double *__restrict alive_b = a.alive, *__restrict sigma_b = a.sigma, *__restrict tau_b = a.tau,
                     *__restrict fate_b = a.fate;
  const double *__restrict tension = opt.tension, *__restrict failure = opt.failure;
  double *__restrict worst_b = opt.worst, *__restrict lost_b = opt.lost;
  alignas(64) double was_b[kBlock], share_b[kBlock], left_b[kBlock];  // left: stiffness after a break
  const bool contacts = beam_needs_motion(alive_b, c);
  double broken = 0.0;

#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const double weight = beam_weight(point[b], k.ri[b], k.rj[b], k.per_both[b]);
    const BeamShape3 p(
        {k.dx[b], k.dy[b], k.dz[b]},
        Quaternion{o.iw[b], o.ix[b], o.iy[b], o.iz[b]} * Quaternion{iw[b], ix[b], iy[b], iz[b]},
        Quaternion{o.jw[b], o.jx[b], o.jy[b], o.jz[b]} * Quaternion{jw[b], jx[b], jy[b], jz[b]},
        weight, 2.0 - weight);
    const double rest = rest_b[b], radius = radius_b[b];
    const double inverse = 1.0 / (rest * radius), per_radius = inverse * rest;
    BeamStiffness s = beam_stiffness_3d(modulus[b], radius, inverse * radius, shear_b[b], twist_b[b],
                                        factor_b[b]);
    left_b[b] = s.normal;
    const double stretch = p.distance - rest, S = s.shear * rest * rest;
    if (options) s.normal *= stretch > 0.0 ? tension[b] : 1.0;
    const double fn = s.normal * stretch;

    // stresses of the round section: R_b/I = 4/(A R_b), R_b/J = 2/(A R_b)
    const double per_area = (1.0 / kPi) * per_radius * per_radius, rim = per_area * per_radius;
    const double sigma = fn * per_area + 4.0 * beta1[b] * rim * s.bend * p.bend;
    const double tau =
        S * p.shear * per_area * p.inverse_distance + 2.0 * beta2[b] * rim * s.twist * std::fabs(p.twist);
    const double was = alive_b[b];
    double energy = 0.0, failed = 1.0, worst = 0.0, lost = 0.0;
    if (options) {
      energy = 0.5 * ((stretch > 0.0 ? fn * stretch : 0.0) + S * p.shear * p.shear + s.bend * p.bend * p.bend + s.twist * p.twist * p.twist);
      failed = failure[b], worst = worst_b[b], lost = lost_b[b];
    }
    const BeamLane r = beam_lane<advance, options>(was, fn, sigma, tau, tan_phi[b], cohesion[b], cutoff[b],
                                                   failed, energy, worst, lost);
    const double share = r.share, pull = r.pull;
    sigma_b[b] = r.sigma, tau_b[b] = r.tau, fate_b[b] = r.fate;
    if (advance) alive_b[b] = r.alive;
    if (advance && options) worst_b[b] = r.worst, lost_b[b] = r.lost;
    was_b[b] = was;
    share_b[b] = share;

    const Vec3 force = pull * p.e + (share * S) * p.shear_force;
    const Vec3 couple = (share * s.bend) * p.bend_couple + (share * s.twist) * p.twist_couple;
    const Vec3 on_i = (share * S) * p.shear_i + couple, on_j = (share * S) * p.shear_j - couple;
    out.fx[b] = force.x, out.fy[b] = force.y, out.fz[b] = force.z;
    out.tix[b] = on_i.x, out.tiy[b] = on_i.y, out.tiz[b] = on_i.z;
    out.tjx[b] = on_j.x, out.tjy[b] = on_j.y, out.tjz[b] = on_j.z;
  }

  const double *__restrict reference = c.reference, *__restrict kn_c = c.kn,
                           *__restrict ks_c = c.ks, *__restrict mu_c = c.mu,
                           *__restrict mu_b = a.friction;
  // contacts of bonds that broke just now: nothing has slid yet
  for (int b = 0; b < kBlock; ++b) broken += was_b[b] > share_b[b] && share_b[b] == 0.0;
  if (broken > 0.0) {
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const double l2 = k.dx[b] * k.dx[b] + k.dy[b] * k.dy[b] + k.dz[b] * k.dz[b];
      const double distance = std::sqrt(l2), overlap = reference[b] - distance;
      const bool here = (was_b[b] > 0.0) & (share_b[b] == 0.0) & !(kn_c[b] > 0.0);
      const double left = left_b[b], stiffness = here ? left : 0.0;
      const double push = overlap > 0.0 ? stiffness * overlap / distance : 0.0;
      out.fx[b] -= push * k.dx[b], out.fy[b] -= push * k.dy[b], out.fz[b] -= push * k.dz[b];
    }
  }

  // all other contacts
  if (contacts) {
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const PairStep3 p({k.dx[b], k.dy[b], k.dz[b]}, {k.ux[b], k.uy[b], k.uz[b]},
                        {k.sx[b], k.sy[b], k.sz[b]}, {k.qx[b], k.qy[b], k.qz[b]});
      const bool grains = kn_c[b] > 0.0;
      const double after = left_b[b], left = was_b[b] > 0.0 ? 0.0 : after;
      const ContactForce3 f =
          contact_force(p, Vec3{csx[b], csy[b], csz[b]}, reference[b], grains ? kn_c[b] : left,
                        grains ? ks_c[b] : left * shear_b[b], grains ? mu_c[b] : mu_b[b]);
      const Vec3 force = f.shear - f.normal * p.e, lever = cross(p.e, f.shear);
      const double arm = p.distance * k.per_both[b];
      const double ai = arm * k.ri[b], aj = arm * k.rj[b];
      out.fx[b] += force.x, out.fy[b] += force.y, out.fz[b] += force.z;
      out.tix[b] += ai * lever.x, out.tiy[b] += ai * lever.y, out.tiz[b] += ai * lever.z;
      out.tjx[b] += aj * lever.x, out.tjy[b] += aj * lever.y, out.tjz[b] += aj * lever.z;
      if (advance) csx[b] = f.shear.x, csy[b] = f.shear.y, csz[b] = f.shear.z;
    }
  }

  // dashpots, one in parallel to each spring; shear at the same place as the beam's
  if (options) {
    const double *__restrict viscous = opt.viscous;
    double any = 0.0;
    for (int b = 0; b < kBlock; ++b) any += viscous[b] * share_b[b];
    if (any > 0.0) {
#pragma GCC ivdep
      for (int b = 0; b < kBlock; ++b) {
        const double weight = beam_weight(point[b], k.ri[b], k.rj[b], k.per_both[b]);
        const double off = 1.0 - 0.5 * weight - k.rj[b] * k.per_both[b];
        const Vec3 d{k.dx[b], k.dy[b], k.dz[b]}, u{k.ux[b], k.uy[b], k.uz[b]};
        const Vec3 q{k.qx[b], k.qy[b], k.qz[b]}, mean = Vec3{k.sx[b], k.sy[b], k.sz[b]} + off * q;
        const PairStep3 p(d, u, mean, q);
        const double du = stretched(p, u, d);
        BeamStiffness s = beam_stiffness_3d(modulus[b], radius_b[b], 1.0 / rest_b[b], shear_b[b],
                                            twist_b[b], factor_b[b]);
        s.normal *= p.distance > rest_b[b] ? tension[b] : 1.0;
        const double eta = viscous[b] * share_b[b];
        const Vec3 across = (eta * s.shear) * p.shear;
        const Vec3 force = across + (eta * s.normal * du) * p.e;
        const Vec3 couple = (eta * s.bend) * p.bend + (eta * s.twist * p.twist) * p.e;
        const Vec3 lever = (0.5 * p.distance) * cross(p.e, across);
        const Vec3 on_i = weight * lever + couple, on_j = (2.0 - weight) * lever - couple;
        out.fx[b] += force.x, out.fy[b] += force.y, out.fz[b] += force.z;
        out.tix[b] += on_i.x, out.tiy[b] += on_i.y, out.tiz[b] += on_i.z;
        out.tjx[b] += on_j.x, out.tjy[b] += on_j.y, out.tjz[b] += on_j.z;
        if (advance)
          lost_b[b] += eta * (s.normal * du * du + s.shear * dot(p.shear, p.shear) +
                              s.bend * dot(p.bend, p.bend) + s.twist * p.twist * p.twist);
      }
    }
  }
}

}  // namespace bondlab::laws

#endif
