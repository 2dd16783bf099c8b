// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/placebo.h"

#include <gtest/gtest.h>

namespace bondlab::diagnose {
namespace {

TEST(Placebo, HasTheSizesOfTheTraceAndIsNeverTheEffectItself) {
  RandomStream random(1);
  Eigen::VectorXd trace(4);
  trace << 2, -1e-3, 3, 0;
  for (int draw = 0; draw < 200; ++draw) {
    const auto placebo = placebo_of(trace, random);
    ASSERT_TRUE(placebo);
    EXPECT_EQ(placebo->cwiseAbs(), trace.cwiseAbs());
    EXPECT_EQ((*placebo)(0) * (*placebo)(2), -6);
  }
}

TEST(Placebo, IsNotThereWhereOneRowCarriesTheTrace) {
  RandomStream random(1);
  Eigen::VectorXd trace = Eigen::VectorXd::Zero(3);
  EXPECT_FALSE(placebo_of(trace, random));
  trace << 0.04, 0, -1;
  EXPECT_FALSE(placebo_of(trace, random));
  trace(0) = 0.06;
  EXPECT_TRUE(placebo_of(trace, random));
}

}  // namespace
}  // namespace bondlab::diagnose
