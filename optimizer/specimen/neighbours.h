// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: all pairs of particles whose surfaces are nearer than a given gap.
// Method: one grid of cubic cells as large as the largest possible centre distance; each particle
//   looks at its own and the adjacent cells. Linear in the number of particles for size ratios up
//   to about 10, which is what check_request() allows.
// Units: any one length unit.
// Failure: none; particles must be finite. The list depends on the particles only.
#pragma once

#include <cstddef>
#include <vector>

#include "specimen/container.h"

namespace bondlab {

// Pairs in rows: the partners of i are other[start[i]] .. other[start[i + 1] - 1], in increasing
// order.
struct PairList {
  std::vector<std::size_t> start;
  std::vector<int> other;
  std::size_t size() const { return other.size(); }
};

// Each pair once, in the row of its smaller index. Pairs with distance - r_i - r_j < gap.
PairList find_pairs(const std::vector<Particle> &particles, double gap);

// The same pairs in the rows of both partners.
PairList both_ways(const PairList &pairs);

// Distance between the surfaces, negative when they overlap.
inline double gap_between(const Particle &a, const Particle &b) {
  const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz) - a.r - b.r;
}

// Labels of connected clusters, 0 .. count - 1 in the order of their smallest particle.
struct Clusters {
  std::vector<int> label;
  int count = 0;
};
Clusters connected_clusters(const PairList &pairs);

}  // namespace bondlab
