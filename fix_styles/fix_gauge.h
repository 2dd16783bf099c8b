/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fix gauge`: axial and lateral strain of a specimen from the mean displacement of layers of
   its particles (gauge_strain.h), measured from the reference positions of the atom style.

   The specimen's extent is found at first use and restarted. Evaluated only when asked for. See
   fix_gauge.md. Units: m, 1. Failure: errors that name the fix; strains are NaN when a layer has
   lost all its particles. */

#ifdef FIX_CLASS

// clang-format off
FixStyle(gauge,FixGauge)
// clang-format on

#else

#ifndef BONDLAB_FIX_GAUGE_H
#define BONDLAB_FIX_GAUGE_H

#include "fix.h"
#include "gauge_strain.h"

namespace LAMMPS_NS {

class FixGauge : public Fix {
 public:
  FixGauge(class LAMMPS *, int, char **);
  int setmask();
  void init();
  void setup(int);
  double compute_vector(int);
  void write_restart(FILE *);
  void restart(char *);

 private:
  class AtomVecBondedSphere *style_;
  bondlab::GaugeSettings settings_;
  bondlab::GaugeFrame frame_;
  bool extent_given_, placed_;
  bigint measured_step_;  // of strain_; -1: none
  bondlab::GaugeStrain strain_;

  void read_arguments(int, char **);
  void place();
  void place_flanks();
  void measure();
  template <class Visit>
  void for_each_particle(Visit visit) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
