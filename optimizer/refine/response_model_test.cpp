// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/response_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "design/latin_hypercube.h"
#include "refine/emulator_for_tests.h"

namespace bondlab {
namespace {

using testing::granite_law;

struct Bench {
  Study study = testing::granite_study();
  ParameterSpace space{study.parameters};
  std::vector<TransformedPoint> points;

  explicit Bench(int count = 12) {
    for (const auto &u : latin_hypercube(count, 3, 1))
      points.push_back(space.to_transformed(space.from_unit_cube(u)));
  }
  template <class F>
  std::vector<double> values(F &&f) const {
    std::vector<double> all;
    for (const auto &point : points) all.push_back(f(space.to_physical(point).x));
    return all;
  }
  std::vector<double> ones() const { return std::vector<double>(points.size(), 1.0); }
};

double ucs(const std::vector<double> &x) { return granite_law(x[0], x[1], x[2]).UCS; }
double nu(const std::vector<double> &x) { return granite_law(x[0], x[1], x[2]).nu; }

TEST(ResponseModel, PowerLawAndLogarithmAreExactOnLogarithmicScales) {
  const Bench bench;
  const TransformedPoint elsewhere{{0.7, -1.1, 0.3}};
  const auto x = bench.space.to_physical(elsewhere).x;
  const auto strength =
      ResponseModel::fit(bench.space, bench.points, bench.values(ucs), bench.ones());
  ASSERT_TRUE(strength);
  EXPECT_NEAR(strength->value(elsewhere) / ucs(x), 1, 1e-9);
  const auto poisson =
      ResponseModel::fit(bench.space, bench.points, bench.values(nu), bench.ones());
  ASSERT_TRUE(poisson);
  EXPECT_NEAR(poisson->value(elsewhere) / nu(x), 1, 1e-9);
}

TEST(ResponseModel, GradientIsThatOfTheResponseInTransformedSpace) {
  const Bench bench;
  const auto model = ResponseModel::fit(bench.space, bench.points, bench.values(ucs), bench.ones());
  const TransformedPoint at{{0.7, -1.1, 0.3}};
  const double exponents[] = {0.085, -0.231, 0.849};  // UCS = ... x^a, so dUCS/dz = a UCS / x dx/dz
  const auto x = bench.space.to_physical(at).x;
  for (std::size_t k = 0; k < 3; ++k) {
    const double expected = exponents[k] * ucs(x) / x[k] * bench.space.dx_dz(k, at.z[k]);
    EXPECT_NEAR(model->gradient(at)(static_cast<Eigen::Index>(k)) / expected, 1, 1e-5) << k;
  }
}

TEST(ResponseModel, LeaveOneOutErrorIsAboutTheScatter) {
  const Bench bench(60);
  RandomStream random(1);
  auto values = bench.values(ucs);
  for (double &value : values) value *= 1 + 0.03 * random.normal();
  const auto model = ResponseModel::fit(bench.space, bench.points, values, bench.ones());
  EXPECT_GT(model->error(), 0.02);
  EXPECT_LT(model->error(), 0.045);
}

TEST(ResponseModel, PointsWithoutAFigureOrWithoutWeightAreLeftOut) {
  const Bench bench;
  auto values = bench.values(ucs);
  auto weights = bench.ones();
  values[0] = std::numeric_limits<double>::quiet_NaN();
  values[1] = 1e15;
  weights[1] = 0;
  const auto model = ResponseModel::fit(bench.space, bench.points, values, weights);
  const TransformedPoint elsewhere{{0.7, -1.1, 0.3}};
  EXPECT_NEAR(model->value(elsewhere) / ucs(bench.space.to_physical(elsewhere).x), 1, 1e-9);
}

TEST(ResponseModel, TooFewPointsGiveNoModel) {
  const Bench bench(4);  // four coefficients need five points
  EXPECT_FALSE(ResponseModel::fit(bench.space, bench.points, bench.values(ucs), bench.ones()));
}

}  // namespace
}  // namespace bondlab
