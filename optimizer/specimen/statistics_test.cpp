// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/statistics.h"

#include <gtest/gtest.h>

#include "specimen/relax.h"

namespace bondlab {
namespace {

constexpr double pi = 3.14159265358979323846;

// Discs of radius r on a square lattice of spacing 2 that fills a rectangle of nx by ny cells.
std::vector<Particle> lattice(int nx, int ny, double r) {
  std::vector<Particle> discs;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) discs.push_back({2.0 * i + 1 - nx, 2.0 * j + 1, 0, r});
  return discs;
}

TEST(Statistics, SquareLatticeByHand) {
  const int nx = 6, ny = 12;
  const Container box(ContainerShape::rectangle, 2 * nx, 2 * ny, 0);
  const SpecimenStatistics s = measure_packing(box, lattice(nx, ny, 1));
  EXPECT_EQ(s.count, 72u);
  EXPECT_NEAR(s.r_mean, 1, 1e-12);
  EXPECT_NEAR(s.porosity, 1 - pi / 4, 1e-12);
  const double bonds = 5 * 12 + 6 * 11;
  for (const double coordination : s.coordination) EXPECT_NEAR(coordination, 2 * bonds / 72, 1e-12);
  EXPECT_EQ(s.fewest_bonds, 2);
  EXPECT_EQ(s.clusters, 1);
  EXPECT_EQ(s.floaters, 0);
  EXPECT_EQ(s.on_bottom, 6);
  EXPECT_EQ(s.on_top, 6);
  // Bonds whose middle is more than 2 from the walls: 3 x 10 along x, 4 x 9 along y.
  EXPECT_NEAR(s.fabric_ratio, 36.0 / 30, 1e-12);
}

TEST(Statistics, InnerPorosityLeavesOutTheWallLayer) {
  // The discs along the walls are smaller. One inner disc is the largest, so that the layer left
  // out is a whole cell; the other radii make the points incommensurate with the lattice.
  const Container box(ContainerShape::rectangle, 24, 32, 0);
  std::vector<Particle> discs = lattice(12, 16, 0.97);
  for (Particle &p : discs)
    if (box.depth(p.x, p.y, 0) < 1.5) p.r = 0.5;
  discs[12 * 8 + 6].r = 1;
  const SpecimenStatistics s = measure_packing(box, discs);
  EXPECT_NEAR(s.porosity_inner, 1 - pi * (139 * 0.97 * 0.97 + 1) / (20 * 28), 1e-3);
  EXPECT_GT(s.porosity, s.porosity_inner + 0.1);
}

TEST(Statistics, OverlapsAndStressOfACompressedLattice) {
  const int nx = 5, ny = 7;
  const Container box(ContainerShape::rectangle, 2 * nx, 2 * ny, 0);
  const SpecimenStatistics s = measure_packing(box, lattice(nx, ny, 1.01));
  EXPECT_NEAR(s.mean_overlap, 0.02 / 1.01, 1e-12);
  EXPECT_NEAR(s.max_overlap, 0.02 / 1.01, 1e-12);
  EXPECT_NEAR(s.stick_out, 0.01 / 1.01, 1e-12);
  // Force 2 E_c x 0.02 over a branch of 2; at a wall the stiffness is higher and the branch 1.
  const double pair = 2 * 0.02 * 2, wall = wall_contact_stiffness * 2 * 0.01 * 1,
               area = 4 * nx * ny;
  const double xx = (4 * 7 * pair + 2 * 7 * wall) / area, yy = (5 * 6 * pair + 2 * 5 * wall) / area;
  EXPECT_NEAR(s.stress_over_modulus, 0.5 * (xx + yy), 1e-12);
  EXPECT_NEAR(s.stress_ratio, std::max(xx, yy) / std::min(xx, yy), 1e-10);
}

TEST(Statistics, ShearedStressHasItsPrincipalValues) {
  // One contact along 45 degrees and one along 135, twice as deep: principal stresses 1 to 2, which
  // the components along x and y don't show.
  const Container box(ContainerShape::rectangle, 100, 100, 0);
  const double a = 0.99 / std::sqrt(2.0), b = 0.98 / std::sqrt(2.0);
  const SpecimenStatistics s = measure_packing(
      box, {{-a, 50 - a, 0, 1}, {a, 50 + a, 0, 1}, {20 - b, 50 + b, 0, 1}, {20 + b, 50 - b, 0, 1}});
  EXPECT_NEAR(s.stress_ratio, 0.04 * 1.96 / (0.02 * 1.98), 1e-9);
  EXPECT_NEAR(s.fabric_ratio, 1, 1e-12);
}

TEST(Statistics, CoordinationGrowsWithTheGap) {
  const Container box(ContainerShape::rectangle, 40, 40, 0);
  std::vector<Particle> discs;  // pairs with gaps of 5e-4, 5e-3, 2e-2, 7e-2, 0.12 and 0.3 radii
  double y = 3;
  for (const double gap : {5e-4, 5e-3, 2e-2, 7e-2, 0.12, 0.3}) {
    discs.push_back({0, y, 0, 1});
    discs.push_back({2 + gap, y, 0, 1});
    y += 6;
  }
  const SpecimenStatistics s = measure_packing(box, discs);
  const double bond = 2.0 / 12;
  const double expected[] = {0, bond, 2 * bond, 3 * bond, 4 * bond, 5 * bond};
  for (std::size_t g = 0; g < coordination_gaps.size(); ++g)
    EXPECT_NEAR(s.coordination[g], expected[g], 1e-12) << g;
  EXPECT_EQ(s.fewest_bonds, 0);
  EXPECT_EQ(s.clusters, 12 - 3);
  EXPECT_EQ(s.floaters, 12);
}

TEST(Statistics, SphereInACylinder) {
  // The part more than 2 x 5 from the walls of a cylinder of diameter 60 and height 60 is one of
  // 40 x 40. One sphere is counted at 500 points only, hence the mean over places on the grid.
  const Container box(ContainerShape::cylinder, 0, 60, 60);
  const double sphere = 4 * pi / 3 * 125;
  double inner = 0;
  const int n = 8;
  for (int i = 0; i < n; ++i) {
    const SpecimenStatistics s = measure_packing(box, {{0.618 * i, 0.414 * i, 30 + 0.732 * i, 5}});
    EXPECT_NEAR(s.porosity, 1 - sphere / (pi * 900 * 60), 1e-12);
    inner += (1 - s.porosity_inner) / n;
  }
  EXPECT_NEAR(inner, sphere / (pi * 400 * 40), 0.01 * sphere / (pi * 400 * 40));
}

TEST(Statistics, StressOfSpheresUsesTheirMeanRadius) {
  const Container box(ContainerShape::cylinder, 0, 60, 60);
  const SpecimenStatistics s = measure_packing(box, {{0, 0, 20, 2}, {0, 0, 24.9, 3}});
  EXPECT_NEAR(s.stress_over_modulus, 4 * 2.5 * 0.1 * 4.9 / (3 * box.measure()), 1e-15);
  EXPECT_EQ(s.stress_ratio, 0);  // one contact carries nothing sideways
  EXPECT_NEAR(s.max_overlap, 0.05, 1e-12);
}

TEST(Statistics, PrincipalStressesInSpaceWhateverTheAxes) {
  // Three separate contacts along the columns of a rotation, overlaps 1 : 2 : 4.
  const Container box(ContainerShape::cylinder, 0, 100, 100);
  const double axes[3][3] = {
      {2.0 / 3, -1.0 / 3, 2.0 / 3}, {2.0 / 3, 2.0 / 3, -1.0 / 3}, {-1.0 / 3, 2.0 / 3, 2.0 / 3}};
  std::vector<Particle> spheres;
  for (int k = 0; k < 3; ++k) {
    const double d = 1 - 0.005 * (1 << k), x = 15.0 * (k - 1);
    for (const double side : {-d, d})
      spheres.push_back({x + side * axes[k][0], side * axes[k][1], 50 + side * axes[k][2], 1});
  }
  const SpecimenStatistics s = measure_packing(box, spheres);
  EXPECT_NEAR(s.stress_ratio, 0.04 * 1.96 / (0.01 * 1.99), 1e-9);
  EXPECT_NEAR(s.fabric_ratio, 1, 1e-9);
}

TEST(Statistics, EndsAreToldApart) {
  const Container box(ContainerShape::rectangle, 10, 10, 0);
  const SpecimenStatistics s = measure_packing(box, {{0, 1, 0, 1}, {2, 1, 0, 1}, {0, 9, 0, 1}});
  EXPECT_EQ(s.on_bottom, 2);
  EXPECT_EQ(s.on_top, 1);
}

TEST(Statistics, NothingHasNoFigures) {
  EXPECT_EQ(measure_packing(Container(ContainerShape::disc, 0, 0, 1), {}).count, 0u);
}

}  // namespace
}  // namespace bondlab
