// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see compute_bonded_local.h.
#include "compute_bonded_local.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "bond_styles/liggghts/bond_bpm.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
const std::vector<std::string> kWords = {"id1", "id2",  "type", "x",   "y",     "z",      "nx",   "ny",
                                         "nz",  "dist", "fn",   "fs",  "mb",    "mt",     "sigma", "tau",
                                         "damage", "energy", "lost", "creep"};
}

ComputeBondedLocal::ComputeBondedLocal(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), style_(AtomVecBondedSphere::of(lmp, "compute bonded/local")) {
  std::string allowed;
  for (const std::string &word : kWords) allowed += (allowed.empty() ? "" : ", ") + word;
  if (narg == iarg)
    error->all(FLERR, ("compute bonded/local: name at least one value, allowed are " + allowed).c_str());
  for (; iarg < narg; iarg++) {
    const auto found = std::find(kWords.begin(), kWords.end(), arg[iarg]);
    if (found == kWords.end())
      error->all(FLERR, (std::string("compute bonded/local: unknown value '") + arg[iarg] +
                         "', allowed are " + allowed).c_str());
    words_.push_back(static_cast<int>(found - kWords.begin()));
  }
  local_flag = 1;
  size_local_cols = words_.size() == 1 ? 0 : static_cast<int>(words_.size());
}

ComputeBondedLocal::~ComputeBondedLocal() {}

void ComputeBondedLocal::init() {
  if (BondBPM::all(lmp).empty())
    error->all(FLERR, "compute bonded/local needs a bond style of bonded particles, like `bond_style parallel`");
}

// The group counts by the bond's first particle.
void ComputeBondedLocal::compute_local() {
  invoked_local = update->ntimestep;
  const bondlab::PairTable &t = style_->bonds;
  values_.clear();
  int count = 0;
  for (BondBPM *bond : BondBPM::all(lmp)) {
    bond->refresh();
    for (int row = 0; row < t.size(); row++) {
      if (!bond->computes(row) || !bond->counted_here(row) || !bond->intact(row)) continue;
      if (!(atom->mask[t.own_lo[row]] & groupbit)) continue;
      const BondBPM::Values v = bond->values(row);
      const int i = t.at_lo[row], j = t.at_hi[row];
      const double *a = atom->x[i], *b = atom->x[j];
      const double share = atom->radius[i] / (atom->radius[i] + atom->radius[j]);
      double d[3], length2 = 0.0;
      for (int k = 0; k < 3; k++) {
        d[k] = b[k] - a[k];
        length2 += d[k] * d[k];
      }
      const double length = std::sqrt(length2);
      const double all[] = {double(t.lo[row]), double(t.hi[row]),
                            double(t.info[row] & BondBPM::TYPE_MASK),
                            a[0] + share * d[0], a[1] + share * d[1], a[2] + share * d[2],
                            d[0] / length, d[1] / length, d[2] / length, length,
                            v.fn, v.fs, v.mb, v.mt, v.sigma, v.tau, v.damage, v.energy, v.lost, v.creep};
      for (const int word : words_) values_.push_back(all[word]);
      count++;
    }
  }
  size_local_rows = count;
  const int width = static_cast<int>(words_.size());
  rows_.resize(count);
  for (int k = 0; k < count; k++) rows_[k] = values_.data() + k * width;
  if (width == 1)
    vector_local = values_.data();
  else
    array_local = rows_.data();
}

double ComputeBondedLocal::memory_usage() {
  return sizeof(double) * values_.capacity() + sizeof(double *) * rows_.capacity();
}
