/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: let grains that fly off a specimen fly in a box that grows after them (`boundary m` or `s`),
   without letting the box grow for ever. The atom style adds it by itself; it takes no part in a
   deck.

   Method: before each rebuild of the neighbour lists, while the old box still stands. An own
   particle farther beyond the box of the start than 20 times its largest side, or at a position that
   is no number, ends the run with an error that names it: it doesn't come from a specimen that breaks
   (20 boxes in a run of 10 ms are hundreds of m/s) but from an integration that diverged. The engine
   bins the whole box, for its lists and to sort particles; bins that would outnumber the grains by far
   are made larger. The order in which pairs are found depends on the bins, results don't
   (pair_table.h).
   Units: m. Failure: Error::one, the text says "has flown" or "is not a number".
   Limits: does nothing in a fixed or fully periodic box. After a restart the start is the box of the
   restart file, and its first bins are as many as the engine likes. Replaces `neigh_modify binsize`
   and the bins of `atom_modify sort` once they are too many. With several ranks the box is cut into
   equal parts as before: when it has grown much, one rank has most of the grains. */

#ifdef FIX_CLASS

FixStyle(bonded/box,FixBondedBox)

#else

#ifndef BONDLAB_FIX_BONDED_BOX_H
#define BONDLAB_FIX_BONDED_BOX_H

#include "fix.h"

namespace LAMMPS_NS {

class FixBondedBox : public Fix {
 public:
  FixBondedBox(class LAMMPS *, int, char **);
  int setmask();
  void setup_pre_exchange() { watch(); }
  void pre_exchange() { watch(); }

 private:
  double start_lo_[3], start_hi_[3];  // box of the start
  double far_;                        // how far beyond it a grain may be
  bool larger_bins_;
  void watch();
  void check_grain(int i);
  void bound_bins(const double *lo, const double *hi);
};

}  // namespace LAMMPS_NS

#endif
#endif
