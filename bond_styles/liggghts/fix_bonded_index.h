/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: tell `atom_style bonded/sphere` that ghosts were made anew, so that its tables of pairs are
   put in order before the next force. The atom style adds it by itself; it takes no part in a deck. */

#ifdef FIX_CLASS

FixStyle(bonded/index,FixBondedIndex)

#else

#ifndef BONDLAB_FIX_BONDED_INDEX_H
#define BONDLAB_FIX_BONDED_INDEX_H

#include "atom_vec_bonded_sphere.h"
#include "fix.h"

namespace LAMMPS_NS {

class FixBondedIndex : public Fix {
 public:
  FixBondedIndex(class LAMMPS *lmp, int narg, char **arg)
      : Fix(lmp, narg, arg), style_(AtomVecBondedSphere::of(lmp, "fix bonded/index")) {}
  int setmask() { return FixConst::PRE_NEIGHBOR; }
  void setup_pre_neighbor() { style_->mark_stale(); }
  void pre_neighbor() { style_->mark_stale(); }

 private:
  AtomVecBondedSphere *style_;
};

}  // namespace LAMMPS_NS

#endif
#endif
