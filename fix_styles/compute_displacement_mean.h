/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `compute displacement/mean`: mean displacement of a group of particles from their reference
   positions: the deflection under a roller, the opening of a crack's mouth, the drop of a tip.

   Exact sums, so the same bits on any number of ranks (the engine's xcm() isn't). See
   compute_displacement_mean.md. Units: m. Failure: an empty group gives NaN, which fix curve
   reports. */

#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(displacement/mean,ComputeDisplacementMean)
// clang-format on

#else

#ifndef BONDLAB_COMPUTE_DISPLACEMENT_MEAN_H
#define BONDLAB_COMPUTE_DISPLACEMENT_MEAN_H

#include "compute.h"

namespace LAMMPS_NS {

class ComputeDisplacementMean : public Compute {
 public:
  ComputeDisplacementMean(class LAMMPS *, int &iarg, int, char **);
  ~ComputeDisplacementMean();
  void init() {}
  void compute_vector();

 private:
  class AtomVecBondedSphere *style_;
};

}  // namespace LAMMPS_NS

#endif
#endif
