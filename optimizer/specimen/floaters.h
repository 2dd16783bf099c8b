// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: find the particles that carry nothing in a packing (floaters) and make each fill the hole
//   it sits in.
// Method: Potyondy & Cundall 2004 (Int. J. Rock Mech. Min. Sci. 41, appendix) grow floaters until
//   they touch. Here the place and the size are found at once: the distance to the nearest
//   surface, min_j (|x - x_j| - r_j), is climbed by sequential linear programmes. Each term is
//   convex, so a linearised step never promises more than it gives, and every maximum touches
//   dimension + 1 surfaces at once: as many as hold a particle without friction. Particles that
//   carry load are told by the load and not by counting contacts: one of the three may be faint.
// Units: any one length unit.
// Failure: none; what stays a floater is counted by the caller.
// Limits: inside a curved wall the distance is concave, and a maximum there may touch fewer
//   surfaces.
#pragma once

#include <vector>

#include "specimen/container.h"

namespace bondlab {

// true for particles without any contact, with walls or others, whose overlap is larger than load.
std::vector<bool> find_unloaded(const Container &container, const std::vector<Particle> &particles,
                                double load);

// true for particles with fewer than 3 (2D) or 4 (3D) surfaces, walls included, nearer than gap.
std::vector<bool> find_floaters(const Container &container, const std::vector<Particle> &particles,
                                double gap);

// Moves a particle to the nearest local maximum of its distance to the others and the walls, and
// returns that distance. obstacles: indices of the particles around it.
double climb_to_largest_hole(const Container &container, const std::vector<Particle> &particles,
                             const std::vector<int> &obstacles, Particle &floater);

// Seats every floater and gives it the radius of its hole plus `overlap`, at most `largest`.
// Returns how many there were.
int seat_floaters(const Container &container, std::vector<Particle> &particles,
                  const std::vector<bool> &floaters, double overlap, double largest);

}  // namespace bondlab
