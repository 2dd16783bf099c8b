/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `compute energy/bonded`: energies of the bonded network, the same on any number of ranks.
   See compute_energy_bonded.md. */

#ifdef COMPUTE_CLASS

ComputeStyle(energy/bonded,ComputeEnergyBonded)

#else

#ifndef BONDLAB_COMPUTE_ENERGY_BONDED_H
#define BONDLAB_COMPUTE_ENERGY_BONDED_H

#include "compute.h"

namespace LAMMPS_NS {

class ComputeEnergyBonded : public Compute {
 public:
  ComputeEnergyBonded(class LAMMPS *, int &iarg, int narg, char **arg);
  ~ComputeEnergyBonded();
  void init();
  void compute_vector();

 private:
  class AtomVecBondedSphere *style_;
};

}  // namespace LAMMPS_NS

#endif
#endif
