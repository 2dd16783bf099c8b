// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_norton.h. What a step does; coefficients and restart are in bond_norton_setup.cpp.
#include "bond_norton.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "bond_dispatch.h"
#include "fix_property_atom.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

using namespace LAMMPS_NS;
using namespace bondlab::laws;

void BondNorton::compute(int eflag, int vflag) {
  if (common_->source == VARIABLE) {
    std::vector<char> name(common_->variable.begin(), common_->variable.end());
    name.push_back('\0');
    Variable *variable = input->variable;
    const int found = variable->find(name.data());
    if (found < 0 || !variable->equalstyle(found))
      bad("bond_style norton: the temperature's variable '" + common_->variable +
          "' isn't an equal-style variable of this deck");
    kelvin_ = variable->compute_equal(found);
    if (!(kelvin_ > 0.0))
      bad("bond_style norton: the temperature's variable '" + common_->variable + "' is " +
          std::to_string(kelvin_) + ", it must be positive (K)");
  }
  if (particle_kelvin_) particle_kelvin_->do_forward_comm();
  BondBPM::compute(eflag, vflag);
}

double BondNorton::kelvin_of(int row) const {
  if (!particle_kelvin_) return kelvin_;
  const double *T = particle_kelvin_->vector_atom;
  return 0.5 * (T[table().at_lo[row]] + T[table().at_hi[row]]);
}

// Sizes from the particles; modulus, creep and strengths at the temperature.
NortonConstants BondNorton::constants_of(Block &b, Columns &c) const {
  const double *__restrict lambda = b.constant[LAMBDA], *__restrict half = b.constant[HALF_DIAMETER],
               *__restrict ri = b.ri, *__restrict rj = b.rj, *__restrict rest = b.state[REST];
  for (int k = 0; k < kBlock; ++k) {
    const double smaller = ri[k] < rj[k] ? ri[k] : rj[k], scaled = lambda[k] * smaller;
    c.radius[k] = half[k] > 0.0 ? half[k] : scaled;
  }
  NortonConstants n{rest, c.radius, b.constant[MODULUS], b.constant[SHEAR], b.constant[BETA],
                    b.constant[SIGMA_C], b.constant[TAU_C], b.constant[CRUSH], b.constant[YIELD_T],
                    b.constant[YIELD_C], b.constant[YIELD_S], b.constant[EXPONENT],
                    b.constant[LOG_CREEP], b.constant[LOG_SHEAR], b.constant[BEND_SHAPE]};
  if (other_length_) {
    const double *kind = b.constant[LENGTH], *least = b.constant[LEAST];
    for (int k = 0; k < kBlock; ++k) {
      const double radii = ri[k] + rj[k], gap = rest[k] - radii;
      const double other =
          kind[k] == double(BondLength::radii) ? radii : gap > least[k] ? gap : least[k];
      c.length[k] = kind[k] != double(BondLength::center) ? other : rest[k];
    }
    n.length = c.length;
  }
  if (common_->source == REFERENCE_T) return n;

  for (int k = 0; k < kBlock; ++k)
    c.kelvin[k] = kelvin_of(std::min(b.first + k, table().size() - 1));
  const double *__restrict reference = b.constant[T_REF], *__restrict activation = b.constant[ACTIVATION],
               *__restrict stiffening = b.constant[MODULUS_SLOPE], *__restrict slope = b.constant[STRENGTH_SLOPE],
               *__restrict modulus = b.constant[MODULUS], *__restrict log_creep = b.constant[LOG_CREEP];
  for (int k = 0; k < kBlock; ++k) {
    const TemperatureLaw law{reference[k], activation[k], stiffening[k], slope[k]};
    const double share = linear_share(slope[k], c.kelvin[k], reference[k]);
    c.modulus[k] = modulus[k] * linear_share(stiffening[k], c.kelvin[k], reference[k]);
    c.creep[k] = log_creep[k] + log_arrhenius(law, c.kelvin[k]);
    for (int s = 0; s < 6; ++s) c.strength[s][k] = share * b.constant[SIGMA_C + s][k];
  }
  n.modulus = c.modulus, n.log_creep = c.creep;
  n.sigma_c = c.strength[0], n.tau_c = c.strength[1], n.crush_c = c.strength[2];
  n.yield_t = c.strength[3], n.yield_c = c.strength[4], n.yield_s = c.strength[5];
  return n;
}

// Creep falls due at steps that are multiples of `every`, whenever a run began.
NortonStep BondNorton::step_of(const Block &b, bool advance) const {
  NortonStep s;
  s.cut_only = common_->law.cut_only;
  const bigint every = static_cast<bigint>(common_->every);
  if (advance && update->ntimestep % every == 0) {
    s.creep = common_->law.creep;
    s.moments = common_->law.moments;
    s.log_time = std::log(common_->every * b.dt);
  }
  return s;
}

template <bool advance, bool options, bool contact>
void BondNorton::block(Block &b, const Kinematics3 &k, PairLoads3 &loads) {
  Columns columns;
  const NortonArrays3 a{constants_of(b, columns), b.state[REST], b.alive, b.law(STRAIN), b.law(THEN),
                        b.law(DISSIPATED), b.law(FSX), b.law(FSY), b.law(FSZ), b.law(MBX),
                        b.law(MBY), b.law(MBZ), b.law(MT), b.report.sigma, b.report.tau, b.report.fate};
  norton_block_3d<advance, options, contact>(k, a, step_of(b, advance), b.contact, b.state[CSX],
                                             b.state[CSY], b.state[CSZ], loads, b.options);
}

template <bool advance, bool options, bool contact>
void BondNorton::block(Block &b, const Kinematics2 &k, PairLoads2 &loads) {
  Columns columns;
  const NortonArrays2 a{constants_of(b, columns), style_->thickness, b.state[REST], b.alive,
                        b.law(STRAIN), b.law(THEN), b.law(DISSIPATED), b.law(FSX), b.law(MBX),
                        b.report.sigma, b.report.tau, b.report.fate};
  norton_block_2d<advance, options, contact>(k, a, step_of(b, advance), b.contact, b.state[CSX],
                                             loads, b.options);
}

void BondNorton::block_3d(Block &b, const Kinematics3 &k, const Orientations3 &, bool advance,
                          PairLoads3 &loads) {
  bondlab::dispatch(advance, b.with_options, b.with_contact, [&](auto a, auto o, auto c) {
    block<a.value, o.value, c.value>(b, k, loads);
  });
}

void BondNorton::block_2d(Block &b, const Kinematics2 &k, const Orientations2 &, bool advance,
                          PairLoads2 &loads) {
  bondlab::dispatch(advance, b.with_options, b.with_contact, [&](auto a, auto o, auto c) {
    block<a.value, o.value, c.value>(b, k, loads);
  });
}

BondNorton::Shape BondNorton::shape(int row) const {
  const Pair p = pair(row);
  const NortonType &t = kinds_[p.type].law;
  const double radius = norton_radius(t, p.ri, p.rj);
  return {norton_length(t, p.rest, p.ri, p.rj),
          flat() ? strip_section(radius, style_->thickness) : round_section(radius)};
}

BondBPM::Values BondNorton::values(int row) {
  Values v{};
  v.lost = option(1, row);
  v.creep = state(LAW + DISSIPATED, row);
  v.damage = 1.0;
  if (!intact(row)) return v;
  const int type = pair(row).type;
  const NortonType &t = kinds_[type].law;
  const Shape s = shape(row);
  const double then = state(LAW + THEN, row), E = then > 0.0 ? then : constant(MODULUS, row);
  const double elastic = (distance(row) - state(REST, row)) / s.length - state(LAW + STRAIN, row);
  const double En = elastic > 0.0 ? E * types_[type].tension : E;
  const double cap = t.yield_t * linear_share(t.temperature.strength, kelvin_of(row), t.temperature.reference);
  const double stress = t.cut_only ? std::min(En * elastic, cap) : En * elastic, share = carried(row);
  double fs2 = 0.0, mb2 = 0.0;
  for (int c = 0; c < (flat() ? 1 : 3); c++) {
    fs2 += state(LAW + FSX + c, row) * state(LAW + FSX + c, row);
    mb2 += state(LAW + MBX + c, row) * state(LAW + MBX + c, row);
  }
  const double fs = std::sqrt(fs2), mb = std::sqrt(mb2), mt = flat() ? 0.0 : std::fabs(state(LAW + MT, row));
  const double rim = t.beta * norton_radius(t, pair(row).ri, pair(row).rj);
  v.fn = (stress > 0.0 ? share : 1.0) * stress * s.section.area;
  v.fs = share * fs;
  v.mb = share * mb;
  v.mt = share * mt;
  v.sigma = stress + rim * mb * s.section.per_bend;
  v.tau = fs * s.section.per_area + rim * mt * s.section.per_twist;
  v.damage = 1.0 - share;
  v.energy = norton_energy(stress, En, fs, mb, mt, E, constant(SHEAR, row), s.length, share, s.section);
  return v;
}

BondBPM::Stiffness BondNorton::stiffness(int row) const {
  if (!intact(row)) return {0.0, 0.0, 0.0, 0.0};
  const Shape s = shape(row);
  const double then = state(LAW + THEN, row);
  const double kn = (then > 0.0 ? then : constant(MODULUS, row)) / s.length, ks = kn * constant(SHEAR, row);
  return {kn * s.section.area, ks * s.section.area, kn * s.section.bend, ks * s.section.twist};
}

void BondNorton::strengths(int row, double &sigma_c, double &tau_c) const {
  const TemperatureLaw &law = kinds_[pair(row).type].law.temperature;
  const double share = linear_share(law.strength, kelvin_of(row), law.reference);
  sigma_c = share * constant(SIGMA_C, row);
  tau_c = share * constant(TAU_C, row);
}
