// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/floaters.h"

#include <gtest/gtest.h>

#include "specimen/neighbours.h"

namespace bondlab {
namespace {

const Container wide(ContainerShape::rectangle, 100, 100, 0);

TEST(Floaters, LargestHoleBetweenThreeEqualDiscs) {
  // Unit discs that touch: the hole is Soddy's circle, radius 2 / sqrt(3) - 1, at the centroid.
  const double h = std::sqrt(3.0);
  std::vector<Particle> discs = {
      {-1, 50, 0, 1}, {1, 50, 0, 1}, {0, 50 + h, 0, 1}, {0.03, 50.5, 0, 0.05}};
  const double hole = climb_to_largest_hole(wide, discs, {0, 1, 2}, discs[3]);
  EXPECT_NEAR(hole, 2 / h - 1, 1e-12);
  EXPECT_NEAR(discs[3].x, 0, 1e-9);
  EXPECT_NEAR(discs[3].y, 50 + h / 3, 1e-9);
}

TEST(Floaters, LargestHoleBetweenUnequalDiscsFollowsDescartes) {
  // Three discs touching each other, radii 1, 2, 3: centres (0,0), (3,0), (0,4); the inner circle
  // has curvature k1 + k2 + k3 + 2 sqrt(k1 k2 + k2 k3 + k3 k1) = 23 / 6.
  std::vector<Particle> discs = {{0, 50, 0, 1}, {3, 50, 0, 2}, {0, 54, 0, 3}, {0.9, 50.9, 0, 0.1}};
  EXPECT_NEAR(climb_to_largest_hole(wide, discs, {0, 1, 2}, discs[3]), 6.0 / 23, 1e-12);
}

TEST(Floaters, LargestHoleBetweenAWallAndTwoDiscs) {
  // Unit discs on the floor that touch: (1 + r)^2 = 1 + (1 - r)^2 gives r = 1 / 4.
  std::vector<Particle> discs = {{-1, 1, 0, 1}, {1, 1, 0, 1}, {0.02, 0.15, 0, 0.1}};
  EXPECT_NEAR(climb_to_largest_hole(wide, discs, {0, 1}, discs[2]), 0.25, 1e-12);
}

TEST(Floaters, LargestHoleBetweenFourSpheres) {
  // Unit spheres on a tetrahedron of side 2: sqrt(6) / 2 - 1.
  const Container box(ContainerShape::cylinder, 0, 100, 100);
  const double a = 1 / std::sqrt(2.0);
  std::vector<Particle> spheres = {{1, 0, 50 - a, 1},
                                   {-1, 0, 50 - a, 1},
                                   {0, 1, 50 + a, 1},
                                   {0, -1, 50 + a, 1},
                                   {0.02, -0.05, 50.03, 0.1}};
  const double hole = climb_to_largest_hole(box, spheres, {0, 1, 2, 3}, spheres[4]);
  EXPECT_NEAR(hole, std::sqrt(6.0) / 2 - 1, 1e-12);
  EXPECT_NEAR(spheres[4].x, 0, 1e-9);
  EXPECT_NEAR(spheres[4].z, 50, 1e-9);
}

TEST(Floaters, HoleBesideACurvedWallTouchesTheWall) {
  const Container box(ContainerShape::disc, 0, 0, 20);
  // Two unit discs touching each other and the wall of radius 10, and a floater near the wall
  // between them.
  const double y = std::sqrt(81.0 - 1);
  std::vector<Particle> discs = {{-1, y, 0, 1}, {1, y, 0, 1}, {0.01, 9.7, 0, 0.05}};
  const double hole = climb_to_largest_hole(box, discs, {0, 1}, discs[2]);
  EXPECT_NEAR(10 - std::hypot(discs[2].x, discs[2].y), hole, 1e-10);
  EXPECT_NEAR(gap_between(discs[2], discs[0]) + discs[2].r, hole, 1e-9);
  EXPECT_NEAR(gap_between(discs[2], discs[1]) + discs[2].r, hole, 1e-9);
}

TEST(Floaters, HaveTooFewSurfacesWithinTheGap) {
  const Container box(ContainerShape::rectangle, 4, 4, 0);
  // Four unit discs fill the square: two walls and two neighbours each. One in the middle touches
  // none: it is 0.21 from each of the four.
  const std::vector<Particle> discs = {
      {-1, 1, 0, 1}, {1, 1, 0, 1}, {-1, 3, 0, 1}, {1, 3, 0, 1}, {0, 2, 0, 0.2}};
  EXPECT_EQ(find_floaters(box, discs, 1e-9), (std::vector<bool>{false, false, false, false, true}));
  EXPECT_EQ(find_floaters(box, discs, 0.22), std::vector<bool>(5, false));
  EXPECT_EQ(find_floaters(box, discs, -1e-9), std::vector<bool>(5, true));
}

TEST(Floaters, NeedFourContactsIn3D) {
  // A sphere resting on floor, curved wall and one other has three contacts: enough for a disc.
  const Container box(ContainerShape::cylinder, 0, 20, 20);
  const std::vector<Particle> spheres = {{9, 0, 1, 1}, {7, 0, 1, 1}};
  EXPECT_EQ(find_floaters(box, spheres, 1e-9), std::vector<bool>(2, true));
}

TEST(Floaters, CarryNoLoad) {
  const Container slot(ContainerShape::rectangle, 6, 30, 0);
  // A chain from wall to wall is loaded, with two contacts a disc; one lies below, barely touching.
  const std::vector<Particle> discs = {
      {-2, 15, 0, 1.001}, {0, 15, 0, 1.001}, {2, 15, 0, 1.001}, {0, 13, 0, 0.99901}};
  EXPECT_EQ(find_unloaded(slot, discs, 1e-4), (std::vector<bool>{false, false, false, true}));
  EXPECT_EQ(find_unloaded(slot, discs, 1e-6), std::vector<bool>(4, false));
  EXPECT_EQ(find_unloaded(slot, discs, 0.01), std::vector<bool>(4, true));
  // Held by walls alone.
  EXPECT_EQ(find_unloaded(Container(ContainerShape::rectangle, 2, 3, 0), {{0, 1.5, 0, 1.01}}, 1e-3),
            std::vector<bool>(1, false));
}

TEST(Floaters, AreSeatedWithTheOverlapAndNotBeyondTheLargest) {
  const double h = std::sqrt(3.0);
  const std::vector<Particle> discs = {
      {-1, 50, 0, 1}, {1, 50, 0, 1}, {0, 50 + h, 0, 1}, {0.03, 50.5, 0, 0.05}};
  const std::vector<bool> floats = {false, false, false, true};
  std::vector<Particle> seated = discs;
  EXPECT_EQ(seat_floaters(wide, seated, floats, 1e-3, 1), 1);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(gap_between(seated[3], seated[k]), -1e-3, 1e-12);
    EXPECT_EQ(seated[k].x, discs[k].x);
    EXPECT_EQ(seated[k].r, 1);
  }
  seated = discs;
  seat_floaters(wide, seated, floats, 1e-3, 0.1);
  EXPECT_EQ(seated[3].r, 0.1);
}

}  // namespace
}  // namespace bondlab
