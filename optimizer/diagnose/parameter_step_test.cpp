// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/parameter_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace bondlab::diagnose {
namespace {

constexpr double pilot = 0.12;

// A row with slope 1 and |f'''| = 1/2 at the centre, which is what the step is made for.
double bending(double x) { return std::sqrt(2.0) * std::sin(x / std::sqrt(2.0)); }

struct Pilot {
  std::vector<double> knots;
  std::vector<Eigen::MatrixXd> changes;
};

Pilot pilot_of(double noise, Eigen::Index packings, bool both = true) {
  RandomStream random(1, 1);
  Pilot out;
  for (const double x : {-pilot, pilot}) {
    if (x < 0 && !both) continue;
    Eigen::MatrixXd change(packings, 1);
    for (Eigen::Index p = 0; p < packings; ++p) change(p, 0) = bending(x) + noise * random.normal();
    out.knots.push_back(x);
    out.changes.push_back(change);
  }
  return out;
}

double step_of(const Pilot &pilot, double packings) {
  return parameter_step_from_noise(pilot.knots, pilot.changes,
                                   Eigen::VectorXd::Ones(pilot.changes.front().cols()), packings);
}

// n is the standard error of half a difference: s / sqrt(2 P).
TEST(ParameterStep, IsThatOfTheClosedForm) {
  const double noise = 0.01, packings = 16;
  const double n = noise / std::sqrt(2 * packings), right = std::cbrt(std::sqrt(18.0) * n / 0.5);
  EXPECT_NEAR(step_of(pilot_of(noise, 4000), packings) / right, 1, 0.02);
}

TEST(ParameterStep, MakesTheErrorOfADifferenceLeast) {
  const double noise = 0.02, packings = 4;
  const double step = step_of(pilot_of(noise, 4000), packings);
  RandomStream random(2, 1);
  const auto error = [&](double h) {
    double square = 0;
    for (int draw = 0; draw < 4000; ++draw) {
      const double s = noise / std::sqrt(packings), up = bending(h) + s * random.normal(),
                   down = bending(-h) + s * random.normal();
      square += std::pow((up - down) / (2 * h) - 1, 2) / 4000;
    }
    return std::sqrt(square);
  };
  const double least = error(step);
  EXPECT_LT(least, 0.9 * error(step / 2));
  EXPECT_LT(least, 0.9 * error(step * 2));
}

TEST(ParameterStep, GrowsWithTheCubeRootOfTheNoise) {
  EXPECT_NEAR(step_of(pilot_of(0.016, 4000), 16) / step_of(pilot_of(0.002, 4000), 16), 2, 0.03);
}

TEST(ParameterStep, IsSmallestWithoutNoiseAndLargestWithoutSlope) {
  EXPECT_EQ(step_of(pilot_of(0, 6), 16), smallest_parameter_step);
  Pilot flat = pilot_of(0.01, 6);
  for (auto &change : flat.changes) change.array() -= change.mean();
  EXPECT_EQ(step_of(flat, 16), largest_parameter_step);
  EXPECT_EQ(parameter_step_from_noise({}, {}, Eigen::VectorXd(), 16), largest_parameter_step);
}

// At a bound there is one side only. Its difference over h has twice the error of one over 2 h.
TEST(ParameterStep, OneSideServes) {
  const double both = step_of(pilot_of(0.01, 4000), 16),
               one = step_of(pilot_of(0.01, 4000, false), 16);
  EXPECT_NEAR(one / both, std::cbrt(std::sqrt(2.0) * 0.5), 0.03);
}

// Noise has a mean that is not zero on six packings; four hundred rows of it are no slope.
TEST(ParameterStep, NoiseIsNoSlope) {
  const Eigen::Index rows = 400, packings = 6;
  const double noise = 0.05;
  Pilot wide = pilot_of(0, packings);
  RandomStream random(3, 1);
  for (auto &change : wide.changes) {
    change.conservativeResize(packings, 1 + rows);
    for (Eigen::Index j = 1; j <= rows; ++j)
      for (Eigen::Index p = 0; p < packings; ++p) change(p, j) = noise * random.normal();
  }
  const double n = noise * std::sqrt(rows / (2.0 * 40000)),
               right = std::cbrt(std::sqrt(18.0) * n / 0.5);
  EXPECT_NEAR(step_of(wide, 40000) / right, 1, 0.12);
}

TEST(ParameterStep, RowsThatAPackingLacksTellNothing) {
  const Pilot alone = pilot_of(0.01, 6);
  Pilot with_gap = alone;
  for (auto &change : with_gap.changes) {
    change.conservativeResize(6, 2);
    change.col(1).setConstant(100);
    change(3, 1) = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_EQ(step_of(with_gap, 16), step_of(alone, 16));
}

}  // namespace
}  // namespace bondlab::diagnose
