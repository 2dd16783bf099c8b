// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_beam_mohr_coulomb.h. Coefficients and restart: bond_beam_mohr_coulomb_coeff.cpp.
#include "bond_beam_mohr_coulomb.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "bond_dispatch.h"
#include "laws/parallel.h"
#include "pair_grain.h"

using namespace LAMMPS_NS;
using namespace bondlab::laws;

BondBeamMohrCoulomb::BondBeamMohrCoulomb(LAMMPS *lmp)
    : BondBPM(lmp, "beam/mohr/coulomb", STATES, CONSTANTS, /* orientations */ true) {}

double BondBeamMohrCoulomb::rest(const Pair &p) const {
  return kinds_[p.type].law.touching ? p.ri + p.rj : p.rest;
}

double BondBeamMohrCoulomb::radius(const Pair &p) const {
  return kinds_[p.type].law.lambda * 0.5 * (p.ri + p.rj);
}

void BondBeamMohrCoulomb::constants(const Pair &p, double *c) const {
  const Type &t = kinds_[p.type];
  c[LAMBDA] = t.law.lambda;
  c[MODULUS] = t.law.modulus;
  c[SHEAR] = beam_shear_ratio(t.law.shear, radius(p), rest(p), t.law.poisson, flat());
  c[TWIST] = 0.5 / (1.0 + t.law.poisson);
  c[BEND_FACTOR] = t.law.bend_factor;
  c[BETA1] = t.law.beta1;
  c[BETA2] = t.law.beta2;
  c[TAN_PHI] = t.law.tan_phi;
  c[COHESION] = bond_strength(t.cohesion, p.tag_lo, p.tag_hi);
  c[CUTOFF] = bond_strength(t.cutoff, p.tag_lo, p.tag_hi);
  c[FRICTION] = t.law.friction;
  c[TOUCHING] = t.law.touching;
  c[POINT] = t.law.at_contact;
}

bool BondBeamMohrCoulomb::varies(int type, int constant) const {
  const Type &t = kinds_[type];
  return (constant == COHESION && t.cohesion.scatter != Scatter::none) ||
         (constant == CUTOFF && t.cutoff.scatter != Scatter::none) ||
         (constant == SHEAR && t.law.shear != BeamShear::GA);
}

// What tension alone breaks it at: the cut-off or c/tan(phi).
BondBPM::Opening BondBeamMohrCoulomb::opening(const Pair &p, const double *c) const {
  const double R = radius(p), area = flat() ? 2.0 * R * style_->thickness : kPi * R * R;
  const double apex = c[TAN_PHI] > 0.0 ? c[COHESION] / c[TAN_PHI] : c[CUTOFF];
  return {c[MODULUS] / rest(p), area, std::min(c[CUTOFF], apex)};
}

void BondBeamMohrCoulomb::strengths(int row, double &sigma_c, double &tau_c) const {
  tau_c = constant(COHESION, row);
  const double tan_phi = constant(TAN_PHI, row), cutoff = constant(CUTOFF, row);
  sigma_c = tan_phi > 0.0 ? std::min(cutoff, tau_c / tan_phi) : cutoff;
}

void BondBeamMohrCoulomb::create(const double *xi, const double *xj, const double *qi,
                                 const double *qj, double *frame) const {
  if (flat()) {
    const BeamReference2 r = beam_reference(xj[0] - xi[0], xj[1] - xi[1], qi[0], qi[3], qj[0], qj[3]);
    frame[0] = r.ix, frame[1] = r.iy, frame[2] = r.jx, frame[3] = r.jy;
    return;
  }
  const BeamReference3 r = beam_reference(Vec3{xi[0], xi[1], xi[2]}, Vec3{xj[0], xj[1], xj[2]},
                                          {qi[0], qi[1], qi[2], qi[3]}, {qj[0], qj[1], qj[2], qj[3]});
  frame[0] = r.i.w, frame[1] = r.i.x, frame[2] = r.i.y, frame[3] = r.i.z;
  frame[4] = r.j.w, frame[5] = r.j.x, frame[6] = r.j.y, frame[7] = r.j.z;
}

const double *BondBeamMohrCoulomb::sizes(Block &b, const double *&rest, const double *&radius) const {
  double *l0 = b.scratch[kMostConstants + 4], *R = b.scratch[kMostConstants + 5],
         *reference = b.scratch[kMostConstants + 6];
  const double *lambda = b.constant[LAMBDA], *touching = b.constant[TOUCHING];
  for (int k = 0; k < kBlock; k++) {
    const double both = b.ri[k] + b.rj[k];
    R[k] = 0.5 * lambda[k] * both;
    l0[k] = touching[k] != 0.0 ? both : b.state[REST][k];
    reference[k] = touching[k] != 0.0 ? both : b.state[REFERENCE][k];
  }
  rest = l0;
  radius = R;
  return reference;
}

void BondBeamMohrCoulomb::block_3d(Block &b, const Kinematics3 &k, const Orientations3 &o,
                                   bool advance, PairLoads3 &loads) {
  const double *l0, *R, *const *c = b.constant;
  b.contact.reference = sizes(b, l0, R);
  const BeamArrays3 a{l0, R, c[MODULUS], c[SHEAR], c[TWIST], c[BEND_FACTOR], c[BETA1], c[BETA2],
                      c[TAN_PHI], c[COHESION], c[CUTOFF], c[FRICTION], c[POINT], b.law(0), b.law(1), b.law(2),
                      b.law(3), b.law(4), b.law(5), b.law(6), b.law(7), b.alive, b.report.sigma,
                      b.report.tau, b.report.fate};
  bondlab::dispatch(advance, b.with_options, false, [&](auto step, auto options, auto) {
    beam_block_3d<step.value, options.value>(k, o, a, b.options, b.contact, b.state[CSX],
                                             b.state[CSY], b.state[CSZ], loads);
  });
}

void BondBeamMohrCoulomb::block_2d(Block &b, const Kinematics2 &k, const Orientations2 &o,
                                   bool advance, PairLoads2 &loads) {
  const double *l0, *R, *const *c = b.constant;
  b.contact.reference = sizes(b, l0, R);
  const BeamArrays2 a{l0, R, c[MODULUS], c[SHEAR], c[BEND_FACTOR], c[BETA1], c[TAN_PHI],
                      c[COHESION], c[CUTOFF], c[FRICTION], c[POINT], style_->thickness, b.law(0), b.law(1),
                      b.law(2), b.law(3), b.alive, b.report.sigma, b.report.tau, b.report.fate};
  bondlab::dispatch(advance, b.with_options, false, [&](auto step, auto options, auto) {
    beam_block_2d<step.value, options.value>(k, o, a, b.options, b.contact, b.state[CSX], loads);
  });
}

BeamStiffness BondBeamMohrCoulomb::whole(int row) const {
  const Pair p = pair(row);
  const double E = constant(MODULUS, row), s = constant(SHEAR, row), f = constant(BEND_FACTOR, row);
  return flat() ? beam_stiffness_2d(E, radius(p), rest(p), s, f, style_->thickness)
                : beam_stiffness_3d(E, radius(p), 1.0 / rest(p), s, constant(TWIST, row), f);
}

BeamLoads BondBeamMohrCoulomb::loads(int row) const {
  const bondlab::PairTable &t = table();
  const int i = t.at_lo[row], j = t.at_hi[row];
  const double *xi = atom->x[i], *xj = atom->x[j], *qi = style_->quat[i], *qj = style_->quat[j];
  double f[STATES];
  for (int c = 0; c < STATES; c++) f[c] = state(LAW + c, row);
  const Pair p = pair(row);
  BeamStiffness k = whole(row);
  if (distance(row) > rest(p)) k.normal *= types_[p.type].tension;
  const double weight = beam_weight(constant(POINT, row), p.ri, p.rj, 1.0 / (p.ri + p.rj));
  if (flat()) {
    const BeamShape2 s(xj[0] - xi[0], xj[1] - xi[1], qi[0], qi[3], qj[0], qj[3], {f[0], f[1], f[2], f[3]},
                       weight, 2.0 - weight);
    return beam_loads(k, rest(p), s.distance, std::fabs(s.shear), std::fabs(s.bend), 0.0);
  }
  const BeamShape3 s(Vec3{xj[0] - xi[0], xj[1] - xi[1], xj[2] - xi[2]},
                     Quaternion{qi[0], qi[1], qi[2], qi[3]} * Quaternion{f[0], f[1], f[2], f[3]},
                     Quaternion{qj[0], qj[1], qj[2], qj[3]} * Quaternion{f[4], f[5], f[6], f[7]},
                     weight, 2.0 - weight);
  return beam_loads(k, rest(p), s.distance, s.shear, s.bend, s.twist);
}

BondBPM::Values BondBeamMohrCoulomb::values(int row) {
  Values v{};
  const Pair p = pair(row);
  v.lost = option(1, row);
  v.damage = 1.0;
  if (!intact(row)) {
    if (!replaced(row)) return v;
    const BeamStiffness k = whole(row);
    const double reference = kinds_[p.type].law.touching ? p.ri + p.rj : state(REFERENCE, row);
    double shear2 = 0.0;
    for (int c = CSX; c <= (flat() ? CSX : CSZ); c++) shear2 += state(c, row) * state(c, row);
    v.energy = contact_energy(k.normal * std::max(0.0, reference - distance(row)), std::sqrt(shear2),
                              k.normal, k.shear);
    return v;
  }
  const BeamLoads l = loads(row);
  const double share = carried(row), R = radius(p);
  const double area = flat() ? 2.0 * R * style_->thickness : kPi * R * R;
  const double closed = l.fn < 0.0 ? 0.5 * l.fn * (distance(row) - rest(p)) : 0.0;  // in full
  v.fn = l.fn > 0.0 ? share * l.fn : l.fn;
  v.fs = share * l.fs;
  v.mb = share * l.mb;
  v.mt = share * std::fabs(l.mt);
  v.sigma = (l.fn + (flat() ? 3.0 : 4.0) * constant(BETA1, row) * l.mb / R) / area;
  v.tau = (l.fs + 2.0 * constant(BETA2, row) * std::fabs(l.mt) / R) / area;
  v.damage = 1.0 - share;
  v.energy = closed + share * (l.energy - closed);
  return v;
}

// Is there a contact of the bond's own after its break? Not where the pair has a grain contact.
bool BondBeamMohrCoulomb::replaced(int row) const {
  if (!grain_) return true;
  const Pair p = pair(row);
  const int i = table().at_lo[row], j = table().at_hi[row];
  double kn, ks, mu;
  grain_->constants(atom->type[i], atom->type[j], p.ri, p.rj, kn, ks, mu);
  return kn == 0.0;
}

// A contact that has replaced a bond is as stiff as it was.
BondBPM::Stiffness BondBeamMohrCoulomb::stiffness(int row) const {
  const BeamStiffness k = whole(row);
  if (intact(row)) return {k.normal, k.shear, k.bend, k.twist};
  if (!replaced(row)) return {0.0, 0.0, 0.0, 0.0};
  return {k.normal, k.shear, 0.0, 0.0};
}
