// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/plain_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bondlab {
namespace {

TEST(PlainMath, AgreesWithTheLibrary) {
  for (double x = -20; x <= 20; x += 0.37)
    EXPECT_NEAR(plain_exp(x) / std::exp(x), 1, 1e-14 * (1 + std::fabs(x))) << x;
  for (double x = 1e-6; x < 1e6; x *= 1.7) {
    EXPECT_NEAR(plain_log(x), std::log(x), 1e-13 * (1 + std::fabs(std::log(x)))) << x;
    EXPECT_NEAR(plain_cube_root(x) / std::cbrt(x), 1, 1e-14) << x;
  }
  EXPECT_EQ(plain_exp(0), 1);
  EXPECT_EQ(plain_log(1), 0);
}

TEST(PlainMath, NormalQuantileIsTheInverseOfTheDistribution) {
  for (double p = 0.001; p < 0.9995; p += 0.0137)
    EXPECT_NEAR(0.5 * std::erfc(-plain_normal_quantile(p) / std::sqrt(2.0)), p, 1e-13) << p;
  EXPECT_EQ(plain_normal_quantile(0.5), 0);
  EXPECT_NEAR(plain_normal_quantile(0.975), 1.959963984540054, 1e-12);
}

}  // namespace
}  // namespace bondlab
