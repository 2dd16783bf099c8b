// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bondlab {
namespace {

// Reference values computed with an independent implementation (the generators' published
// recurrences in Python integers).
TEST(RandomStream, GivesThePublishedSequence) {
  EXPECT_EQ(mix64(0), 0xe220a8397b1dcdafULL);  // first output of splitmix64 seeded with 0
  RandomStream random(1, 2);
  EXPECT_EQ(random.bits(), 0xdd032a2da9369f62ULL);
  EXPECT_EQ(random.bits(), 0xd9f003c4bc6cc3fcULL);
  EXPECT_EQ(random.bits(), 0xf3e12faec9c8aa37ULL);
}

TEST(RandomStream, StreamsOfOneSeedAndSeedsOfOneStreamDiffer) {
  EXPECT_NE(RandomStream(1, 0).bits(), RandomStream(1, 1).bits());
  EXPECT_NE(RandomStream(1, 0).bits(), RandomStream(2, 0).bits());
  EXPECT_NE(RandomStream(1, 2).bits(), RandomStream(2, 1).bits());
}

TEST(RandomStream, UniformAndNormalHaveTheirMoments) {
  RandomStream random(7);
  const int n = 200000;
  double sum = 0, square = 0, normal_sum = 0, normal_square = 0, fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(), g = random.normal();
    ASSERT_GT(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    square += u * u;
    normal_sum += g;
    normal_square += g * g;
    fourth += g * g * g * g;
  }
  const double five =
      5 / std::sqrt(static_cast<double>(n));  // five standard errors, times each quantity's own sd
  EXPECT_NEAR(sum / n, 0.5, five * 0.289);
  EXPECT_NEAR(square / n, 1.0 / 3, five * 0.298);
  EXPECT_NEAR(normal_sum / n, 0, five);
  EXPECT_NEAR(normal_square / n, 1, five * std::sqrt(2.0));
  EXPECT_NEAR(fourth / n, 3, five * std::sqrt(96.0));
}

TEST(RandomStream, IndexIsUniformOverItsRange) {
  RandomStream random(3);
  int counts[7] = {};
  const int n = 70000;
  for (int i = 0; i < n; ++i) ++counts[random.index(7)];
  double chi2 = 0;
  for (const int count : counts) chi2 += (count - n / 7.0) * (count - n / 7.0) / (n / 7.0);
  EXPECT_LT(chi2, 22.5);  // 99.9 % quantile of chi-square with 6 degrees of freedom
}

TEST(RandomStream, ShuffleIsAPermutation) {
  RandomStream random(11);
  std::vector<int> items(50), sorted(50);
  std::iota(items.begin(), items.end(), 0);
  std::iota(sorted.begin(), sorted.end(), 0);
  random.shuffle(items);
  EXPECT_NE(items, sorted);
  std::sort(items.begin(), items.end());
  EXPECT_EQ(items, sorted);
}

TEST(HashInts, DependsOnOrderAndNumber) {
  EXPECT_NE(hash_ints({1, 2}), hash_ints({2, 1}));
  EXPECT_NE(hash_ints({1}), hash_ints({1, 0}));
  EXPECT_NE(hash_ints({}), hash_ints({0}));
}

TEST(ToUnitInterval, NeverReachesItsEnds) {
  EXPECT_GT(to_unit_interval(0), 0);
  EXPECT_LT(to_unit_interval(~0ULL), 1);
}

}  // namespace
}  // namespace bondlab
