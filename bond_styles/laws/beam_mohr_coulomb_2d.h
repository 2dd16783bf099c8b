// SPDX-License-Identifier: GPL-2.0-or-later
// Job: one block of beam bonds in the plane; law, method and limits: see beam_mohr_coulomb.h, which
// includes this file. The transverse direction is t = z x e.
#ifndef BONDLAB_LAWS_BEAM_MOHR_COULOMB_2D_H
#define BONDLAB_LAWS_BEAM_MOHR_COULOMB_2D_H

#include "beam_mohr_coulomb.h"

namespace bondlab::laws {

// As beam_block_3d.
template <bool advance, bool options>
void beam_block_2d(const Kinematics2 &k, const Orientations2 &o, const BeamArrays2 &a,
                   const OptionArrays &opt, const ContactParameters &c, double *__restrict cs,
                   PairLoads2 &out) {
  const double *__restrict rest_b = a.rest, *__restrict radius_b = a.radius,
                           *__restrict modulus = a.modulus, *__restrict shear_b = a.shear,
                           *__restrict factor_b = a.bend_factor, *__restrict beta1 = a.beta1,
                           *__restrict tan_phi = a.tan_phi, *__restrict cohesion = a.cohesion,
                           *__restrict cutoff = a.cutoff, *__restrict point = a.point;
  const double *__restrict ix = a.ix, *__restrict iy = a.iy, *__restrict jx = a.jx,
                           *__restrict jy = a.jy;
  double *__restrict alive_b = a.alive, *__restrict sigma_b = a.sigma, *__restrict tau_b = a.tau,
                     *__restrict fate_b = a.fate;
  const double *__restrict tension = opt.tension, *__restrict failure = opt.failure;
  double *__restrict worst_b = opt.worst, *__restrict lost_b = opt.lost;
  const double thickness = a.thickness;
  alignas(64) double was_b[kBlock], share_b[kBlock];
  const bool contacts = beam_needs_motion(alive_b, c);
  double broken = 0.0;

#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const double weight = beam_weight(point[b], k.ri[b], k.rj[b], k.per_both[b]);
    const BeamShape2 p(k.dx[b], k.dy[b], o.iw[b], o.iz[b], o.jw[b], o.jz[b],
                       BeamReference2{ix[b], iy[b], jx[b], jy[b]}, weight, 2.0 - weight);
    const double rest = rest_b[b], radius = radius_b[b];
    BeamStiffness s =
        beam_stiffness_2d(modulus[b], radius, rest, shear_b[b], factor_b[b], thickness);
    const double stretch = p.distance - rest, S = s.shear * rest * rest;
    if (options) s.normal *= stretch > 0.0 ? tension[b] : 1.0;
    const double fn = s.normal * stretch, fs = -S * p.shear / p.distance, mb = s.bend * p.bend;

    // stresses of the strip: R_b/I = 3/(A R_b)
    const double per_area = 1.0 / (2.0 * radius * thickness);
    const double sigma = fn * per_area + 3.0 * beta1[b] * per_area / radius * std::fabs(mb);
    const double tau = std::fabs(fs) * per_area;
    const double was = alive_b[b];
    double energy = 0.0, failed = 1.0, worst = 0.0, lost = 0.0;
    if (options) {
      energy = 0.5 * ((stretch > 0.0 ? fn * stretch : 0.0) + S * p.shear * p.shear + mb * p.bend);
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

    const double across = share * fs, couple = share * mb, lever = p.distance * across;
    out.fx[b] = pull * p.ex - across * p.ey;
    out.fy[b] = pull * p.ey + across * p.ex;
    out.ti[b] = p.share_i * lever + couple;
    out.tj[b] = p.share_j * lever - couple;
  }

  const double *__restrict reference = c.reference, *__restrict kn_c = c.kn,
                           *__restrict ks_c = c.ks, *__restrict mu_c = c.mu,
                           *__restrict mu_b = a.friction;
  const auto left_stiffness = [&](int b) {  // of the contact that replaces a bond
    const BeamStiffness s =
        beam_stiffness_2d(modulus[b], radius_b[b], rest_b[b], 0.0, 0.0, thickness);
    return kn_c[b] > 0.0 ? 0.0 : s.normal;
  };
  // contacts of bonds that broke just now: nothing has slid yet
  for (int b = 0; b < kBlock; ++b) broken += was_b[b] > share_b[b] && share_b[b] == 0.0;
  if (broken > 0.0) {
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const double distance = std::sqrt(k.dx[b] * k.dx[b] + k.dy[b] * k.dy[b]);
      const double overlap = reference[b] - distance;
      const double stiffness = (was_b[b] > 0.0) & (share_b[b] == 0.0) ? left_stiffness(b) : 0.0;
      const double push = overlap > 0.0 ? stiffness * overlap / distance : 0.0;
      out.fx[b] -= push * k.dx[b], out.fy[b] -= push * k.dy[b];
    }
  }

  // all other contacts
  if (contacts) {
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const PairStep2 p(k.dx[b], k.dy[b], k.ux[b], k.uy[b], k.s[b]);
      const bool grains = kn_c[b] > 0.0;
      const double left = was_b[b] > 0.0 ? 0.0 : left_stiffness(b);
      const ContactForce2 f =
          contact_force(p, cs[b], reference[b], grains ? kn_c[b] : left,
                        grains ? ks_c[b] : left * shear_b[b], grains ? mu_c[b] : mu_b[b]);
      const double arm = p.distance * k.per_both[b];
      out.fx[b] += -f.normal * p.ex - f.shear * p.ey;
      out.fy[b] += -f.normal * p.ey + f.shear * p.ex;
      out.ti[b] += arm * k.ri[b] * f.shear;
      out.tj[b] += arm * k.rj[b] * f.shear;
      if (advance) cs[b] = f.shear;
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
        const PairStep2 p(k.dx[b], k.dy[b], k.ux[b], k.uy[b], k.s[b] + off * k.q[b]);
        const double du = stretched(p, k.ux[b], k.uy[b], k.dx[b], k.dy[b]);
        BeamStiffness s = beam_stiffness_2d(modulus[b], radius_b[b], rest_b[b], shear_b[b],
                                            factor_b[b], thickness);
        s.normal *= p.distance > rest_b[b] ? tension[b] : 1.0;
        const double eta = viscous[b] * share_b[b];
        const double along = eta * s.normal * du, across = eta * s.shear * p.shear;
        const double couple = eta * s.bend * k.q[b], lever = 0.5 * p.distance * across;
        out.fx[b] += along * p.ex - across * p.ey;
        out.fy[b] += along * p.ey + across * p.ex;
        out.ti[b] += weight * lever + couple;
        out.tj[b] += (2.0 - weight) * lever - couple;
        if (advance)
          lost_b[b] +=
              eta * (s.normal * du * du + s.shear * p.shear * p.shear + s.bend * k.q[b] * k.q[b]);
      }
    }
  }
}

}  // namespace bondlab::laws

#endif
