// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: pack discs or spheres into a container the way GenGeo does, giving up while there still are
//   holes: for comparison with papers whose packings were made by it.
// Method: that of GenGeo 1.4's InsertGenerator (of the ESyS-Particle project; after Place & Mora,
//   Pure Appl. Geophys. 157, 2000, 1821-1845), as it was found to work; the code is our own.
//   1. Seeds: on a triangular (2D) or close-packed (3D) lattice of spacing 2 r_max, each moved by
//   at
//      most r_max - r along each axis, with radii r of the smaller half of the distribution; less
//      of both near the ends of the container's box. Seeds that stick out or overlap are left out.
//   2. Insertion: a random point; its dimension + 1 nearest surfaces, of particles and walls alike,
//      also if it lies within a particle; the particle that touches all of these (Newton's rule for
//      its place and radius). It stays if its radius is within the distribution's bounds and it
//      neither overlaps another nor sticks out.
//   3. The end: `tries` failures one after the other.
//   The random points are even in a rectangle or prism. In a disc, cylinder or sphere they are even
//   in the distance from the axis (or middle) and not in the area, as GenGeo's are: it tries less
//   often near the round wall and leaves more holes there.
// Why beside fill.h: fill.h leaves no hole; papers whose packings GenGeo made have some.
// Differences: Newton's rule where GenGeo minimises by a simplex with a tolerance; touching to
//   rounding; directions in a sphere are even (GenGeo's crowd at its poles).
// Units: any one length unit (make_specimen() gives mean radii).
// Failure: none here; the caller judges whether the particles hang together.
// Limits: the radii of step 2 are those of the holes, whatever the distribution between its bounds.
//   The same `tries` leave more holes in a larger container. One thread; the same result on every
//   machine; with more tries the same particles and then more.
#pragma once

#include <vector>

#include "base/random.h"
#include "specimen/container.h"
#include "specimen/size_distribution.h"

namespace bondlab {

constexpr long default_tries = 1000, most_tries = 1000000;  // specimen.md has their effect

struct InsertedParticles {
  std::vector<Particle> particles;
  std::size_t seeds = 0;  // the first ones; all others touch dimension + 1 surfaces
};

InsertedParticles insert_particles(const Container &container, const SizeDistribution &sizes,
                                   long tries, RandomStream &random);

}  // namespace bondlab
