// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_beam_mohr_coulomb.h. Words of `bond_coeff`, numbers of a restart.
#include <cmath>

#include "atom.h"
#include "bond_beam_mohr_coulomb.h"
#include "laws/parallel.h"

using namespace LAMMPS_NS;
using namespace bondlab::laws;

void BondBeamMohrCoulomb::read_coefficients(BondCoefficients &words, int lo, int hi) {
  using Words = BondCoefficients;
  Type t;
  t.law.modulus = words.number("E_b (Pa)", Words::positive);
  t.law.poisson = words.number("nu_b", Words::any);
  if (t.law.poisson <= -1.0 || t.law.poisson > 0.5) words.wrong("nu_b must be above -1, at most 0.5");
  t.cohesion.mean = words.number("cohesion (Pa)", Words::positive);
  const double degrees = words.number("friction_angle (degrees)", Words::not_negative);
  if (degrees >= 90.0) words.wrong("friction_angle must be below 90 degrees");
  t.law.tan_phi = std::tan(degrees * kPi / 180.0);
  t.cutoff.mean = t.law.cutoff;
  t.cutoff.stream = 1;
  while (words.more()) {
    const std::string word = words.keyword();
    if (word == "lambda") {
      t.law.lambda = words.number("lambda", Words::positive);
    } else if (word == "tension_cutoff") {
      t.cutoff.mean = words.number("tension_cutoff (Pa)", Words::positive);
    } else if (word == "beta1") {
      t.law.beta1 = words.number("beta1", Words::not_negative);
    } else if (word == "beta2") {
      t.law.beta2 = words.number("beta2", Words::not_negative);
    } else if (word == "bend_factor") {
      t.law.bend_factor = words.number("bend_factor", Words::positive);
    } else if (word == "friction") {
      t.law.friction = words.number("friction", Words::not_negative);
    } else if (word == "shear") {
      const std::string kind = words.word("shear");
      if (kind != "GA" && kind != "euler" && kind != "timoshenko")
        words.wrong("shear is '" + kind + "', allowed are GA, euler, timoshenko");
      t.law.shear = kind == "GA" ? BeamShear::GA
                    : kind == "euler" ? BeamShear::euler : BeamShear::timoshenko;
    } else if (word == "rest") {
      const std::string kind = words.word("rest");
      if (kind != "distance" && kind != "touching")
        words.wrong("rest is '" + kind + "', allowed are distance, touching");
      t.law.touching = kind == "touching";
    } else if (word == "shear_point") {
      const std::string kind = words.word("shear_point");
      if (kind != "middle" && kind != "surface")
        words.wrong("shear_point is '" + kind + "', allowed are middle, surface");
      t.law.at_contact = kind == "surface";
    } else if (word == "scatter") {
      // without a cut-off there is nothing of it to scatter
      if (t.cutoff.mean == t.law.cutoff)
        words.scatter({&t.cohesion});
      else
        words.scatter({&t.cohesion, &t.cutoff});
    } else if (word == "seed") {
      words.seed({&t.cohesion, &t.cutoff});
    } else {
      words.unknown(word, "lambda, tension_cutoff, beta1, beta2, bend_factor, shear, shear_point, rest, friction, scatter, seed");
    }
  }
  kinds_.resize(atom->nbondtypes + 1);
  for (int i = lo; i <= hi; i++) kinds_[i] = t;
}

std::vector<double> BondBeamMohrCoulomb::coefficients(int type) const {
  const Type &t = kinds_[type];
  const BeamParameters &p = t.law;
  return {p.modulus, p.poisson, p.tan_phi, p.beta1, p.beta2, p.bend_factor, p.lambda, p.friction,
          double(int(p.shear)), double(p.touching), double(p.at_contact),
          t.cohesion.mean, double(int(t.cohesion.scatter)), t.cohesion.spread, double(t.cohesion.seed),
          t.cutoff.mean, double(int(t.cutoff.scatter)), t.cutoff.spread, double(t.cutoff.seed)};
}

void BondBeamMohrCoulomb::set_coefficients(int type, const std::vector<double> &row) {
  kinds_.resize(atom->nbondtypes + 1);
  if (row.size() != 19) bad("restart file: bond_style beam/mohr/coulomb was written by another version");
  Type &t = kinds_[type];
  BeamParameters &p = t.law;
  p.modulus = row[0], p.poisson = row[1], p.tan_phi = row[2], p.beta1 = row[3], p.beta2 = row[4];
  p.bend_factor = row[5], p.lambda = row[6], p.friction = row[7];
  p.shear = static_cast<BeamShear>(int(row[8])), p.touching = row[9] != 0.0;
  p.at_contact = row[10] != 0.0;
  t.cohesion = {row[11], static_cast<Scatter>(int(row[12])), row[13], std::uint64_t(row[14]), 0};
  t.cutoff = {row[15], static_cast<Scatter>(int(row[16])), row[17], std::uint64_t(row[18]), 1};
}
