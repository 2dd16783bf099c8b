// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/space_filling.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "specimen/test_packings.h"

namespace bondlab {
namespace {

TEST(SpaceFilling, FollowsTheZOrderOfACube) {
  std::vector<Particle> corners;
  for (const int k : {5, 3, 0, 7, 1, 6, 2, 4})
    corners.push_back({k & 1 ? 3.0 : 1.0, k & 2 ? 3.0 : 1.0, k & 4 ? 3.0 : 1.0, 1});
  const std::vector<std::size_t> order = space_filling_order(corners);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(corners[order[k]].x, k & 1 ? 3 : 1);
    EXPECT_EQ(corners[order[k]].y, k & 2 ? 3 : 1);
    EXPECT_EQ(corners[order[k]].z, k & 4 ? 3 : 1);
  }
}

TEST(SpaceFilling, IsAPermutationThatKeepsNeighboursNear) {
  const std::vector<Particle> particles = random_particles(2000, 50, 100, 0, 1, 1, 9);
  const std::vector<std::size_t> order = space_filling_order(particles);
  std::vector<std::size_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  double hop = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    ASSERT_EQ(sorted[k], k);
    if (k > 0)
      hop += std::hypot(particles[order[k]].x - particles[order[k - 1]].x,
                        particles[order[k]].y - particles[order[k - 1]].y) /
             2000;
  }
  // The mean spacing is sqrt(5000 / 2000) = 1.6; random order hops 40 on average.
  EXPECT_LT(hop, 4);
}

TEST(SpaceFilling, EqualPlacesKeepTheirOrder) {
  EXPECT_EQ(space_filling_order({{1, 1, 1, 1}, {1, 1, 1, 2}, {1, 1, 1, 3}}),
            (std::vector<std::size_t>{0, 1, 2}));
}

}  // namespace
}  // namespace bondlab
