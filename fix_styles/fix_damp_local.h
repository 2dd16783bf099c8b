/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix damp/local ALPHA`: Cundall's local damping of forces and torques (local_damping.h).

   It acts on the sum of all forces, so it must be the last fix that touches them; a later one is an
   error. See fix_damp_local.md.

   With `energy yes` it keeps what damping took from each particle, by the trapezoid rule that velocity
   Verlet's own energy follows: in a step the damping force D does (D_n + D_n+1)/2 . v_n+1/2 dt of work. Both
   halves of D_n are taken when v_n+1/2 is known, before particles migrate: D_n follows from the damped force
   and v_n-1/2 = v_n+1/2 - dt F_n/m, so nothing but the sum is stored. It moves with its particle, so figures
   don't depend on ranks. */

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
  ~FixDampLocal();
  int setmask();
  void init();
  void setup(int);
  void post_force(int);
  void post_integrate();

  // Taken from own particle i so far, J; to be asked for at the end of a step. 0 without `energy yes`.
  double dissipated(int i) const;

  void grow_arrays(int);
  void copy_arrays(int, int, int);
  void set_arrays(int);
  int pack_exchange(int, double *);
  int unpack_exchange(int, double *);
  int size_restart(int);
  int maxsize_restart();
  int pack_restart(int, double *);
  void unpack_restart(int, int);
  double memory_usage();

 private:
  double alpha_;
  class AtomVecBondedSphere *style_;  // with `energy yes`
  double *taken_;                     // [nmax] J, or NULL
  bool first_step_;
  // Power of damping on particle i (W, negative): its force at a step with the velocities
  // v - back dt F/m, which gave the force its sign, and v - at dt F/m, which it acts along.
  double power(int i, const double *f, const double *t, double back, double at) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
