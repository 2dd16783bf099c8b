/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix bond/log`: write every broken bond to a table (table_file.h) and count them.

   Bond styles note breaks on the rank that owns the bond (AtomVecBondedSphere::breaks); every N steps they are
   gathered on rank 0 and written in the order of step and tags, which no number of ranks changes.
   Counts include what is not yet gathered. See fix_bond_log.md.

   Units: m, s, Pa. Failure: errors that name the fix. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(bond/log,FixBondLog)
// clang-format on

#else

#ifndef BONDLAB_FIX_BOND_LOG_H
#define BONDLAB_FIX_BOND_LOG_H

#include "fix.h"
#include "fix_table.h"

namespace LAMMPS_NS {

class FixBondLog : public Fix {
 public:
  FixBondLog(class LAMMPS *, int, char **);
  int setmask();
  void init();
  void setup(int);
  void end_of_step();
  void post_run();
  double compute_vector(int);
  void reset_timestep(bigint, bigint);
  void write_restart(FILE *);
  void restart(char *);

 private:
  FixTable table_;
  class AtomVecBondedSphere *particles_;
  bigint gathered_[3];  // breaks gathered so far in tension, shear, crushing; on all ranks
  void gather();
};

}  // namespace LAMMPS_NS

#endif
#endif
