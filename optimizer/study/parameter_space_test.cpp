// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/parameter_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace bondlab {
namespace {

Parameter parameter(double lower, double upper, Scale scale) {
  Parameter p;
  p.name = "p";
  p.unit = "1";
  p.lower = lower;
  p.upper = upper;
  p.scale = scale;
  return p;
}

ParameterSpace one(double lower, double upper, Scale scale) {
  return ParameterSpace({parameter(lower, upper, scale)});
}

double to_x(const ParameterSpace &space, double z) { return space.to_physical({{z}}).x[0]; }
double to_z(const ParameterSpace &space, double x) { return space.to_transformed({{x}}).z[0]; }

TEST(ParameterSpace, RoundTripIsExactToAFewUnitsInTheLastPlace) {
  // Property: physical -> transformed -> physical, for random bounds over 12 decades, random scales
  // and random points down to 1e-12 of the range from either bound. What z's own rounding allows is
  // |dx/dz| * ulp(z), and a few ulp of x (of the larger bound on a linear scale) for the operations
  // of the two ways.
  const double ulp = std::numeric_limits<double>::epsilon();
  RandomStream random(42);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool log_scale = random.index(2) == 1;
    double a = std::pow(10.0, random.uniform(-6, 12)),
           b = a * (1 + std::pow(10.0, random.uniform(-1, 3)));
    if (!log_scale && random.index(2)) a = -a;
    const ParameterSpace space =
        one(std::min(a, b), std::max(a, b), log_scale ? Scale::logarithmic : Scale::linear);
    const double from_end = std::pow(10.0, random.uniform(-12, 0)) * 0.5;
    const double x = space.from_unit_cube({random.index(2) ? from_end : 1 - from_end}).x[0];
    const double z = to_z(space, x), back = to_x(space, z);
    const double magnitude = log_scale ? x : std::max(std::abs(a), std::abs(b));
    const double allowed = 4 * ulp * magnitude + 4 * ulp * space.dx_dz(0, z) * (1 + std::abs(z));
    worst = std::max(worst, std::abs(back - x) / allowed);
  }
  EXPECT_LE(worst, 1);
}

TEST(ParameterSpace, TransformedValuesComeBackToo) {
  const ParameterSpace linear = one(0.1, 0.9, Scale::linear),
                       logarithmic = one(15e9, 45e9, Scale::logarithmic);
  for (double z = -12; z <= 12; z += 0.37) {
    EXPECT_NEAR(to_z(linear, to_x(linear, z)), z, 1e-15 * std::exp(std::abs(z)) + 1e-14) << z;
    EXPECT_NEAR(to_z(logarithmic, to_x(logarithmic, z)), z, 1e-15 * std::exp(std::abs(z)) + 1e-14)
        << z;
  }
}

TEST(ParameterSpace, BoundsAndBeyondGiveTheBoundItself) {
  const ParameterSpace space = one(0.1, 0.7, Scale::logarithmic);
  EXPECT_EQ(to_x(space, to_z(space, 0.1)), 0.1);
  EXPECT_EQ(to_x(space, to_z(space, 0.7)), 0.7);
  EXPECT_EQ(to_x(space, -1e300), 0.1);
  EXPECT_EQ(to_x(space, std::numeric_limits<double>::infinity()), 0.7);
  EXPECT_TRUE(std::isfinite(to_z(space, 0.1)));
}

TEST(ParameterSpace, EveryTransformedPointIsInsideTheBounds) {
  RandomStream random(1);
  for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
    const ParameterSpace space = one(0.3, 0.30001, scale);
    for (int i = 0; i < 10000; ++i) {
      const double x = to_x(space, 20 * random.normal());
      ASSERT_GE(x, 0.3);
      ASSERT_LE(x, 0.30001);
    }
  }
}

TEST(ParameterSpace, MiddleIsArithmeticOrGeometric) {
  EXPECT_DOUBLE_EQ(one(1, 3, Scale::linear).start().x[0], 2);
  EXPECT_DOUBLE_EQ(one(1, 100, Scale::logarithmic).start().x[0], 10);
  Parameter p = parameter(1, 100, Scale::logarithmic);
  p.start = 7;
  EXPECT_EQ(ParameterSpace({p}).start().x[0], 7);
}

TEST(ParameterSpace, DerivativeIsTheLimitOfDifferences) {
  for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
    const ParameterSpace space = one(2, 50, scale);
    for (const double z : {-5.0, -0.3, 0.0, 1.7, 6.0}) {
      const double h = 1e-5, difference = (to_x(space, z + h) - to_x(space, z - h)) / (2 * h);
      EXPECT_NEAR(space.dx_dz(0, z) / difference, 1, 1e-6) << z;
    }
  }
}

TEST(ParameterSpace, AtBoundTellsTheSide) {
  const ParameterSpace linear = one(0, 100, Scale::linear);
  EXPECT_EQ(linear.at_bound(0, 0.9), BoundSide::lower);
  EXPECT_EQ(linear.at_bound(0, 1.1), BoundSide::none);
  EXPECT_EQ(linear.at_bound(0, 99.1), BoundSide::upper);
  EXPECT_EQ(linear.at_bound(0, 80, 0.25), BoundSide::upper);
  const ParameterSpace logarithmic =
      one(1, 1e4, Scale::logarithmic);  // 1 % of the range is a factor 1.0965
  EXPECT_EQ(logarithmic.at_bound(0, 1.09), BoundSide::lower);
  EXPECT_EQ(logarithmic.at_bound(0, 1.10), BoundSide::none);
  EXPECT_EQ(logarithmic.at_bound(0, 9200), BoundSide::upper);
}

TEST(ParameterSpace, UnitCubeAndUnitPositionAreInverse) {
  const ParameterSpace space = one(15e9, 45e9, Scale::logarithmic);
  for (const double u : {0.0, 0.1, 0.5, 0.93, 1.0})
    EXPECT_NEAR(space.unit_position(0, space.from_unit_cube({u}).x[0]), u, 1e-14);
}

TEST(ParameterSpace, RefusesWhatIsOutsideByName) {
  const ParameterSpace space = one(1, 2, Scale::linear);
  try {
    to_z(space, 3);
    FAIL();
  } catch (const UserError &error) {
    EXPECT_STREQ(error.what(), "the parameter 'p' can't be 3; allowed: 1 to 2");
  }
  EXPECT_THROW(to_z(space, std::nan("")), UserError);
  EXPECT_THROW(to_x(space, std::nan("")), UserError);
  EXPECT_THROW(space.to_physical({{1, 2}}), UserError);
  EXPECT_THROW(one(2, 1, Scale::linear), UserError);
  EXPECT_THROW(one(0, 1, Scale::logarithmic), UserError);
}

}  // namespace
}  // namespace bondlab
