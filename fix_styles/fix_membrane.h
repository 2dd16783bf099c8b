/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix membrane`: a confining pressure on the lateral surface of a specimen, as by a soft
   jacket in a pressure cell.

   Method. The grains that touch the lateral surface at first use share its area: of a flank of a 2D
   specimen in proportion to their radii, of a cylinder in proportion to their radii squared. Each is
   pushed inwards, along the normal of the undeformed surface at its reference place, by the
   pressure times its share. On a cylinder the small net force of the shares' scatter is taken out, in
   proportion to them, so that nothing pushes the specimen aside.
   Why forces and not servo walls: a specimen that bulges or sheds flakes stays loaded everywhere,
   and no gain has to be chosen. The sets follow from reference positions, so nothing but the frame
   is kept. Sums are exact: the same bits on any number of ranks. See fix_membrane.md.
   Units: SI. Failure: errors that name the fix. Limits: area and normals of the first shape. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(membrane,FixMembrane)
// clang-format on

#else

#ifndef BONDLAB_FIX_MEMBRANE_H
#define BONDLAB_FIX_MEMBRANE_H

#include "fix.h"
#include "step_clock.h"

namespace LAMMPS_NS {

class FixMembrane : public Fix {
 public:
  FixMembrane(class LAMMPS *, int, char **);
  int setmask();
  void setup(int);
  void post_force(int);
  void reset_timestep(bigint, bigint);
  double compute_vector(int);
  void write_restart(FILE *);
  void restart(char *);

 private:
  class AtomVecBondedSphere *style_;
  int axial_;
  double pressure_, ramp_, reach_;  // Pa, s, m

  struct Frame {  // found at first use, restarted
    double placed = 0.0;
    double length = 0.0;              // of the specimen along the axis, m
    double lo = 0.0, hi = 0.0;        // flanks (2D), m
    double centre[2] = {0.0, 0.0};    // of the cylinder
    double radius = 0.0;
    double share[2] = {0.0, 0.0};     // sum of shares: lower and upper flank, or cylinder and 0
    double drift[2] = {0.0, 0.0};     // sum of share times outward normal, cylinder
    double particles = 0.0;
  } frame_;
  bondlab::StepClock clock_;

  void place();
  double pressure_now() const;
  // Side (0 or 1) of a particle on the surface with its outward normal, or -1.
  int side(const double *X, double radius, double normal[3]) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
