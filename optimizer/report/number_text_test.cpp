// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bondlab {
namespace {

const double none = std::numeric_limits<double>::quiet_NaN();

TEST(NumberText, SignificantDigits) {
  EXPECT_EQ(significant(41.5), "41.5");
  EXPECT_EQ(significant(41.62314), "41.62");
  EXPECT_EQ(significant(9.99996), "10");
  EXPECT_EQ(significant_full(9.99996), "10.00");
  EXPECT_EQ(significant(12952), "12950");
  EXPECT_EQ(significant(0), "0");
  EXPECT_EQ(significant(-0.23456), "\u22120.2346");
  EXPECT_EQ(significant(0.00012345, 3), "0.000123");
  EXPECT_EQ(significant(1.5e-7), "1.5e\u22127");
  EXPECT_EQ(significant(3.25e9), "3.25e9");
  EXPECT_EQ(significant(none), "\u2013");
  EXPECT_EQ(significant_full(136.0), "136.0");
  EXPECT_EQ(significant_full(136000), "136000");
  EXPECT_EQ(significant(100), "100");
}

TEST(NumberText, CutsTheValueWhereTheDeviationIs) {
  EXPECT_EQ(plus_minus(23.41234, 0.8512), "23.41 ± 0.85");
  EXPECT_EQ(plus_minus(138.8, 6.94), "138.8 ± 6.9");
  EXPECT_EQ(plus_minus(1234.5, 120), "1234 ± 120");
  EXPECT_EQ(plus_minus(23.41234, none), "23.41");
  EXPECT_EQ(plus_minus(none, 1), "\u2013");
}

TEST(NumberText, SignedPercent) {
  EXPECT_EQ(signed_percent(0.0312), "+3.1\u00a0%");
  EXPECT_EQ(signed_percent(-0.004), "\u22120.4\u00a0%");
  EXPECT_EQ(signed_percent(0.671), "+67\u00a0%");
  EXPECT_EQ(signed_percent(-0.00001), "0.0\u00a0%");
  EXPECT_EQ(signed_percent(0.00001), "0.0\u00a0%");
  EXPECT_EQ(signed_percent(none), "\u2013");
}

TEST(NumberText, CountsAndTimes) {
  EXPECT_EQ(count_text(812), "812");
  EXPECT_EQ(count_text(2043), "2043");
  EXPECT_EQ(count_text(12952), "12\u202f952");
  EXPECT_EQ(count_text(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(count_text(100000), "100\u202f000");
  EXPECT_EQ(count_text(-12952), "\u221212\u202f952");
  EXPECT_EQ(duration_text(0.42), "0.4\u00a0s");
  EXPECT_EQ(duration_text(9.97), "10\u00a0s");
  EXPECT_EQ(duration_text(552), "9\u00a0min 12\u00a0s");
  EXPECT_EQ(duration_text(7199.9), "2\u00a0h 00\u00a0min");
  EXPECT_EQ(counted(1, "run", "runs"), "1\u00a0run");
  EXPECT_EQ(counted(0, "run", "runs"), "0\u00a0runs");
  EXPECT_EQ(list_text({}), "");
  EXPECT_EQ(list_text({"E"}), "E");
  EXPECT_EQ(list_text({"E", "nu", "UCS"}), "E, nu and UCS");
}

}  // namespace
}  // namespace bondlab
