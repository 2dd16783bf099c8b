/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix platen`: a rigid, analytic loading platen (plane, cylinder or sphere) that moves at a
   speed, after a drive, on a frame, freely, or holds a force, and reports force, torque and motion.

   Geometry, contact law and motion are in platen_geometry.h, platen_law.h and fix_motion.h; here
   they meet the engine. The platen stands on every rank alike; its force is an exact sum, so all
   that is reported, and the servo, have the same bits on any number of ranks. It moves in
   initial_integrate, to the time at which forces are then computed. Nothing moves and no history
   advances while a run is being set up. See fix_platen.md.

   Units: SI. Failure: errors that name the fix and the value. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(platen,FixPlaten)
// clang-format on

#else

#ifndef BONDLAB_FIX_PLATEN_H
#define BONDLAB_FIX_PLATEN_H

#include <array>
#include <vector>

#include "exact_sum.h"
#include "fix.h"
#include "fix_motion.h"
#include "platen_geometry.h"
#include "platen_law.h"

namespace LAMMPS_NS {

class FixPlaten : public Fix {
 public:
  FixPlaten(class LAMMPS *, int, char **);
  ~FixPlaten();
  int setmask();
  void init();
  void setup(int);
  void initial_integrate(int);
  void post_force(int);
  void reset_timestep(bigint, bigint);
  double compute_vector(int);
  double memory_usage();

  void grow_arrays(int);
  void copy_arrays(int, int, int);
  void set_arrays(int);
  int pack_exchange(int, double *);
  int unpack_exchange(int, double *);
  int pack_restart(int, double *);
  void unpack_restart(int, int);
  int size_restart(int);
  int maxsize_restart();
  void write_restart(FILE *);
  void restart(char *);

 private:
  // what was asked for
  bondlab::PlatenGeometry surface_;  // as given in the deck
  bondlab::PlatenStiffness stiffness_;
  double ratio_, friction_;
  FixMotion motion_;
  bool touch_, touch_along_;
  bondlab::Vec3 along_;  // unit; direction of the approach

  // state, replicated and restarted
  bool placed_;         // touched, and the clock started
  double touch_shift_;  // m
  double force_[3];     // on the platen, N (what moves it, if anything does)

  double **history_;         // [nmax][6]: shear force (N) and normal of PlatenHistory
  unsigned char *touching_;  // [nmax]: 1 if the history isn't empty
  std::vector<unsigned char> near_;

  enum Sum { FORCE = 0, TORQUE = 3, TOUCHING = 6, ENERGY = 7, SUMS = 8 };
  std::vector<std::array<double, SUMS>> parts_;  // of the touching particles, until added up
  double total_[SUMS];
  bool reduced_;

  bondlab::PlatenGeometry now_;  // surface_ where it is now
  bondlab::Vec3 step_motion_;    // over the last step, m

  void read_arguments(int, char **);
  void read_keywords(class FixArguments &);
  void check_arguments(const class FixArguments &) const;
  void place();
  void check_nothing_is_behind();
  void stand();
  void apply(bool advance);
  void apply_to(int i, bool advance);
  void note_touching(int i);
  void reduce();
};

}  // namespace LAMMPS_NS

#endif
#endif
