// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/container.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "base/user_error.h"

namespace bondlab {
namespace {

constexpr double pi = 3.14159265358979323846;

struct Wall {
  double distance, nx, ny, nz;
};

std::map<int, Wall> walls_near(const Container &box, double x, double y, double z, double reach) {
  std::map<int, Wall> found;
  box.walls_within(x, y, z, reach, [&](double distance, double nx, double ny, double nz, int wall) {
    EXPECT_EQ(found.count(wall), 0u);
    found[wall] = {distance, nx, ny, nz};
  });
  return found;
}

TEST(Container, NamesAreReadBack) {
  for (const ContainerShape shape :
       {ContainerShape::rectangle, ContainerShape::disc, ContainerShape::cylinder,
        ContainerShape::prism, ContainerShape::sphere})
    EXPECT_EQ(shape_from_name(shape_name(shape)), shape);
  EXPECT_EQ(container_shape_names().size(), 5u);
  EXPECT_THROW(shape_from_name("cube"), UserError);
}

TEST(Container, MeasuresOfTheThreeShapes) {
  const Container rectangle(ContainerShape::rectangle, 2, 3, 0);
  EXPECT_DOUBLE_EQ(rectangle.measure(), 6);
  EXPECT_DOUBLE_EQ(rectangle.boundary(), 10);
  EXPECT_DOUBLE_EQ(rectangle.smallest_size(), 2);
  EXPECT_EQ(rectangle.dimension(), 2);
  const Container disc(ContainerShape::disc, 0, 0, 4);
  EXPECT_DOUBLE_EQ(disc.measure(), 4 * pi);
  EXPECT_DOUBLE_EQ(disc.boundary(), 4 * pi);
  EXPECT_EQ(disc.dimension(), 2);
  const Container cylinder(ContainerShape::cylinder, 0, 3, 4);
  EXPECT_DOUBLE_EQ(cylinder.measure(), 12 * pi);
  EXPECT_DOUBLE_EQ(cylinder.boundary(), 12 * pi + 8 * pi);
  EXPECT_DOUBLE_EQ(cylinder.smallest_size(), 3);
  EXPECT_EQ(cylinder.dimension(), 3);
}

std::vector<Container> all_kinds() {
  std::vector<Container> kinds;
  const Dimensions plain{2, 3, 4, 5}, notched{2, 3, 4, 5, 0.7, 0.4};
  for (const std::string &name : container_shape_names()) {
    const ContainerShape shape = shape_from_name(name);
    kinds.emplace_back(shape, plain);
    if (can_have_notch(shape)) kinds.emplace_back(shape, notched);
  }
  return kinds;
}

std::string label(const Container &box) {
  return shape_name(box.shape()) + (box.has_notch() ? " with a notch" : "");
}

// The share of points of its box that have a positive depth, on a grid.
TEST(Container, MeasureIsTheSpaceWithinItsWalls) {
  for (const Container &box : all_kinds()) {
    double lo[3], hi[3], space = 1;
    box.bounds(lo, hi);
    const int n[3] = {140, 140, box.dimension() == 3 ? 140 : 1};
    for (int k = 0; k < box.dimension(); ++k) space *= hi[k] - lo[k];
    long inside = 0;
    for (int i = 0; i < n[0]; ++i)
      for (int j = 0; j < n[1]; ++j)
        for (int k = 0; k < n[2]; ++k)
          inside += box.depth(lo[0] + (i + 0.5) / n[0] * (hi[0] - lo[0]),
                              lo[1] + (j + 0.5) / n[1] * (hi[1] - lo[1]),
                              lo[2] + (k + 0.5) / n[2] * (hi[2] - lo[2])) > 0;
    const double share = static_cast<double>(inside) / n[0] / n[1] / n[2];
    EXPECT_NEAR(share * space / box.measure(), 1, 0.004) << label(box);
  }
}

// A closed wall: the flux of the field x through it is dimension times the space within; here only
// that depth, walls and their normals tell the same tale at random places.
TEST(Container, DepthIsTheNearestWallAndNormalsPointUpItsSlope) {
  for (const Container &box : all_kinds()) {
    double lo[3], hi[3];
    box.bounds(lo, hi);
    std::uint64_t state = 1;
    const auto random = [&] {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      return static_cast<double>(state >> 11) / 9007199254740992.0;
    };
    for (int trial = 0; trial < 400; ++trial) {
      double at[3];
      for (int k = 0; k < 3; ++k) at[k] = lo[k] + random() * (hi[k] - lo[k]);
      double nearest = INFINITY;
      box.walls_within(at[0], at[1], at[2], INFINITY,
                       [&](double distance, double nx, double ny, double nz, int wall) {
                         nearest = std::min(nearest, distance);
                         EXPECT_NEAR(nx * nx + ny * ny + nz * nz, 1, 1e-12) << label(box);
                         // One step along the normal adds its length to the distance from that
                         // wall.
                         const double step = 1e-6;
                         box.walls_within(at[0] + step * nx, at[1] + step * ny, at[2] + step * nz,
                                          INFINITY,
                                          [&](double moved, double, double, double, int same) {
                                            if (same != wall) return;
                                            EXPECT_NEAR(moved - distance, step, 1e-9) << label(box);
                                          });
                       });
      EXPECT_NEAR(nearest, box.depth(at[0], at[1], at[2]), 1e-12) << label(box);
    }
  }
}

TEST(Container, NotchIsASlotInTheMiddleOfTheLongSide) {
  const Container beam(ContainerShape::rectangle, Dimensions{10, 2, 0, 0, 0.5, 0.2});
  EXPECT_DOUBLE_EQ(beam.depth(0.3, 0.25, 0), 0.2);    // beside it
  EXPECT_NEAR(beam.depth(0.05, 0.9, 0), 0.4, 1e-15);  // above it
  EXPECT_NEAR(beam.depth(0.4, 0.9, 0), 0.5, 1e-15);   // its corner: 0.3, 0.4
  EXPECT_LT(beam.depth(0.05, 0.3, 0), 0);             // in it
  const Container prism(ContainerShape::prism, Dimensions{1, 2, 0, 10, 0.5, 0.2});
  EXPECT_NEAR(prism.depth(0.1, -0.75, 5.3), 0.2, 1e-15);
  EXPECT_LT(prism.depth(0.4, -0.9, 5), 0);
  EXPECT_GT(prism.depth(0.4, 0.9, 5), 0);
  const Container bar(ContainerShape::cylinder, Dimensions{0, 10, 2, 0, 0.5, 0.2});
  EXPECT_LT(bar.depth(0, -0.7, 5), 0);
  EXPECT_GT(bar.depth(0, -0.7, 5.2), 0);
  EXPECT_GT(bar.depth(0, 0.7, 5), 0);
  // A disc and a sphere have none.
  EXPECT_FALSE(Container(ContainerShape::disc, Dimensions{0, 0, 2, 0, 0.5, 0.2}).has_notch());
}

TEST(Container, SmallestSizeCountsWhatTheNotchLeaves) {
  EXPECT_DOUBLE_EQ(
      Container(ContainerShape::rectangle, Dimensions{10, 2, 0, 0, 0.5, 0.2}).smallest_size(), 1.5);
  EXPECT_DOUBLE_EQ(
      Container(ContainerShape::prism, Dimensions{1, 2, 0, 10, 1.25, 0.2}).smallest_size(), 0.75);
  EXPECT_DOUBLE_EQ(
      Container(ContainerShape::cylinder, Dimensions{0, 2, 2, 0, 0.5, 1}).smallest_size(), 0.5);
}

TEST(Container, RectangleStandsOnYZeroAndIsCentredInX) {
  const Container box(ContainerShape::rectangle, 2, 3, 0);
  double lo[3], hi[3];
  box.bounds(lo, hi);
  EXPECT_EQ(lo[0], -1);
  EXPECT_EQ(hi[0], 1);
  EXPECT_EQ(lo[1], 0);
  EXPECT_EQ(hi[1], 3);
  const auto corner = walls_near(box, 0.75, 2.9, 0, 0.5);
  ASSERT_EQ(corner.size(), 2u);
  EXPECT_DOUBLE_EQ(corner.at(3).distance, 0.25);
  EXPECT_EQ(corner.at(3).nx, -1);
  EXPECT_NEAR(corner.at(1).distance, 0.1, 1e-15);
  EXPECT_EQ(corner.at(1).ny, -1);
  const auto other = walls_near(box, -0.9, 0.2, 0, 0.5);
  ASSERT_EQ(other.size(), 2u);
  EXPECT_EQ(other.at(0).ny, 1);
  EXPECT_EQ(other.at(2).nx, 1);
  EXPECT_TRUE(walls_near(box, 0, 1.5, 0, 0.5).empty());
}

TEST(Container, CylinderHasACurvedWallAndTwoEnds) {
  const Container box(ContainerShape::cylinder, 0, 3, 4);
  const auto near = walls_near(box, 1.2, 0.9, 0.1, 0.6);  // 1.5 from the axis
  ASSERT_EQ(near.size(), 2u);
  EXPECT_NEAR(near.at(4).distance, 0.5, 1e-15);
  EXPECT_NEAR(near.at(4).nx, -0.8, 1e-15);
  EXPECT_NEAR(near.at(4).ny, -0.6, 1e-15);
  EXPECT_EQ(near.at(0).nz, 1);
  EXPECT_EQ(walls_near(box, 0, 0, 2.9, 0.2).at(1).nz, -1);
  // A particle larger than the cylinder sees its wall wherever it is.
  EXPECT_EQ(walls_near(box, 0.1, 0, 1.5, 5).count(4), 1u);
}

TEST(Container, DepthIsTheDistanceToTheNearestWall) {
  const Container rectangle(ContainerShape::rectangle, 2, 3, 0);
  EXPECT_DOUBLE_EQ(rectangle.depth(0.5, 1.5, 0), 0.5);
  EXPECT_DOUBLE_EQ(rectangle.depth(0, 0.25, 0), 0.25);
  EXPECT_DOUBLE_EQ(rectangle.depth(0, 3.5, 0), -0.5);
  EXPECT_DOUBLE_EQ(rectangle.depth(-1.25, 1, 0), -0.25);
  const Container disc(ContainerShape::disc, 0, 0, 4);
  EXPECT_DOUBLE_EQ(disc.depth(-0.6, 0.8, 0), 1);
  const Container cylinder(ContainerShape::cylinder, 0, 3, 4);
  EXPECT_DOUBLE_EQ(cylinder.depth(0.6, 0.8, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(cylinder.depth(0.6, 0.8, 2.75), 0.25);
  EXPECT_DOUBLE_EQ(cylinder.depth(1.2, 1.6, 1.5), 0);
}

}  // namespace
}  // namespace bondlab
