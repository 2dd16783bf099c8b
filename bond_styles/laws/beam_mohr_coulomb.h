// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the beam bond with a Mohr-Coulomb strength: an elastic beam between the centres of two
// grains that carries force, shear, bend and twist through any rotation, breaks when its rim
// reaches the strength, and leaves an elastic contact with friction behind.
//
// Law: Wang, Abe, Latham & Mora 2006, Pure Appl. Geophys. 163, 1769-1785; Wang 2009, Acta Geotech.
// 4, 117-127 (ESyS-Particle's brittle beam), in the total form of beam_geometry.h, with
//     R_b = lambda (R_i + R_j)/2,  l_0: distance at bonding, or R_i + R_j (ESyS)
//     k_n = E_b A/l_0,   k_b = b E_b I/l_0,   k_t = G J/l_0,   G = E_b/(2 (1 + nu_b))
//     shear in the middle between the centres, or at the grains' contact (ESyS measures in the middle
//     and applies at the contact; with the latter option here both are at the contact)
//     k_s = G A/l_0 (`GA`, ESyS)  |  12 E_b I/l_0^3 (`euler`)
//         | 1/(l_0^3/(12 E_b I) + l_0/(kappa G A)) (`timoshenko`)
//     3D: A = pi R_b^2, I = pi R_b^4/4, J = pi R_b^4/2,  kappa = 6 (1 + nu)/(7 + 6 nu)
//     2D (strip of thickness t): A = 2 R_b t, I = 2 R_b^3 t/3, no twist,
//         kappa = 10 (1 + nu)/(12 + 11 nu)   (both Cowper 1966, J. Appl. Mech. 33, 335-340)
// b is bend_factor: 1 is beam theory, ESyS-Particle's code has 1/2. The seed paper that prints
// R_i + R_j where R_b belongs gets K_n, K_s twice and K_b, K_t eight times too large
// (PHYSICS.md 3.7).
//     sigma = F_n/A + beta_1 |M_b| R_b/I,    tau = |F_s|/A + beta_2 |M_t| R_b/J     tension
//     positive breaks when tau >= c - sigma tan(phi), or sigma >= sigma_t (cut-off, none by
//     default)
// so tension alone breaks it at c/tan(phi), not at c tan(phi). A break counts as tensile if it met
// the cut-off or if sigma tan(phi) >= tau (the normal stress did more of the work), else as shear.
//
// When it breaks its force and couples vanish, and a contact takes its place: normal stiffness k_n
// in compression only, shear stiffness k_s, Coulomb friction mu, stress-free at the contact's
// reference distance (grain_contact.h), history zero. Where the pair has a grain contact (kn > 0)
// that one is used alone, before and after the break, as with the parallel bond.
//
// Options (bond_options.h): load factor s = max((tau + sigma tan(phi))/c, sigma/sigma_t). `lost`
// takes up the dashpots' work and what softening eats, not the energy released by a brittle break.
//
// Method: loops over the lanes, vectorised, no branch inside: beams first, then contacts, then
// dashpots. The latter run only if a lane of the block needs them; to one that doesn't they add
// zero, so the bits of a lane don't depend on its neighbours. A beam needs positions and
// orientations only: the motion (`u`, `s`, `q` of Kinematics) is looked at if beam_needs_motion()
// or a dashpot asks for it.
//
// Units: m, N, N m, Pa. Failure: none; NaN in, NaN out. Limits: strength is looked at once a step;
// bend below pi (see beam_geometry.h); no axial force from shear, no geometric stiffness inside a
// bond.
#ifndef BONDLAB_LAWS_BEAM_MOHR_COULOMB_H
#define BONDLAB_LAWS_BEAM_MOHR_COULOMB_H

#include <cmath>

#include "beam_geometry.h"
#include "bond_options.h"
#include "bond_section.h"
#include "grain_contact.h"

namespace bondlab::laws {

enum class BeamShear { GA, euler, timoshenko };

// Constants of a bond type.
struct BeamParameters {
  double modulus = 0.0;   // E_b, Pa
  double poisson = 0.0;   // nu_b
  double cohesion = 0.0;  // c, Pa
  double tan_phi = 0.0;
  double cutoff = 1e300;     // sigma_t, Pa; 1e300: none
  double beta1 = 1.0;        // share of the bending stress in sigma
  double beta2 = 1.0;        // share of the twisting stress in tau
  double bend_factor = 1.0;  // b
  double lambda = 1.0;       // R_b over the mean radius
  double friction = 0.0;     // mu of the contact that replaces the bond
  BeamShear shear = BeamShear::GA;
  bool touching = false;    // l_0 = R_i + R_j
  bool at_contact = false;  // shear is measured and acts at the grains' contact, not half-way
};

// w_i of beam_geometry.h. point: 0 in the middle, 1 at the grains' contact; per_both: 1/(R_i + R_j).
inline double beam_weight(double point, double ri, double rj, double per_both) {
  return 1.0 + point * (ri - rj) * per_both;
}

// k_s/k_n of a beam of radius R_b and length l_0.
inline double beam_shear_ratio(BeamShear kind, double radius, double length, double poisson,
                               bool flat) {
  const double inverse_G = 2.0 * (1.0 + poisson);                                   // E/G
  const double slender = length * length / (radius * radius) / (flat ? 4.0 : 3.0);  // A l^2/(12 I)
  const double kappa = flat ? 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson)
                            : 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson);
  switch (kind) {
    case BeamShear::GA:
      return 1.0 / inverse_G;
    case BeamShear::euler:
      return 1.0 / slender;
    case BeamShear::timoshenko:
      return 1.0 / (slender + inverse_G / kappa);
  }
  return 0.0;
}

// Stiffnesses of a beam: k_n, k_s (N/m), k_b, k_t (N m). shear: k_s/k_n; twist: G/E.
struct BeamStiffness {
  double normal, shear, bend, twist;
};
// per_rest: 1/l_0
inline BeamStiffness beam_stiffness_3d(double modulus, double radius, double per_rest, double shear,
                                       double twist, double bend_factor) {
  const double r2 = radius * radius, kn = kPi * r2 * modulus * per_rest;
  return {kn, shear * kn, 0.25 * bend_factor * r2 * kn, 0.5 * twist * r2 * kn};
}
inline BeamStiffness beam_stiffness_2d(double modulus, double radius, double rest, double shear,
                                       double bend_factor, double thickness) {
  const double kn = 2.0 * radius * thickness * modulus / rest;
  return {kn, shear * kn, bend_factor * radius * radius * kn / 3.0, 0.0};
}

// What a bond carries, for output: forces N (tension positive), couples N m, elastic energy J.
struct BeamLoads {
  double fn, fs, mb, mt, energy;
};
inline BeamLoads beam_loads(const BeamStiffness &k, double rest, double distance, double shear,
                            double bend, double twist) {
  const double fn = k.normal * (distance - rest), S = k.shear * rest * rest;
  const double mb = k.bend * bend, mt = k.twist * twist;
  return {fn, S * shear / distance, mb, mt,
          0.5 * (fn * (distance - rest) + S * shear * shear + mb * bend + mt * twist)};
}

// Arrays of one block of bonds; shapes [kBlock] each.
struct BeamArrays3 {
  // constants
  const double *rest;     // l_0, m
  const double *radius;   // R_b, m
  const double *modulus;  // E_b, Pa
  const double *shear;    // k_s/k_n
  const double *twist;    // G/E_b
  const double *bend_factor;
  const double *beta1, *beta2;
  const double *tan_phi;
  const double *cohesion;  // Pa
  const double *cutoff;    // Pa
  const double *friction;  // of the contact that replaces the bond
  const double *point;     // 0: shear in the middle, 1: at the grains' contact
  // reference, written once at bonding: BeamReference3 by components
  const double *iw, *ix, *iy, *iz, *jw, *jx, *jy, *jz;
  // state
  double *alive;  // 1 intact, 0 broken; written when advancing
  // report of the step, written
  double *sigma, *tau;  // rim stresses before any break, Pa
  double *fate;         // BondFate as a number
};

struct BeamArrays2 {
  const double *rest, *radius, *modulus, *shear, *bend_factor, *beta1, *tan_phi, *cohesion, *cutoff,
      *friction, *point;
  double thickness;                 // m
  const double *ix, *iy, *jx, *jy;  // BeamReference2 by components
  double *alive;
  double *sigma, *tau;
  double *fate;
};

// Does a lane of the block have a contact with a history, before the step? (Bonds that break in the
// step begin theirs with the next one.)
inline bool beam_needs_motion(const double *alive, const ContactParameters &c) {
  bool any = false;
  for (int b = 0; b < kBlock; ++b) any |= alive[b] == 0.0 || c.kn[b] > 0.0;
  return any;
}

// What the criterion and the options make of a bond's stresses in a step.
struct BeamVerdict {
  double share;  // of its effective load that the bond carries, 0: broken
  double fate;
};
// was: 1 intact, 0 broken; sigma, tau: effective.
inline BeamVerdict beam_verdict(double was, double sigma, double tau, double tan_phi,
                                double cohesion, double cutoff) {
  const double push = sigma * tan_phi;
  const bool torn = sigma >= cutoff;
  const bool fails = torn | (tau + push >= cohesion);
  const double hold = fails ? 0.0 : was;
  const double kind = torn | (push >= tau) ? 1.0 : 2.0;
  return {hold, hold < was ? kind : 0.0};
}

// Softening: the load factor, then the share. `worst` and `lost` are brought up to date.
// energy: of the part of the load that softens, J.
inline BeamVerdict beam_softening(double was, double sigma, double tau, double tan_phi,
                                  double cohesion, double cutoff, double failure, double energy,
                                  double &worst, double &lost) {
  const double push = sigma * tan_phi;
  const double slide = (tau + push) / cohesion, tear = sigma / cutoff;
  const double factor = slide > tear ? slide : tear;
  const double reached = factor > worst ? factor : worst;
  const double share = was * integrity(reached, failure);
  lost += was * softening_loss(worst, reached, failure, energy);
  worst = was > 0.0 ? reached : worst;
  // brittle: as in beam_verdict; softening: the larger of the two rules
  const bool torn = (tear >= slide) | ((failure <= 1.0) & (tear >= 1.0));
  const double kind = torn | (push >= tau) ? 1.0 : 2.0;
  return {share, (was > 0.0) & (share <= 0.0) ? kind : 0.0};
}

// The criterion of one lane, the same in space and in the plane. fn, sigma, tau: effective.
struct BeamLane {
  double share, pull;        // of shear and couples that is carried; normal force, N
  double sigma, tau, fate;   // report
  double alive, worst, lost; // state after the step
};
template <bool advance, bool options>
[[gnu::always_inline]] inline BeamLane beam_lane(double was, double fn, double sigma, double tau,
                                                 double tan_phi, double cohesion, double cutoff,
                                                 double failure, double energy, double worst,
                                                 double lost) {
  BeamLane r{was, fn, was * sigma, was * tau, 0.0, was, worst, lost};
  BeamVerdict v;
  if constexpr (options) {
    const double seen = was * integrity(worst, failure);
    v = beam_softening(was, sigma, tau, tan_phi, cohesion, cutoff, failure, energy, r.worst, r.lost);
    r.share = advance ? v.share : seen;
    r.pull = fn > 0.0 ? r.share * fn : (r.share > 0.0 ? fn : 0.0);
    r.alive = r.share > 0.0 ? was : 0.0;
  } else {
    v = beam_verdict(was, sigma, tau, tan_phi, cohesion, cutoff);
    r.share = r.alive = advance ? v.share : was;
    r.pull = r.share * fn;
  }
  r.fate = advance ? v.fate : 0.0;
  return r;
}

}  // namespace bondlab::laws

#include "beam_mohr_coulomb_2d.h"
#include "beam_mohr_coulomb_3d.h"

#endif
