// SPDX-License-Identifier: GPL-2.0-or-later
//
// The vector exponential and logarithm against the library's long double ones.
#include "lane_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace bondlab::laws;

namespace {

constexpr double kBound = 1e-15;  // relative

// Worst relative error of `lane` against `exact` over arguments drawn by `draw`.
template <class Lane, class Exact, class Draw>
double worst(Lane lane, Exact exact, Draw draw) {
  double most = 0.0;
  for (int k = 0; k < 200000; ++k) {
    const double x = draw();
    const long double right = exact(static_cast<long double>(x));
    const double error = static_cast<double>(std::fabs((lane(x) - right) / right));
    EXPECT_FALSE(std::isnan(error)) << x;
    most = std::max(most, error);
  }
  return most;
}

std::mt19937_64 generator(5);
double uniform(double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(generator);
}

}  // namespace

TEST(LaneMath, exponential) {
  EXPECT_LT(worst([](double x) { return exp_lane(x); }, [](long double x) { return expl(x); },
                  [] { return uniform(-700, 700); }), kBound);
  EXPECT_EQ(exp_lane(0.0), 1.0);
}

TEST(LaneMath, decay_keeps_its_digits_at_tiny_arguments) {
  EXPECT_LT(worst([](double x) { return decay_lane(x); }, [](long double x) { return -expm1l(-x); },
                  [] { return std::exp(uniform(-700, 6)); }), kBound);
  EXPECT_EQ(decay_lane(0.0), 0.0);
  EXPECT_EQ(decay_lane(1e300), 1.0);
}

TEST(LaneMath, logarithm) {
  EXPECT_LT(worst([](double x) { return log_lane(x); }, [](long double x) { return logl(x); },
                  [] { return std::exp(uniform(-700, 700)); }), kBound);
  EXPECT_LT(worst([](double x) { return log_lane(x); }, [](long double x) { return logl(x); },
                  [] { return uniform(0.99, 1.01); }), kBound);
  EXPECT_EQ(log_lane(1.0), 0.0);
}

TEST(LaneMath, log1p_over_its_argument) {
  const auto exact = [](long double y) { return log1pl(y) / y; };
  const auto lane = [](double y) { return log1p_ratio(y); };
  EXPECT_LT(worst(lane, exact, [] { return std::exp(uniform(-700, 700)); }), kBound);
  EXPECT_LT(worst(lane, exact, [] { return -std::exp(uniform(-700, -1e-3)); }), kBound);
  EXPECT_LT(worst(lane, exact, [] { return uniform(-0.6, 1.2); }), kBound);
  EXPECT_EQ(log1p_ratio(0.0), 1.0);
}

TEST(LaneMath, arguments_beyond_the_range_stay_finite_and_nan_stays_nan) {
  EXPECT_DOUBLE_EQ(exp_lane(1e5) / std::exp(700.0), 1.0);
  EXPECT_DOUBLE_EQ(exp_lane(-1e5) / std::exp(-700.0), 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(exp_lane(nan)));
  EXPECT_TRUE(std::isnan(decay_lane(nan)));
  EXPECT_TRUE(std::isnan(log_lane(nan)));
  EXPECT_TRUE(std::isnan(log1p_ratio(nan)));
}
