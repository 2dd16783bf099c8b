// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the order of particles along a space-filling curve, so that neighbours in space are near
//   in memory and in id.
// Method: z-order (Morton) curve of coordinates cut to 20 bits of the largest extent; equal codes
//   in the given order.
// Units: any one length unit.
// Failure: none.
#pragma once

#include <cstddef>
#include <vector>

#include "specimen/container.h"

namespace bondlab {

// order[k] is the particle that comes k-th.
std::vector<std::size_t> space_filling_order(const std::vector<Particle> &particles);

}  // namespace bondlab
