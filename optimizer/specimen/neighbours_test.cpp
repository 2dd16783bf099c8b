// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/neighbours.h"

#include <gtest/gtest.h>

#include "specimen/test_packings.h"

namespace bondlab {
namespace {

std::vector<std::pair<int, int>> as_pairs(const PairList &list) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i + 1 < list.start.size(); ++i)
    for (std::size_t k = list.start[i]; k < list.start[i + 1]; ++k)
      pairs.emplace_back(static_cast<int>(i), list.other[k]);
  return pairs;
}

void expect_as_by_brute_force(const std::vector<Particle> &particles, double gap) {
  std::vector<std::pair<int, int>> expected, expected_both;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t j = 0; j < particles.size(); ++j) {
      if (i == j || gap_between(particles[i], particles[j]) >= gap) continue;
      expected_both.emplace_back(i, j);
      if (i < j) expected.emplace_back(i, j);
    }
  const PairList found = find_pairs(particles, gap);
  EXPECT_GT(expected.size(), particles.size() / 2);
  EXPECT_EQ(as_pairs(found), expected);
  EXPECT_EQ(as_pairs(both_ways(found)), expected_both);
}

TEST(Neighbours, AllPairsOfDiscsWithinTheGap) {
  expect_as_by_brute_force(random_particles(400, 30, 20, 0, 0.5, 2.0, 1), 0.3);
}

TEST(Neighbours, AllPairsOfSpheresWithinTheGap) {
  expect_as_by_brute_force(random_particles(500, 12, 10, 14, 0.3, 1.5, 2), 0.2);
}

TEST(Neighbours, NegativeGapGivesOverlapsBeyondIt) {
  expect_as_by_brute_force(random_particles(400, 20, 20, 0, 0.5, 2.0, 3), -0.4);
}

TEST(Neighbours, ParticlesSmallerThanTheOverlapAskedForHaveNoPairs) {
  // Two small ones nearly in one place, beside large ones that do overlap by more than 1.
  const std::vector<Particle> particles = {
      {0, 0, 0, 0.2}, {0.1, 0, 0, 0.2}, {9, 0, 0, 2}, {11, 0, 0, 2}};
  EXPECT_EQ(as_pairs(find_pairs(particles, -1)), (std::vector<std::pair<int, int>>{{2, 3}}));
}

TEST(Neighbours, FarOffParticleCostsNoMemoryAndNoPairs) {
  std::vector<Particle> particles = random_particles(100, 8, 8, 8, 0.3, 0.9, 4);
  particles.push_back({1e9, -1e9, 1e9, 0.5});
  expect_as_by_brute_force(particles, 0.1);
}

TEST(Neighbours, NothingHasNoPairs) {
  EXPECT_EQ(find_pairs({}, 1).size(), 0u);
  EXPECT_EQ(find_pairs({{0, 0, 0, 1}}, 1).size(), 0u);
  EXPECT_EQ(find_pairs({{0, 0, 0, 1}, {0, 0, 0, 1}}, -3).size(), 0u);
}

TEST(Neighbours, ClustersAreNumberedByTheirFirstParticle) {
  // 0-3-4 and 1-5 hang together, 2 is alone.
  const std::vector<Particle> particles = {{0, 0, 0, 1},   {10, 0, 0, 1},  {20, 0, 0, 1},
                                           {1.9, 0, 0, 1}, {3.8, 0, 0, 1}, {11.9, 0, 0, 1}};
  const Clusters clusters = connected_clusters(find_pairs(particles, 0));
  EXPECT_EQ(clusters.count, 3);
  EXPECT_EQ(clusters.label, (std::vector<int>{0, 1, 2, 0, 0, 1}));
}

}  // namespace
}  // namespace bondlab
