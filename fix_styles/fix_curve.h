/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix curve`: write numbers of the run (variables, fixes, computes) to a table every N steps,
   with names and units, and say at its end that it is complete (table_file.h). See fix_curve.md.

   Units: as the deck says. Failure: a number that is not finite stops the run and names the column
   and the step; a file that can't be written stops it too. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(curve,FixCurve)
// clang-format on

#else

#ifndef BONDLAB_FIX_CURVE_H
#define BONDLAB_FIX_CURVE_H

#include <memory>
#include <vector>

#include "fix.h"
#include "fix_table.h"
#include "fix_value_source.h"

namespace LAMMPS_NS {

class FixCurve : public Fix {
 public:
  FixCurve(class LAMMPS *, int, char **);
  int setmask();
  void init();
  void setup(int);
  void end_of_step();
  void post_run();
  void reset_timestep(bigint, bigint);
  void write_restart(FILE *);
  void restart(char *);

 private:
  FixTable table_;
  std::vector<std::unique_ptr<FixValueSource>> sources_;
};

}  // namespace LAMMPS_NS

#endif
#endif
