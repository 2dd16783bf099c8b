// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see compute_stress_bonded.h.
//
// Method: sigma_p = 1/V_p sum of (x_c - x_p) (x) f over the particle's contact points c (Love 1927;
// Potyondy & Cundall 2004, eq. 21 before averaging), made symmetric. x_c divides the distance as the
// radii do, as the laws have it. Rows in order of tags: the same bits on any number of ranks.
#include "compute_stress_bonded.h"

#include <string>

#include "atom.h"
#include "bond_styles/liggghts/bond_bpm.h"
#include "bond_styles/liggghts/pair_grain.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "update.h"

using namespace LAMMPS_NS;

ComputeStressBonded::ComputeStressBonded(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), style_(AtomVecBondedSphere::of(lmp, "compute stress/bonded")),
      nmax_(0), stress_(NULL) {
  if (narg > iarg) {
    const std::string text =
        std::string("compute stress/bonded takes no further words, '") + arg[iarg] + "' was given";
    error->all(FLERR, text.c_str());
  }
  peratom_flag = 1;
  size_peratom_cols = 6;
}

ComputeStressBonded::~ComputeStressBonded() { memory->destroy(stress_); }

void ComputeStressBonded::init() {
  if (BondBPM::all(lmp).empty() && !dynamic_cast<PairGrain *>(force->pair))
    error->all(FLERR, "compute stress/bonded: there is neither a bond style of bonded particles nor `pair_style grain`");
}

void ComputeStressBonded::add(const bondlab::PairTable &t, int row, const double *f) {
  const int i = t.at_lo[row], j = t.at_hi[row];
  const double ri = atom->radius[i], rj = atom->radius[j], sum = ri + rj;
  const int own[2] = {t.own_lo[row], t.own_hi[row]};
  for (int side = 0; side < 2; side++) {
    if (own[side] >= atom->nlocal) continue;
    // on both sides force and branch change sign together
    const double share = (side == 0 ? ri : rj) / sum;
    double l[3];
    for (int d = 0; d < 3; d++) l[d] = share * (atom->x[j][d] - atom->x[i][d]);
    double *s = stress_[own[side]];
    for (int d = 0; d < 3; d++) s[d] += l[d] * f[d];
    s[3] += 0.5 * (l[0] * f[1] + l[1] * f[0]);
    s[4] += 0.5 * (l[0] * f[2] + l[2] * f[0]);
    s[5] += 0.5 * (l[1] * f[2] + l[2] * f[1]);
  }
}

void ComputeStressBonded::compute_peratom() {
  invoked_peratom = update->ntimestep;
  if (atom->nmax > nmax_) {
    nmax_ = atom->nmax;
    memory->destroy(stress_);
    memory->create(stress_, nmax_, 6, "stress/bonded:stress");
    array_atom = stress_;
  }
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 6; k++) stress_[i][k] = 0.0;
  if (PairGrain *grain = dynamic_cast<PairGrain *>(force->pair))
    grain->for_each_force([this](int row, const double *f) { add(style_->contacts, row, f); });
  for (BondBPM *bond : BondBPM::all(lmp))
    bond->for_each_force([this](int row, const double *f) { add(style_->bonds, row, f); });
  const double pi = 3.14159265358979323846;
  for (int i = 0; i < atom->nlocal; i++) {
    const double r = atom->radius[i];
    const double volume = domain->dimension == 2 ? pi * r * r * style_->thickness : 4.0 / 3.0 * pi * r * r * r;
    const double scale = atom->mask[i] & groupbit ? 1.0 / volume : 0.0;
    for (int k = 0; k < 6; k++) stress_[i][k] *= scale;
  }
}

double ComputeStressBonded::memory_usage() { return 6.0 * nmax_ * sizeof(double); }
