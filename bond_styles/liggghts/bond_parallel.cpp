// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_parallel.h.
#include "bond_parallel.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "bond_dispatch.h"

using namespace LAMMPS_NS;
using namespace bondlab::laws;

BondParallel::BondParallel(LAMMPS *lmp)
    : BondBPM(lmp, "parallel", STATES, CONSTANTS, /* orientations */ false) {}

void BondParallel::read_coefficients(BondCoefficients &words, int lo, int hi) {
  Type t;
  t.law.modulus = words.number("E_b (Pa)", BondCoefficients::positive);
  t.law.ratio = words.number("kn_ks", BondCoefficients::positive);
  t.sigma.mean = words.number("sigma_c (Pa)", BondCoefficients::positive);
  t.tau.mean = words.number("tau_c (Pa)", BondCoefficients::positive);
  t.sigma.stream = 0;
  t.tau.stream = 1;
  while (words.more()) {
    const std::string word = words.keyword();
    if (word == "lambda") {
      t.law.lambda = words.number("lambda", BondCoefficients::positive);
    } else if (word == "beta") {
      t.law.beta = words.number("beta", BondCoefficients::not_negative);
    } else if (word == "friction_angle") {
      const double degrees = words.number("friction_angle (degrees)", BondCoefficients::not_negative);
      if (degrees >= 90.0) words.wrong("friction_angle must be below 90 degrees");
      t.law.tan_phi = std::tan(degrees * kPi / 180.0);
    } else if (word == "scatter") {
      words.scatter({&t.sigma, &t.tau});
    } else if (word == "seed") {
      words.seed({&t.sigma, &t.tau});
    } else {
      words.unknown(word, "lambda, beta, friction_angle, scatter, seed");
    }
  }
  kinds_.resize(atom->nbondtypes + 1);
  for (int i = lo; i <= hi; i++) kinds_[i] = t;
}

void BondParallel::constants(const Pair &p, double *c) const {
  const Type &t = kinds_[p.type];
  c[RADIUS_FACTOR] = t.law.lambda;
  c[MODULUS] = t.law.modulus;
  c[RATIO] = t.law.ratio;
  c[BETA] = t.law.beta;
  c[TAN_PHI] = t.law.tan_phi;
  c[SIGMA_C] = bond_strength(t.sigma, p.tag_lo, p.tag_hi);
  c[TAU_C] = bond_strength(t.tau, p.tag_lo, p.tag_hi);
}

bool BondParallel::varies(int type, int constant) const {
  return (constant == SIGMA_C || constant == TAU_C) && kinds_[type].sigma.scatter != Scatter::none;
}

BondBPM::Opening BondParallel::opening(const Pair &p, const double *c) const {
  const double radius = c[RADIUS_FACTOR] * std::min(p.ri, p.rj);
  const BondSection s = flat() ? strip_section(radius, style_->thickness) : round_section(radius);
  return {c[MODULUS] / (p.ri + p.rj), s.area, c[SIGMA_C]};
}

void BondParallel::strengths(int row, double &sigma_c, double &tau_c) const {
  sigma_c = constant(SIGMA_C, row);
  tau_c = constant(TAU_C, row);
}

// Radius and stiffness of the block's bonds follow from the radii of their particles.
template <bool advance, bool options, bool contact>
void BondParallel::block(Block &b, const Kinematics3 &k, PairLoads3 &loads) {
  double *radius = b.scratch[kMostConstants + 4], *stiffness = b.scratch[kMostConstants + 5];
  bondlab::bond_sizes(k, b.constant[RADIUS_FACTOR], b.constant[MODULUS], radius, stiffness);
  const ParallelArrays3 a{b.state[REST], radius, stiffness, b.constant[RATIO], b.constant[BETA],
                          b.constant[TAN_PHI], b.constant[SIGMA_C], b.constant[TAU_C], b.alive,
                          b.law(FSX), b.law(FSY), b.law(FSZ), b.law(MBX), b.law(MBY), b.law(MBZ),
                          b.law(MT), b.report.sigma, b.report.tau, b.report.fate};
  parallel_block_3d<advance, options, contact>(k, a, b.contact, b.state[CSX], b.state[CSY],
                                               b.state[CSZ], loads, b.options);
}

template <bool advance, bool options, bool contact>
void BondParallel::block(Block &b, const Kinematics2 &k, PairLoads2 &loads) {
  double *radius = b.scratch[kMostConstants + 4], *stiffness = b.scratch[kMostConstants + 5];
  bondlab::bond_sizes(k, b.constant[RADIUS_FACTOR], b.constant[MODULUS], radius, stiffness);
  const ParallelArrays2 a{b.state[REST], radius, stiffness, b.constant[RATIO], b.constant[BETA],
                          b.constant[TAN_PHI], b.constant[SIGMA_C], b.constant[TAU_C],
                          style_->thickness, b.alive, b.law(FSX), b.law(MBX), b.report.sigma,
                          b.report.tau, b.report.fate};
  parallel_block_2d<advance, options, contact>(k, a, b.contact, b.state[CSX], loads, b.options);
}

void BondParallel::block_3d(Block &b, const Kinematics3 &k, const Orientations3 &, bool advance,
                            PairLoads3 &loads) {
  bondlab::dispatch(advance, b.with_options, b.with_contact, [&](auto a, auto o, auto c) {
    block<a.value, o.value, c.value>(b, k, loads);
  });
}

void BondParallel::block_2d(Block &b, const Kinematics2 &k, const Orientations2 &, bool advance,
                            PairLoads2 &loads) {
  bondlab::dispatch(advance, b.with_options, b.with_contact, [&](auto a, auto o, auto c) {
    block<a.value, o.value, c.value>(b, k, loads);
  });
}

BondSection BondParallel::section(int row, double &kn, double &ks) const {
  const Pair p = pair(row);
  const double radius = constant(RADIUS_FACTOR, row) * std::min(p.ri, p.rj);
  kn = constant(MODULUS, row) / (p.ri + p.rj);
  ks = kn / constant(RATIO, row);
  return flat() ? strip_section(radius, style_->thickness) : round_section(radius);
}

BondBPM::Values BondParallel::values(int row) {
  Values v{};
  v.lost = option(1, row);
  v.damage = 1.0;
  if (!intact(row)) return v;
  double kn, ks;
  const BondSection s = section(row, kn, ks);
  const double stretch = distance(row) - state(REST, row);
  if (stretch > 0.0) kn *= types_[pair(row).type].tension;
  const double fn = kn * s.area * stretch, share = carried(row);
  double fs2 = 0.0, mb2 = 0.0;
  for (int c = 0; c < (flat() ? 1 : 3); c++) {
    fs2 += state(LAW + FSX + c, row) * state(LAW + FSX + c, row);
    mb2 += state(LAW + MBX + c, row) * state(LAW + MBX + c, row);
  }
  const double fs = std::sqrt(fs2), mb = std::sqrt(mb2), mt = flat() ? 0.0 : state(LAW + MT, row);
  const double kb = kn / (stretch > 0.0 ? types_[pair(row).type].tension : 1.0);
  const double closed = fn > 0.0 ? share : 1.0;
  v.fn = closed * fn;
  v.fs = share * fs;
  v.mb = share * mb;
  v.mt = share * std::fabs(mt);
  const double rim = constant(BETA, row) * constant(RADIUS_FACTOR, row) * std::min(pair(row).ri, pair(row).rj);
  v.sigma = fn / s.area + rim * mb / s.bend;
  v.tau = fs / s.area + (s.twist > 0.0 ? rim * std::fabs(mt) / s.twist : 0.0);
  v.damage = 1.0 - share;
  v.energy = closed * 0.5 * fn * fn / (kn * s.area) +
             share * parallel_energy(0.0, fs, mb, mt, kb, ks, s);
  return v;
}

BondBPM::Stiffness BondParallel::stiffness(int row) const {
  if (!intact(row)) return {0.0, 0.0, 0.0, 0.0};
  double kn, ks;
  const BondSection s = section(row, kn, ks);
  return {kn * s.area, ks * s.area, kn * s.bend, ks * s.twist};
}

std::vector<double> BondParallel::coefficients(int type) const {
  const Type &t = kinds_[type];
  return {t.law.modulus, t.law.ratio, t.law.lambda, t.law.beta, t.law.tan_phi,
          t.sigma.mean, double(int(t.sigma.scatter)), t.sigma.spread, double(t.sigma.seed),
          t.tau.mean, double(int(t.tau.scatter)), t.tau.spread, double(t.tau.seed)};
}

void BondParallel::set_coefficients(int type, const std::vector<double> &row) {
  kinds_.resize(atom->nbondtypes + 1);
  if (row.size() != 13) bad("restart file: bond_style parallel was written by another version");
  Type &t = kinds_[type];
  t.law = {row[0], row[1], row[2], row[3], row[4]};
  t.sigma = {row[5], static_cast<Scatter>(int(row[6])), row[7], std::uint64_t(row[8]), 0};
  t.tau = {row[9], static_cast<Scatter>(int(row[10])), row[11], std::uint64_t(row[12]), 1};
}
