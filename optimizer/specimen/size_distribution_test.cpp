// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/size_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/user_error.h"

namespace bondlab {
namespace {

TEST(SizeDistribution, UniformQuantilesAndMoments) {
  const auto sizes = size_distribution("uniform", 2, 1.5);
  EXPECT_DOUBLE_EQ(sizes->smallest(), 2);
  EXPECT_DOUBLE_EQ(sizes->largest(), 3);
  EXPECT_DOUBLE_EQ(sizes->quantile(0.25), 2.25);
  for (int power = 1; power <= 3; ++power) {  // against the mid-point rule
    double sum = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) sum += std::pow(sizes->quantile((i + 0.5) / n), power) / n;
    EXPECT_NEAR(sizes->moment(power), sum, 1e-8) << power;
  }
  EXPECT_DOUBLE_EQ(size_distribution("uniform", 2, 1)->moment(3), 8);  // equal sizes
}

TEST(SizeDistribution, UnknownNameListsTheKnown) {
  try {
    size_distribution("gauss", 1, 2);
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(std::string(error.what()).find("allowed: uniform"), std::string::npos);
  }
}

TEST(SizeDistribution, DrawnRadiiFollowItInRandomOrder) {
  RandomStream random(7);
  const auto sizes = size_distribution("uniform", 1, 3);
  const std::size_t n = 1000;
  const std::vector<double> drawn = draw_radii(*sizes, n, random);
  std::vector<double> sorted = drawn;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < n; ++i) {  // one in each stratum
    EXPECT_GT(sorted[i], sizes->quantile(static_cast<double>(i) / n) - 1e-12);
    EXPECT_LT(sorted[i], sizes->quantile(static_cast<double>(i + 1) / n) + 1e-12);
  }
  double covariance = 0;  // of neighbours in the list: 0 +- sd^2 / sqrt(n) = 0.011 for a shuffled
                          // one, 0.33 for a sorted one
  for (std::size_t i = 1; i < n; ++i) covariance += (drawn[i] - 2) * (drawn[i - 1] - 2) / n;
  EXPECT_NEAR(covariance, 0, 0.04);
}

}  // namespace
}  // namespace bondlab
