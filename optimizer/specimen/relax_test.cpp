// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/relax.h"

#include <gtest/gtest.h>

#include "specimen/test_packings.h"

namespace bondlab {
namespace {

TEST(Relaxation, TwoDiscsBetweenWallsShareTheOverlapByStiffness) {
  // A column of two discs of radius 1 in a slot of height 3.9: walls are stiffer by a factor w, so
  // wall overlap a and middle overlap b obey 2 a + b = 0.1 and w a = b.
  const Container slot(ContainerShape::rectangle, 10, 3.9, 0);
  std::vector<Particle> discs = {{0, 1.2, 0, 1}, {0, 2.9, 0, 1}};
  Relaxation relaxation(slot, discs);
  const Equilibrium found = relaxation.relax(1e-9, 0, 10000);
  EXPECT_LE(found.residual, 1e-9);
  EXPECT_EQ(found.contacts, 1u);
  const double wall = 0.1 / (2 + wall_contact_stiffness);
  EXPECT_NEAR(1 - discs[0].y, wall, 1e-9);
  EXPECT_NEAR(gap_between(discs[0], discs[1]), -wall * wall_contact_stiffness, 1e-9);
  EXPECT_NEAR(found.overlap, wall * wall_contact_stiffness / 4, 1e-9);
  EXPECT_EQ(discs[0].x, 0);
}

TEST(Relaxation, SpheresOfUnequalSizeHaveStiffnessOfTheirMeanRadius) {
  // Three in a column: k = (R1 + R2) / (2 r_max); the two contacts carry one force.
  const Container box(ContainerShape::cylinder, 0, 5.9, 20);
  std::vector<Particle> spheres = {{0, 0, 1, 1}, {0, 0, 2.4, 0.5}, {0, 0, 4.4, 1.5}};
  Relaxation relaxation(box, spheres);
  relaxation.relax(1e-10, 0, 100000);
  const double first = -gap_between(spheres[0], spheres[1]),
               second = -gap_between(spheres[1], spheres[2]);
  EXPECT_NEAR(first * 1.5, second * 2.0, 1e-9);
  EXPECT_NEAR(wall_contact_stiffness * 2.0 * (1 - spheres[0].z), first * 1.5, 1e-9);
  EXPECT_GT(first, 0.01);
}

TEST(Relaxation, LoosePackingStopsWithoutOverlap) {
  const Container box(ContainerShape::rectangle, 30, 30, 0);
  std::vector<Particle> discs = random_particles(60, 14, 30, 0, 1, 1.5, 5);
  Relaxation relaxation(box, discs);
  const Equilibrium found = relaxation.relax(1e-6, 1e-9, 20000);
  EXPECT_LT(found.overlap, 1e-9);
}

TEST(Relaxation, GivesUpBelowTheLooseOverlap) {
  // A packing that is falling apart is left before it has: overlaps of 0.05 mean radii are loose.
  const Container box(ContainerShape::rectangle, 30, 30, 0);
  std::vector<Particle> discs = random_particles(60, 14, 30, 0, 1, 1.5, 5);
  Relaxation relaxation(box, discs);
  const Equilibrium found = relaxation.relax(1e-6, 0.05, 20000);
  EXPECT_LT(found.overlap, 0.05);
  EXPECT_GT(found.overlap, 0.005);
}

TEST(Relaxation, DensePackingOfDiscsBalancesOnEveryDisc) {
  const Container box(ContainerShape::disc, 0, 0, 20);
  std::vector<Particle> discs = random_particles(90, 12, 12, 0, 0.8, 1.2, 6);
  for (Particle &p : discs) {
    p.x -= 6;
    p.y -= 6;
  }
  Relaxation relaxation(box, discs);
  const Equilibrium found = relaxation.relax(1e-8, 0, 100000);
  ASSERT_LE(found.residual, 1e-8);
  ASSERT_GT(found.overlap, 1e-3);
  double worst = 0;  // by brute force
  for (const Particle &a : discs) {
    double fx = 0, fy = 0;
    for (const Particle &b : discs) {
      const double gap = gap_between(a, b);
      if (&a == &b || gap >= 0) continue;
      const double d = gap + a.r + b.r;
      fx += gap * (b.x - a.x) / d;
      fy += gap * (b.y - a.y) / d;
    }
    const double rho = std::hypot(a.x, a.y), out = rho + a.r - 10;
    if (out > 0) {
      fx -= wall_contact_stiffness * out * a.x / rho;
      fy -= wall_contact_stiffness * out * a.y / rho;
    }
    worst = std::max(worst, std::hypot(fx, fy));
  }
  EXPECT_LT(worst, 1e-8);
}

TEST(Relaxation, SeesRadiiAndPlacesChangedBetweenCalls) {
  const Container slot(ContainerShape::rectangle, 10, 10, 0);
  std::vector<Particle> discs = {{-2, 5, 0, 1}, {2, 5, 0, 1}};
  Relaxation relaxation(slot, discs);
  EXPECT_EQ(relaxation.relax(1e-9, 0, 100).contacts, 0u);
  for (Particle &p : discs) p.r = 2.3;  // far beyond the list's reach
  relaxation.relax(1e-6, 1e-12, 10000);
  EXPECT_GT(discs[1].x - discs[0].x, 4.59);
  discs[0] = {discs[1].x - 1, 5, 0, 2.3};
  relaxation.relax(1e-6, 1e-12, 10000);
  EXPECT_GT(gap_between(discs[0], discs[1]), -1e-6);
}

TEST(Relaxation, StopsAfterTheStepsGiven) {
  const Container box(ContainerShape::rectangle, 10, 10, 0);
  std::vector<Particle> discs = random_particles(40, 4, 4, 0, 1, 1.2, 8);
  Relaxation relaxation(box, discs);
  const Equilibrium found = relaxation.relax(1e-12, 0, 7);
  EXPECT_EQ(found.steps, 7);
  EXPECT_GT(found.residual, 1e-12);
}

}  // namespace
}  // namespace bondlab
