// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see compute_displacement_mean.h.
#include "compute_displacement_mean.h"

#include <string>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "domain.h"
#include "error.h"
#include "exact_sum_mpi.h"
#include "update.h"

using namespace LAMMPS_NS;

ComputeDisplacementMean::ComputeDisplacementMean(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg),
      style_(AtomVecBondedSphere::of(lmp, "compute displacement/mean")) {
  if (narg > iarg) {
    const std::string text = std::string("compute displacement/mean takes no further words, '") +
                             arg[iarg] + "' was given";
    error->all(FLERR, text.c_str());
  }
  vector_flag = 1;
  size_vector = 4;
  extvector = 0;
  vector = new double[4];
}

ComputeDisplacementMean::~ComputeDisplacementMean() { delete[] vector; }

void ComputeDisplacementMean::compute_vector() {
  invoked_vector = update->ntimestep;
  bondlab::ExactSums<4> sums;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double u[3];
    domain->unmap(atom->x[i], atom->image[i], u);
    for (int d = 0; d < 3; d++) sums.add(d, u[d] - style_->xref[i][d]);
    sums.add(3, 1.0);
  }
  bondlab::sum_over_ranks(sums, world);
  vector[3] = sums.value(3);
  for (int d = 0; d < 3; d++) vector[d] = sums.value(d) / vector[3];
}
