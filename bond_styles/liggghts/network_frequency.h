/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: the highest angular frequency of the bonded network, which the explicit step must resolve.

   Method: Lanczos iteration on M^-1/2 K M^-1/2 without ever forming K: one product is one pass over
   the bonds, with the mode in the particles' velocities so that the engine's own communication
   carries it to ghosts. k steps give the largest Ritz value theta and its residual; theta plus
   residual is taken (Zhou & Li 2011, Linear Algebra Appl. 435, 480-493: a safeguarded upper bound),
   but never more than Gershgorin's bound. Gershgorin alone lies 10 to 30 % above in frequency, and a
   plain power iteration below it by an unknown amount, which is the dangerous side.
   The start is a hash of tag and axis, dot products are exact sums: the same bits on any number of
   ranks.

   Units: 1/s2. Failure: 0 if there are no bonds. Limits: contacts that form later count only where a
   bond is (its pair's grain contact is included, as if closed); platens don't count. */

#ifndef BONDLAB_NETWORK_FREQUENCY_H
#define BONDLAB_NETWORK_FREQUENCY_H

namespace LAMMPS_NS {

struct NetworkFrequency {
  double omega2;        // 1/s2, an upper bound good to about a per cent
  double gershgorin2;   // 1/s2, a bound without iteration
  double damping_time;  // s, the longest of the bonds' dashpots
};

// Ghosts must be in place (comm->borders()), all ranks call.
NetworkFrequency network_frequency(class LAMMPS *lmp);

}  // namespace LAMMPS_NS

#endif
