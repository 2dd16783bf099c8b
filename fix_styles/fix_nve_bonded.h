/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix nve/bonded`: move bonded spheres (or discs) by velocity Verlet, orientations too if
   asked; start each run from the force the last one ended with. See fix_nve_bonded.md. */

#ifdef FIX_CLASS

FixStyle(nve/bonded,FixNVEBonded)

#else

#ifndef BONDLAB_FIX_NVE_BONDED_H
#define BONDLAB_FIX_NVE_BONDED_H

#include "fix.h"

namespace LAMMPS_NS {

class FixNVEBonded : public Fix {
 public:
  FixNVEBonded(class LAMMPS *, int, char **);
  int setmask();
  void init();
  void initial_integrate(int);
  void final_integrate();
  void post_run();
  void reset_dt();

 private:
  class AtomVecBondedSphere *style_;
  bool orientation_, first_step_;
  double half_dt_, dt_, inertia_factor_;
  void half_kick();
  void turn();
};

}  // namespace LAMMPS_NS

#endif
#endif
