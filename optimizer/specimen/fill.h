// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: fill a container with discs or spheres that touch and don't overlap: the other way to make a
//   packing, by geometry alone.
// Method: after the idea of GenGeo (insertion of spheres tangent to their neighbours; Place & Mora,
//   Pure Appl. Geophys. 157, 2000, 1821-1845). From the points of a fine grid in random order:
//   first spheres of drawn radii are put where they touch as many surfaces (walls or others) as the
//   space has dimensions, growing inwards from the walls; then every hole that is left and not
//   smaller than the smallest radius gets the sphere that touches one surface more. Both are one
//   small system of equations in the place (and the radius), solved by Newton's rule; the surfaces
//   are chosen anew while others are nearer.
// Why: no overlap and no locked-in stress at all, every size that the holes have, and no
//   equilibrium to wait for. But it is looser than radius expansion, and the small radii of the
//   second part are those of the holes, not the distribution's.
// Units: any one length unit (make_specimen() gives mean radii).
// Failure: none; a container too small for one particle stays empty.
// Limits: one thread; the same result on every machine.
#pragma once

#include <vector>

#include "base/random.h"
#include "specimen/container.h"
#include "specimen/size_distribution.h"

namespace bondlab {

std::vector<Particle> fill_container(const Container &container, const SizeDistribution &sizes,
                                     RandomStream &random);

}  // namespace bondlab
