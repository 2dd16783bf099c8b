// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/container.h"

#include <gtest/gtest.h>

#include <map>

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
       {ContainerShape::rectangle, ContainerShape::disc, ContainerShape::cylinder})
    EXPECT_EQ(shape_from_name(shape_name(shape)), shape);
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
