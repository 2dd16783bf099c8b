/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `compute bonded/local`: what each intact bond carries, a row a bond, for `dump local` and
   averages. See compute_bonded_local.md. */

#ifdef COMPUTE_CLASS

ComputeStyle(bonded/local,ComputeBondedLocal)

#else

#ifndef BONDLAB_COMPUTE_BONDED_LOCAL_H
#define BONDLAB_COMPUTE_BONDED_LOCAL_H

#include <vector>

#include "compute.h"

namespace LAMMPS_NS {

class ComputeBondedLocal : public Compute {
 public:
  ComputeBondedLocal(class LAMMPS *, int &iarg, int narg, char **arg);
  ~ComputeBondedLocal();
  void init();
  void compute_local();
  double memory_usage();

 private:
  class AtomVecBondedSphere *style_;
  std::vector<int> words_;  // which value each column holds
  std::vector<double> values_;
  std::vector<double *> rows_;
};

}  // namespace LAMMPS_NS

#endif
#endif
