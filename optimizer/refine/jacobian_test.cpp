// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/jacobian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refine/emulator_for_tests.h"

namespace bondlab {
namespace {

using testing::granite_law;
using testing::granite_study;
using testing::GraniteEmulator;

struct Bench {
  Study study = granite_study();
  GraniteEmulator model;
  ParameterSpace space{study.parameters};
  Evaluator evaluator{study, space, model};
  FitProblem problem;
  TransformedPoint point;

  Bench() {
    study.options.max_failed = 10;
    problem.targets = {0, 1, 2};
    for (const std::size_t i : problem.targets) problem.sd.push_back(study.targets[i].sd);
    problem.noise.assign(3, 0.0);
    point = space.to_transformed(space.from_unit_cube({0.4, 0.5, 0.6}));
  }
  // Closed form of the standardised derivative of UCS by sigma_c.
  double slope_ucs_sigma() const {
    const auto x = space.to_physical(point).x;
    return 0.849 * granite_law(x[0], x[1], x[2]).UCS / x[2] * space.dx_dz(2, point.z[2]) /
           problem.sd[2];
  }
  std::vector<double> steps(const Eigen::MatrixXd &slopes = {}, double relative = 0.03) const {
    return difference_steps(space, problem, point, slopes, relative);
  }
};

TEST(Jacobian, IsOneBatchAndOfSecondOrder) {
  Bench bench;
  bench.evaluator.run({bench.point}, bench.problem.targets, "test");
  double error[2];
  for (const int halved : {0, 1}) {
    auto steps = bench.steps({}, 0.08);
    for (double &step : steps) step /= 1 + halved;
    bench.model.batches = bench.model.runs = 0;
    const auto jacobian = difference_jacobian(bench.evaluator, bench.problem, bench.point, steps);
    EXPECT_EQ(bench.model.batches, 1);
    EXPECT_EQ(bench.model.runs, 6);
    error[halved] = std::fabs(jacobian.rows(2, 2) / bench.slope_ucs_sigma() - 1);
  }
  EXPECT_LT(error[0], 0.02);
  EXPECT_NEAR(error[0] / error[1], 4, 0.3);
}

TEST(Jacobian, StepIsNeverBelow2PercentOfTheParameter) {
  const Bench bench;
  const auto steps = bench.steps({}, 1e-6);
  const auto x = bench.space.to_physical(bench.point).x;
  for (std::size_t k = 0; k < 3; ++k) {
    auto moved = bench.point;
    moved.z[k] += steps[k];
    EXPECT_GT(bench.space.to_physical(moved).x[k] / x[k] - 1, 0.018) << k;
  }
}

TEST(Jacobian, StepGrowsWithTheCubeRootOfTheNoise) {
  Bench bench;
  const Eigen::MatrixXd slopes = Eigen::MatrixXd::Constant(3, 3, 5.0);
  bench.problem.noise = {0, 0, 0.01 * bench.problem.sd[2]};
  const auto small = bench.steps(slopes, 0.0);
  bench.problem.noise = {0, 0, 0.08 * bench.problem.sd[2]};
  const auto large = bench.steps(slopes, 0.0);
  EXPECT_NEAR(large[2] / small[2], 2, 1e-6);
  bench.problem.noise = {0, 0, 100 * bench.problem.sd[2]};
  EXPECT_EQ(bench.steps(slopes, 0.0)[2], largest_z_step);
}

// The reason for the floor: with a noise of 2 % a step of 0.1 % leaves nothing of the slope, the
// balanced step 85 % of it.
TEST(Jacobian, BalancedStepKeepsTheSlopeThatASmallOneDrowns) {
  int good_small = 0, good_balanced = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Bench bench;
    bench.model.noise_strength = 0.02;
    bench.model.seed = seed;
    bench.problem.noise = {0, 0, 0.02 * bench.study.targets[2].value};
    bench.evaluator.run({bench.point}, bench.problem.targets, "test");
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(3, 3);
    slopes.col(2).setConstant(bench.slope_ucs_sigma() / std::sqrt(3.0));
    const auto judge = [&](const std::vector<double> &steps) {
      const auto jacobian = difference_jacobian(bench.evaluator, bench.problem, bench.point, steps);
      return std::fabs(jacobian.rows(2, 2) / bench.slope_ucs_sigma() - 1) < 0.25;
    };
    good_small += judge(std::vector<double>(3, 0.004));
    good_balanced += judge(bench.steps(slopes, 0.02));
  }
  EXPECT_LT(good_small, 15);
  EXPECT_GE(good_balanced, 48);
}

TEST(Jacobian, NoiseOfItsEntriesIsThatOfTheDifferences) {
  Bench bench;
  bench.problem.noise = {0, 0, 0.4 * bench.problem.sd[2]};
  bench.evaluator.run({bench.point}, bench.problem.targets, "test");
  const auto steps = bench.steps();
  const auto jacobian = difference_jacobian(bench.evaluator, bench.problem, bench.point, steps);
  EXPECT_NEAR(jacobian.noise_sd(2, 1), std::sqrt(2.0) * 0.4 / (2 * steps[1]), 1e-12);
  EXPECT_EQ(jacobian.noise_sd(0, 1), 0);
}

TEST(Jacobian, FailedSideLeavesAOneSidedColumnFailedSidesAFrozenOne) {
  Bench bench;
  bench.evaluator.run({bench.point}, bench.problem.targets, "test");
  const auto x = bench.space.to_physical(bench.point).x;
  bench.model.fail = [&](const ForwardRequest &request) {
    const bool above = request.variables.at("sigma_c") > x[2],
               moved_k = request.variables.at("kn_ks") != x[1];
    return above || moved_k ? FailureCause::timeout : FailureCause::none;
  };
  const auto jacobian =
      difference_jacobian(bench.evaluator, bench.problem, bench.point, bench.steps());
  EXPECT_FALSE(jacobian.frozen[0]);
  EXPECT_TRUE(jacobian.frozen[1]);
  EXPECT_FALSE(jacobian.frozen[2]);
  EXPECT_EQ(jacobian.rows.col(1).norm(), 0);
  EXPECT_NEAR(jacobian.rows(2, 2) / bench.slope_ucs_sigma(), 1, 0.03);  // first order
  ASSERT_EQ(jacobian.notes.size(), 2u);
  EXPECT_NE(jacobian.notes[0].find("kn_ks was held"), std::string::npos);
  EXPECT_NE(jacobian.notes[1].find("sigma_c is one-sided"), std::string::npos);
  EXPECT_NE(jacobian.notes[1].find("planted failure"), std::string::npos);
}

}  // namespace
}  // namespace bondlab
