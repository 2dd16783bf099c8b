// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: find the particles that carry nothing in a packing (floaters) and make each fill the hole
//   it sits in.
// Method: a floater has fewer contacts than a particle needs to be held without friction, 3 in 2D
//   and 4 in 3D, walls and only particles that aren't floaters themselves counted. Potyondy &
//   Cundall 2004 (Int. J. Rock Mech. Min. Sci. 41, appendix) grow floaters until they touch. Here
//   the place and the size are found at once: the distance to the nearest surface, min_j (|x -
//   x_j| - r_j), is climbed by sequential linear programmes. Each term is convex, so a linearised
//   step never promises more than it gives, and every maximum touches dimension + 1 surfaces at
//   once: exactly a held particle.
// Units: any one length unit.
// Failure: none; what stays a floater is counted by the caller.
// Limits: inside a curved wall the distance is concave, and a maximum there may touch fewer
//   surfaces.
#pragma once

#include <vector>

#include "specimen/container.h"

namespace bondlab {

// true for floaters. Contacts are overlaps larger than `touch`.
std::vector<bool> find_floaters(const Container &container, const std::vector<Particle> &particles,
                                double touch);

// Moves particle i to the nearest local maximum of its distance to the others and the walls, and
// returns that distance. obstacles: indices of the particles around it.
double climb_to_largest_hole(const Container &container, const std::vector<Particle> &particles,
                             const std::vector<int> &obstacles, Particle &floater);

// Seats every floater and gives it the radius of its hole plus `overlap`, at most `largest`.
// Returns how many there were.
int seat_floaters(const Container &container, std::vector<Particle> &particles,
                  const std::vector<bool> &floaters, double overlap, double largest);

}  // namespace bondlab
