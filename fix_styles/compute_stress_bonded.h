/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `compute stress/bonded`: stress tensor of each particle from the forces of its bonds and
   contacts. See compute_stress_bonded.md. */

#ifdef COMPUTE_CLASS

ComputeStyle(stress/bonded,ComputeStressBonded)

#else

#ifndef BONDLAB_COMPUTE_STRESS_BONDED_H
#define BONDLAB_COMPUTE_STRESS_BONDED_H

#include "compute.h"

namespace bondlab {
class PairTable;
}

namespace LAMMPS_NS {

class ComputeStressBonded : public Compute {
 public:
  ComputeStressBonded(class LAMMPS *, int &iarg, int narg, char **arg);
  ~ComputeStressBonded();
  void init();
  void compute_peratom();
  double memory_usage();

 private:
  class AtomVecBondedSphere *style_;
  int nmax_;
  double **stress_;  // [nmax_][6] xx yy zz xy xz yz, Pa, tension positive
  void add(const bondlab::PairTable &, int row, const double *force);
};

}  // namespace LAMMPS_NS

#endif
#endif
