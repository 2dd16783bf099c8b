// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_norton.h. Coefficients, constants of a bond, restart.
#include <algorithm>
#include <cmath>

#include "atom.h"
#include "bond_norton.h"
#include "fix_property_atom.h"
#include "modify.h"
#include "read_number.h"

using namespace LAMMPS_NS;
using namespace bondlab::laws;

BondNorton::BondNorton(LAMMPS *lmp)
    : BondBPM(lmp, "norton", STATES, CONSTANTS, /* orientations */ false), common_(NULL),
      other_length_(false), kelvin_(0.0), particle_kelvin_(NULL) {}

void BondNorton::read_coefficients(BondCoefficients &words, int lo, int hi) {
  using C = BondCoefficients;
  Type t;
  NortonType &law = t.law;
  bool printed = false;
  law.modulus = words.number("E_b (Pa)", C::positive);
  law.poisson = words.number("nu_b", C::any);
  if (!(law.poisson > -1.0 && law.poisson <= 0.5)) words.wrong("nu_b must be above -1 and at most 0.5");
  t.sigma.mean = words.number("sigma_max (Pa)", C::positive);
  t.tau.mean = words.number("tau_max (Pa)", C::positive);
  t.sigma.stream = 0;
  t.tau.stream = 1;
  const double A = words.number("A (Pa^-m/s)", C::not_negative);
  law.exponent = words.number("m", C::positive);
  if (A > 0.0) law.log_rate = std::log(A);
  while (words.more()) {
    const std::string word = words.keyword();
    if (word == "rate_at") {
      const double rate = words.number("rate_at: strain rate (1/s)", C::positive);
      law.log_rate = log_rate_at(rate, words.number("rate_at: stress (Pa)", C::positive), law.exponent);
    } else if (word == "rate_factor") {
      law.rate_factor = words.number("rate_factor", C::positive);
    } else if (word == "creep") {
      const std::string kind = words.word("creep");
      if (kind != "coupled" && kind != "separate" && kind != "none")
        words.wrong("creep is '" + kind + "', allowed are coupled, separate, none");
      law.creep = kind == "coupled" ? CreepKind::coupled
                                    : (kind == "none" ? CreepKind::none : CreepKind::separate);
    } else if (word == "shear_ratio") {
      law.shear_ratio = words.number("shear_ratio (A_s/A)", C::positive);
    } else if (word == "moment_creep") {
      law.moments = words.flag("moment_creep");
    } else if (word == "every") {
      t.every = words.number("every (steps)", C::positive);
      if (t.every != std::floor(t.every)) words.wrong("every must be a whole number of steps");
    } else if (word == "lambda") {
      law.lambda = words.number("lambda", C::positive);
    } else if (word == "diameter") {
      law.diameter = words.number("diameter (m)", C::positive);
    } else if (word == "beta") {
      law.beta = words.number("beta", C::not_negative);
    } else if (word == "length") {
      const std::string kind = words.word("length");
      if (kind != "center" && kind != "surface" && kind != "radii")
        words.wrong("length is '" + kind + "', allowed are center, radii and surface L_min (m)");
      law.length = kind == "surface" ? BondLength::surface
                   : kind == "radii" ? BondLength::radii
                                     : BondLength::center;
      if (law.length == BondLength::surface)
        law.least_length = words.number("length surface: L_min (m)", C::positive);
    } else if (word == "yield") {
      law.yield_t = words.number("yield: stress in tension (Pa)", C::positive);
      law.yield_c = words.number("yield: stress in compression (Pa)", C::positive);
    } else if (word == "yield_shear") {
      law.yield_s = words.number("yield_shear (Pa)", C::positive);
    } else if (word == "crushing") {
      law.crush = words.number("crushing (Pa)", C::positive);
    } else if (word == "arrhenius") {
      law.temperature.activation = words.number("arrhenius: Q (J/mol)", C::not_negative);
    } else if (word == "reference") {
      law.temperature.reference = words.number("reference (K)", C::positive);
    } else if (word == "modulus_slope") {
      law.temperature.modulus = words.number("modulus_slope (1/K)", C::any);
    } else if (word == "strength_slope") {
      law.temperature.strength = words.number("strength_slope (1/K)", C::any);
    } else if (word == "temperature") {
      const std::string from = words.word("temperature");
      if (from == "particles") {
        t.source = PARTICLES;
      } else if (from.compare(0, 2, "v_") == 0) {
        t.source = VARIABLE;
        t.variable = from.substr(2);
      } else {
        t.source = NUMBER;
        t.kelvin = bondlab::read_number(from.c_str());
        if (!(t.kelvin > 0.0))
          words.wrong("temperature is '" + from + "', allowed are a positive number (K), v_NAME, particles");
      }
    } else if (word == "printed") {
      printed = words.flag("printed");
    } else if (word == "scatter") {
      words.scatter({&t.sigma, &t.tau});
    } else if (word == "seed") {
      words.seed({&t.sigma, &t.tau});
    } else {
      words.unknown(word,
                    "rate_at, rate_factor, creep, shear_ratio, moment_creep, every, lambda, diameter, "
                    "beta, length, yield, yield_shear, crushing, arrhenius, reference, modulus_slope, "
                    "strength_slope, temperature, printed, scatter, seed");
    }
  }
  if (printed) use_printed_form(law, t.sigma.mean);
  kinds_.resize(atom->nbondtypes + 1);
  for (int i = lo; i <= hi; i++) kinds_[i] = t;
}

void BondNorton::init_style() {
  common_ = NULL;
  other_length_ = false;
  for (int i = 1; i < static_cast<int>(kinds_.size()); i++) {
    if (!mine(i)) continue;
    const Type &t = kinds_[i];
    if (!common_) common_ = &t;
    other_length_ = other_length_ || t.law.length != BondLength::center;
    const NortonType &a = common_->law, &b = t.law;
    if (a.creep != b.creep || a.moments != b.moments || a.cut_only != b.cut_only ||
        common_->every != t.every || common_->source != t.source || common_->kelvin != t.kelvin ||
        common_->variable != t.variable)
      bad("bond_style norton: creep, moment_creep, every, printed and temperature must be the same for "
          "all bond types; a type with A = 0 doesn't creep");
  }
  particle_kelvin_ = NULL;
  if (common_) {
    kelvin_ = common_->source == NUMBER ? common_->kelvin : common_->law.temperature.reference;
    if (common_->source == PARTICLES) {
      Fix *found = modify->find_fix_property("Temp", "property/atom", "scalar", 0, 0, "bond_style norton", false);
      particle_kelvin_ = dynamic_cast<FixPropertyAtom *>(found);
      if (!particle_kelvin_ || particle_kelvin_->comm_forward == 0)
        bad("bond_style norton: `temperature particles` needs the particles' temperature with its "
            "ghosts, e.g. `fix T all property/atom Temp scalar yes yes no 263.15` before the run");
    }
  }
  BondBPM::init_style();
}

void BondNorton::constants(const Pair &p, double *c) const {
  const Type &t = kinds_[p.type];
  const NortonType &n = t.law;
  c[MODULUS] = n.modulus;
  c[SHEAR] = 0.5 / (1.0 + n.poisson);
  c[LAMBDA] = n.lambda;
  c[HALF_DIAMETER] = 0.5 * n.diameter;
  c[LENGTH] = double(n.length);
  c[LEAST] = n.least_length;
  c[BETA] = n.beta;
  c[SIGMA_C] = bond_strength(t.sigma, p.tag_lo, p.tag_hi);
  c[TAU_C] = bond_strength(t.tau, p.tag_lo, p.tag_hi);
  c[CRUSH] = n.crush;
  c[YIELD_T] = n.yield_t;
  c[YIELD_C] = n.yield_c;
  c[YIELD_S] = n.yield_s;
  c[EXPONENT] = n.exponent;
  c[LOG_CREEP] = n.log_rate + std::log(n.rate_factor);
  c[LOG_SHEAR] = log_shear_ratio(n);
  c[BEND_SHAPE] = norton_bend_shape(n, flat());
  c[T_REF] = n.temperature.reference;
  c[ACTIVATION] = n.temperature.activation;
  c[MODULUS_SLOPE] = n.temperature.modulus;
  c[STRENGTH_SLOPE] = n.temperature.strength;
}

bool BondNorton::varies(int type, int constant) const {
  return (constant == SIGMA_C || constant == TAU_C) && kinds_[type].sigma.scatter != Scatter::none;
}

BondBPM::Opening BondNorton::opening(const Pair &p, const double *c) const {
  const NortonType &t = kinds_[p.type].law;
  const double radius = norton_radius(t, p.ri, p.rj);
  return {c[MODULUS] / norton_length(t, p.rest, p.ri, p.rj),
          flat() ? strip_section(radius, style_->thickness).area : round_section(radius).area, c[SIGMA_C]};
}

// ---- restart ------------------------------------------------------------------------------------

std::vector<double> BondNorton::coefficients(int type) const {
  const Type &t = kinds_[type];
  const NortonType &n = t.law;
  std::vector<double> row = {
      n.modulus, n.poisson, n.diameter, n.lambda, n.beta, n.exponent, n.log_rate, n.rate_factor,
      n.shear_ratio, n.crush, n.yield_t, n.yield_c, n.yield_s, double(int(n.creep)), double(n.moments),
      double(n.length), n.least_length, double(n.cut_only), n.temperature.reference,
      n.temperature.activation, n.temperature.modulus, n.temperature.strength,
      t.sigma.mean, double(int(t.sigma.scatter)), t.sigma.spread, double(t.sigma.seed),
      t.tau.mean, double(int(t.tau.scatter)), t.tau.spread, double(t.tau.seed),
      t.every, double(int(t.source)), t.kelvin};
  row.insert(row.end(), t.variable.begin(), t.variable.end());
  return row;
}

void BondNorton::set_coefficients(int type, const std::vector<double> &row) {
  kinds_.resize(atom->nbondtypes + 1);
  if (row.size() < 33) bad("restart file: bond_style norton was written by another version");
  Type &t = kinds_[type];
  NortonType &n = t.law;
  const double *v = row.data();
  n.modulus = v[0], n.poisson = v[1], n.diameter = v[2], n.lambda = v[3], n.beta = v[4];
  n.exponent = v[5], n.log_rate = v[6], n.rate_factor = v[7], n.shear_ratio = v[8], n.crush = v[9];
  n.yield_t = v[10], n.yield_c = v[11], n.yield_s = v[12];
  n.creep = static_cast<CreepKind>(int(v[13]));
  n.moments = v[14] != 0.0, n.length = BondLength(int(v[15])), n.least_length = v[16];
  n.cut_only = v[17] != 0.0;
  n.temperature = {v[18], v[19], v[20], v[21]};
  t.sigma = {v[22], static_cast<Scatter>(int(v[23])), v[24], std::uint64_t(v[25]), 0};
  t.tau = {v[26], static_cast<Scatter>(int(v[27])), v[28], std::uint64_t(v[29]), 1};
  t.every = v[30];
  t.source = static_cast<Source>(int(v[31]));
  t.kelvin = v[32];
  t.variable.clear();
  for (std::size_t k = 33; k < row.size(); k++) t.variable.push_back(static_cast<char>(row[k]));
}
