// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/sizing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bondlab::diagnose {
namespace {

class SizeSearch : public ::testing::Test {
 protected:
  template <class Units>
  Sized search(Units units, double first, double largest = 1e9) {
    return search_size(
        [&](double size) {
          tried.push_back(size);
          return units(size);
        },
        first, 20, largest);
  }
  std::vector<double> tried;
};

TEST_F(SizeSearch, OneRunWhereTheFirstSizeIsRight) {
  const auto found = search([](double size) { return 10 * size; }, 1.8);
  EXPECT_EQ(tried.size(), 1u);
  EXPECT_EQ(found.size, 1.8);
  EXPECT_EQ(found.units, 18);
}

TEST_F(SizeSearch, FollowsAPowerLaw) {
  const auto found = search([](double size) { return 5 * size * size; }, 0.7);
  EXPECT_NEAR(found.units, 20, 5);
  EXPECT_LE(tried.size(), 4u);
}

// Bonds that yield at a stress which they never see: nothing below a size, much above it.
TEST_F(SizeSearch, GoesPastAThreshold) {
  const auto found = search([](double size) { return size < 2 ? 0.1 : 15 + 4 * (size - 2); }, 0.8);
  EXPECT_NEAR(found.units, 20, 5);
  EXPECT_GE(found.size, 2);
}

TEST_F(SizeSearch, ComesDownFromASizeThatIsFarTooLarge) {
  const auto found = search([](double size) { return 40 * size; }, 5);
  EXPECT_NEAR(found.units, 20, 5);
}

TEST_F(SizeSearch, LargestSizeThereIsWithTheUnitsThatItHas) {
  const auto found = search([](double size) { return 3 * size; }, 1, 2.5);
  EXPECT_EQ(found.size, 2.5);
  EXPECT_EQ(found.units, 7.5);
}

TEST_F(SizeSearch, NearestOfFourWhereNoneIsRight) {
  const auto found = search([](double size) { return size < 3 ? 2.0 : 60.0; }, 1);
  EXPECT_EQ(tried.size(), 4u);
  EXPECT_EQ(found.units, 2);  // 18 off, and 60 is 40 off
}

}  // namespace
}  // namespace bondlab::diagnose
