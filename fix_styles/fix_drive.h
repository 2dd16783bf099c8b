/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix drive`: the loading programme of a test (rate steps, holds, unload-reload cycles), which
   platens and grips follow.

   The programme is drive_program.h; here it gets the run's time and a load named in the deck. It
   stands on every rank alike. It moves in initial_integrate, so it must be defined before whatever
   follows it. Units: SI. Failure: errors that name the fix and the value. See fix_drive.md. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(drive,FixDrive)
// clang-format on

#else

#ifndef BONDLAB_FIX_DRIVE_H
#define BONDLAB_FIX_DRIVE_H

#include <memory>

#include "drive_program.h"
#include "fix.h"
#include "fix_value_source.h"
#include "step_clock.h"

namespace LAMMPS_NS {

class FixDrive : public Fix {
 public:
  FixDrive(class LAMMPS *, int, char **);
  int setmask();
  void init();
  void setup(int);
  void initial_integrate(int);
  void reset_timestep(bigint, bigint);
  double compute_vector(int);
  void write_restart(FILE *);
  void restart(char *);

  double displacement() const { return state_.displacement; }  // at the step now under way, m
  double speed() const { return state_.speed; }                // m/s

 private:
  bondlab::DriveProgram program_;
  bondlab::DriveState state_;
  bondlab::StepClock clock_;
  std::unique_ptr<FixValueSource> load_;

  void read_event(class FixArguments &, bondlab::DriveEvent::Trigger);
  void read_cycles(class FixArguments &);
};

}  // namespace LAMMPS_NS

#endif
#endif
