/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix grip`: particles of a group are glued to a rigid body that moves without turning: the
   glued ends of a tension test, the clamp of a cantilever.

   The body takes the forces and torques of its particles (exact sums: the same bits on any number
   of ranks) and gives them its own velocity; fix nve/bonded, defined later, then moves them. Motion
   is that of fix platen (fix_motion.h). See fix_grip.md. Units: SI. Failure: errors that name the
   fix. Limits: no rotation; platens and other forces on the group must be defined before. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(grip,FixGrip)
// clang-format on

#else

#ifndef BONDLAB_FIX_GRIP_H
#define BONDLAB_FIX_GRIP_H

#include "fix.h"
#include "fix_motion.h"

namespace LAMMPS_NS {

class FixGrip : public Fix {
 public:
  FixGrip(class LAMMPS *, int, char **);
  int setmask();
  void init();
  void setup(int);
  void initial_integrate(int);
  void post_force(int);
  void reset_timestep(bigint, bigint);
  double compute_vector(int);
  void write_restart(FILE *);
  void restart(char *);

 private:
  FixMotion motion_;
  double centre_[3];  // mean position at first use, m
  double particles_;
  double total_[6];   // force and torque on the body
  double *force() { return total_; }

  void place();
  void take_forces();
};

}  // namespace LAMMPS_NS

#endif
#endif
