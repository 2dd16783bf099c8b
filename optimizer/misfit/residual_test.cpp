// SPDX-License-Identifier: GPL-2.0-or-later
#include "misfit/residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bondlab {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Target strength() {
  Target target;
  target.name = "UCS";
  target.test = "ucs";
  target.response = "peak";
  target.value = 138.8e6;
  target.sd = 0.05 * 138.8e6;
  return target;
}

TEST(Residual, CountsInStandardDeviationsAndKnowsWhereItComesFrom) {
  const auto row = residual(strength(), {138.8e6 * 1.10, ""}, strength().sd, 2);
  EXPECT_NEAR(row.value, 2.0, 1e-12);
  EXPECT_EQ(row.target, "UCS");
  EXPECT_EQ(row.test, "ucs");
  EXPECT_EQ(row.response, "peak");
  EXPECT_EQ(row.packing, 2);
}

TEST(Residual, IndependentScattersJoinAsSquares) {
  EXPECT_DOUBLE_EQ(combined_sd(3, 4), 5);
  EXPECT_DOUBLE_EQ(combined_sd(3, nan), 3);
}

TEST(Residual, SimulationScatterIsTheLargerOfNoiseAndPackings) {
  EXPECT_EQ(simulation_sd(2, 5), 5);
  EXPECT_EQ(simulation_sd(7, 5), 7);
  EXPECT_EQ(simulation_sd(nan, 5), 5);
  EXPECT_EQ(simulation_sd(2, nan), 2);
  EXPECT_EQ(simulation_sd(nan, nan), 0);
}

TEST(Residual, MissingFigureSpoilsTheSumAndIsNeverZero) {
  const auto missing = residual(strength(), {nan, "the run failed"}, strength().sd);
  EXPECT_TRUE(std::isnan(missing.value));
  EXPECT_EQ(missing.why, "the run failed");
  const auto good = residual(strength(), {138.8e6, ""}, strength().sd);
  EXPECT_EQ(sum_of_squares({good, good}), 0);
  EXPECT_TRUE(std::isnan(sum_of_squares({good, missing})));
}

}  // namespace
}  // namespace bondlab
