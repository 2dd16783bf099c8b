// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/switch_on.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace bondlab::diagnose {
namespace {

double settled(const std::function<double(double)> &norm, double size, double largest = 1e9,
               double noise = 0.1) {
  std::vector<SizeTried> tried = {{size, norm(size), noise}};
  for (int i = 1; i < most_switch_ons; ++i)
    if (const auto next = next_switch_on(tried, largest))
      tried.push_back({*next, norm(*next), noise});
  return tried.back().size;
}

TEST(SwitchOn, IsTakenToEightNoiseUnitsWhereTheChangeIsInProportion) {
  const auto straight = [](double size) { return 2 * std::abs(size); };
  EXPECT_DOUBLE_EQ(settled(straight, 1), 4);
  EXPECT_DOUBLE_EQ(settled(straight, -1), -4) << "the sign stays";
  EXPECT_DOUBLE_EQ(settled(straight, 100), 12.5) << "two steps down of at most 8";
  EXPECT_DOUBLE_EQ(settled(straight, 3), 3) << "well as it is";
  EXPECT_DOUBLE_EQ(settled(straight, 1, 2), 2) << "admissible";
}

// An exponent of creep: at three times its size all of the strain is there before the rate is read.
TEST(SwitchOn, OfAnEffectThatSaturatesIsTheSizeBefore) {
  const auto saturating = [](double size) { return 3 * (1 - std::exp(-size)); };
  EXPECT_DOUBLE_EQ(settled(saturating, 1), 1);
  const auto later = [](double size) { return 4.5 * std::min(1.0, size / 3); };
  EXPECT_DOUBLE_EQ(settled(later, 1), 8 / 1.5) << "at 5.3 it grew by the whole of three";
}

TEST(SwitchOn, WhatIsLostInNoiseIsGrownTwiceAndNoMore) {
  const auto noise = [](double size) { return 2 + 0.01 * size; };
  EXPECT_DOUBLE_EQ(settled(noise, 1, 1e9, 2.0), 8 / 2.01 * 8 / (2 + 0.01 * 8 / 2.01));
  EXPECT_DOUBLE_EQ(settled([](double size) { return 1e-3 * size; }, 1), 64);
}

}  // namespace
}  // namespace bondlab::diagnose
