/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `compute fragments`: how many fragments a specimen has, how heavy the largest is, how much
   mass passes given sieves, how many bonds are intact.

   Method: particles and intact bonds are gathered on all ranks and searched there
   (fragment_search.h), in order of tags: the same bits on any number of ranks. Done only when asked
   for, some milliseconds for 10,000 particles; ask every few hundred steps. See
   compute_fragments.md. Units: SI. Failure: an unknown word is an error. */

#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(fragments,ComputeFragments)
// clang-format on

#else

#ifndef BONDLAB_COMPUTE_FRAGMENTS_H
#define BONDLAB_COMPUTE_FRAGMENTS_H

#include <vector>

#include "compute.h"
#include "fragment_search.h"

namespace LAMMPS_NS {

// Of the whole system, the same on all ranks; `bonds` gets the number of intact bonds.
std::vector<bondlab::Fragment> fragments_of_run(class LAMMPS *lmp, const char *who, double &bonds);

class ComputeFragments : public Compute {
 public:
  ComputeFragments(class LAMMPS *, int &iarg, int, char **);
  ~ComputeFragments();
  void init() {}
  void compute_vector();

 private:
  std::vector<double> sieves_;
};

}  // namespace LAMMPS_NS

#endif
#endif
