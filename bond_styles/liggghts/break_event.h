// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one broken bond, as it was when it broke. Plain data: it is sent between ranks as bytes.
// Units: m, Pa, J.
#ifndef BONDLAB_BREAK_EVENT_H
#define BONDLAB_BREAK_EVENT_H

#include "lmptype.h"

namespace LAMMPS_NS {

struct BreakEvent {
  bigint step;
  int tag_lo, tag_hi, type;
  double x[3];                        // contact point, m
  int mode;                           // 0 tension, 1 shear, 2 crushing
  double sigma, tau, sigma_c, tau_c;  // Pa
};

}  // namespace LAMMPS_NS

#endif
