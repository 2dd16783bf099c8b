/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix damp/local ALPHA`: Cundall's local damping of forces and torques (local_damping.h).

   It acts on the sum of all forces, so it must be the last fix that touches them; a later one is an
   error. See fix_damp_local.md. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(damp/local,FixDampLocal)
// clang-format on

#else

#ifndef BONDLAB_FIX_DAMP_LOCAL_H
#define BONDLAB_FIX_DAMP_LOCAL_H

#include "fix.h"

namespace LAMMPS_NS {

class FixDampLocal : public Fix {
 public:
  FixDampLocal(class LAMMPS *, int, char **);
  int setmask();
  void init();
  void setup(int);
  void post_force(int);

 private:
  double alpha_;
};

}  // namespace LAMMPS_NS

#endif
#endif
