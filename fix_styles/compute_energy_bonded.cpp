// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see compute_energy_bonded.h.
#include "compute_energy_bonded.h"

#include <string>

#include "atom.h"
#include "bond_styles/liggghts/bond_bpm.h"
#include "bond_styles/liggghts/pair_grain.h"
#include "domain.h"
#include "error.h"
#include "exact_sum_mpi.h"
#include "fix_damp_local.h"
#include "force.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
enum Part { BOND, CONTACT, TRANSLATION, ROTATION, LOST, CREEP, INTACT, LOCAL, PARTS };
}

ComputeEnergyBonded::ComputeEnergyBonded(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), style_(AtomVecBondedSphere::of(lmp, "compute energy/bonded")) {
  if (narg > iarg) {
    const std::string text =
        std::string("compute energy/bonded takes no further words, '") + arg[iarg] + "' was given";
    error->all(FLERR, text.c_str());
  }
  vector_flag = 1;
  size_vector = PARTS;
  extvector = 1;
  vector = new double[PARTS];
}

ComputeEnergyBonded::~ComputeEnergyBonded() { delete[] vector; }

void ComputeEnergyBonded::init() {
  if (igroup != 0)
    error->all(FLERR, "compute energy/bonded: bonds belong to no group, use the group `all`");
}

void ComputeEnergyBonded::compute_vector() {
  invoked_vector = update->ntimestep;
  bondlab::ExactSums<PARTS> sums;
  for (BondBPM *bond : BondBPM::all(lmp))
    for (int row = 0; row < style_->bonds.size(); row++) {
      if (!bond->computes(row) || !bond->counted_here(row)) continue;
      if (bond->intact(row)) sums.add(INTACT, 1.0);
      const BondBPM::Values values = bond->values(row);
      sums.add(BOND, values.energy);
      sums.add(CONTACT, bond->contact_row_energy(row));
      sums.add(LOST, values.lost);
      sums.add(CREEP, values.creep);
    }
  if (PairGrain *grain = dynamic_cast<PairGrain *>(force->pair))
    grain->for_each_contact([&](double kn, double ks, double overlap, double shear) {
      sums.add(CONTACT, bondlab::laws::contact_energy(kn * overlap, shear, kn, ks));
    });
  const double inertia = domain->dimension == 2 ? 0.5 : 0.4;
  for (int i = 0; i < atom->nlocal; i++) {
    double v2 = 0.0, w2 = 0.0;
    for (int d = 0; d < 3; d++) {
      v2 += atom->v[i][d] * atom->v[i][d];
      w2 += atom->omega[i][d] * atom->omega[i][d];
    }
    const double m = atom->rmass[i], r = atom->radius[i];
    sums.add(TRANSLATION, 0.5 * m * v2);
    sums.add(ROTATION, 0.5 * inertia * m * r * r * w2);
  }
  for (int k = 0; k < modify->nfix; k++)
    if (const FixDampLocal *damping = dynamic_cast<FixDampLocal *>(modify->fix[k]))
      for (int i = 0; i < atom->nlocal; i++) sums.add(LOCAL, damping->dissipated(i));
  bondlab::sum_over_ranks(sums, world);
  for (int k = 0; k < PARTS; k++) vector[k] = sums.value(k);
}
