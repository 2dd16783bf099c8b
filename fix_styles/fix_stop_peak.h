/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix stop/peak`: end a run when a load has dropped from its peak (peak_watch.h), so that the
   deck's next line follows; the engine has no fix halt.

   Method: the run loop of the engine looks at the flag a signal sets, at the end of every step. All
   ranks decide from the same global numbers, set that flag, and take it back in post_run, before
   the deck is read on, so nothing looks like a signal afterwards. `run ... every` would instead set
   up the run again and again, which shifts the path. See fix_stop_peak.md.

   Units: those of the values. Failure: errors that name the fix. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(stop/peak,FixStopPeak)
// clang-format on

#else

#ifndef BONDLAB_FIX_STOP_PEAK_H
#define BONDLAB_FIX_STOP_PEAK_H

#include <memory>
#include <string>

#include "fix.h"
#include "fix_value_source.h"
#include "peak_watch.h"

namespace LAMMPS_NS {

class FixStopPeak : public Fix {
 public:
  FixStopPeak(class LAMMPS *, int, char **);
  int setmask();
  void init();
  void setup(int);
  void end_of_step();
  void post_run();
  double compute_vector(int);
  void write_restart(FILE *);
  void restart(char *);

  // How the present run ended, for those that write it down; "" if a signal broke it off.
  static std::string reason_of_end(class LAMMPS *lmp);

 private:
  std::unique_ptr<FixValueSource> value_, second_, excuse_;
  bondlab::PeakWatch watch_;
  int stopped_;  // PeakWatch::Verdict of the run this fix ended, for good
  bool ended_this_run_;
};

}  // namespace LAMMPS_NS

#endif
#endif
