// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/small_system.h"

#include <gtest/gtest.h>

namespace bondlab {
namespace {

TEST(SmallSystem, IsSolvedAlsoWhereAPivotIsZeroAtFirst) {
  // x = 1, y = 2, z = -3
  double a[4][5] = {{0, 1, 1, -1}, {2, 0, 1, -1}, {1, 1, 0, 3}};
  ASSERT_TRUE(solve_small(a, 3, 1e-9));
  EXPECT_NEAR(a[0][3], 1, 1e-14);
  EXPECT_NEAR(a[1][3], 2, 1e-14);
  EXPECT_NEAR(a[2][3], -3, 1e-14);
}

TEST(SmallSystem, NearlyParallelRowsAreSingularFromTheGivenPivotOn) {
  const double tilt = 1e-7;
  double a[4][5] = {{1, 1, 2}, {1, 1 + tilt, 2 + tilt}};
  double b[4][5] = {{1, 1, 2}, {1, 1 + tilt, 2 + tilt}};
  EXPECT_FALSE(solve_small(a, 2, 1e-6));
  ASSERT_TRUE(solve_small(b, 2, 1e-9));
  EXPECT_NEAR(b[1][2], 1, 1e-8);
}

}  // namespace
}  // namespace bondlab
