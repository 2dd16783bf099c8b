// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/uncertainty.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <cmath>

#include "refine/emulator_for_tests.h"

namespace bondlab {
namespace {

struct Bench {
  Study study = testing::granite_study();
  ParameterSpace space{study.parameters};
  FitProblem problem;
  Jacobian jacobian;
  TransformedPoint point{{0.3, -0.2, 0.5}};

  explicit Bench(const Eigen::MatrixXd &rows) {
    problem.targets = {0, 1, 2};
    problem.sd.assign(3, 1.0);
    problem.noise.assign(3, 0.0);
    jacobian.point = point;
    jacobian.rows = rows;
    jacobian.noise_sd = Eigen::MatrixXd::Zero(rows.rows(), rows.cols());
    jacobian.steps.assign(3, 0.1);
    jacobian.frozen.assign(3, false);
  }
  Uncertainty judge(const Eigen::VectorXd &standardised = Eigen::VectorXd::Zero(3)) const {
    return judge_parameters(space, problem, jacobian, point, standardised);
  }
};

Eigen::MatrixXd regular() {
  Eigen::MatrixXd rows(3, 3);
  rows << 9, -2, 0, 0.3, 6, 0, 0.5, -1, 5;
  return rows;
}

struct LinearCost : ceres::CostFunction {
  Eigen::MatrixXd a;
  explicit LinearCost(Eigen::MatrixXd matrix) : a(std::move(matrix)) {
    set_num_residuals(static_cast<int>(a.rows()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(a.cols()));
  }
  bool Evaluate(double const *const *, double *residuals, double **jacobians) const override {
    Eigen::Map<Eigen::VectorXd>(residuals, a.rows()).setZero();
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (jacobians && jacobians[0]) Eigen::Map<RowMajor>(jacobians[0], a.rows(), a.cols()) = a;
    return true;
  }
};

TEST(Uncertainty, CovarianceIsThatOfCeresDenseSvd) {
  const Bench bench(regular());
  Eigen::MatrixXd stacked(6, 3);
  stacked << regular(), Eigen::Matrix3d::Identity() / bench.problem.prior_sd;
  double z[3] = {0, 0, 0};
  ceres::Problem problem;
  problem.AddResidualBlock(new LinearCost(stacked), nullptr, z);
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.null_space_rank = -1;
  ceres::Covariance covariance(options);
  const std::vector<std::pair<const double *, const double *>> blocks{{z, z}};
  ASSERT_TRUE(covariance.Compute(blocks, &problem));
  double block[9];
  covariance.GetCovarianceBlock(z, z, block);

  const auto judged = bench.judge();
  ASSERT_EQ(judged.correlation.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const double sd_z = std::sqrt(block[4 * k]);
    EXPECT_NEAR(judged.parameters[k].sd, sd_z * bench.space.dx_dz(k, bench.point.z[k]),
                1e-9 * judged.parameters[k].sd);
    for (std::size_t l = 0; l < 3; ++l)
      EXPECT_NEAR(judged.correlation[k][l],
                  block[3 * k + l] / std::sqrt(block[4 * k] * block[4 * l]), 1e-9);
  }
}

TEST(Uncertainty, IntervalLiesInsideTheBoundsAndAroundTheValue) {
  Eigen::MatrixXd weak = regular();
  weak.row(2) *= 0.3;  // sigma_c is known badly
  const auto judged = Bench(weak).judge();
  for (const auto &p : judged.parameters) {
    ASSERT_TRUE(p.identifiable) << p.name << ": " << p.reason;
    EXPECT_GT(p.interval_lower, p.lower);
    EXPECT_LT(p.interval_lower, p.value);
    EXPECT_GT(p.interval_upper, p.value);
    EXPECT_LT(p.interval_upper, p.upper);
  }
}

TEST(Uncertainty, DirectionWithoutASingularValueIsARidgeInWords) {
  Eigen::MatrixXd rows = regular();
  rows.col(1) = -0.5 * rows.col(0);  // only 2 z0 - z1 is seen
  const auto judged = Bench(rows).judge();
  EXPECT_FALSE(judged.parameters[0].identifiable);
  EXPECT_FALSE(judged.parameters[1].identifiable);
  EXPECT_TRUE(judged.parameters[2].identifiable);
  EXPECT_TRUE(std::isnan(judged.parameters[0].sd));
  EXPECT_TRUE(judged.correlation.empty());
  ASSERT_EQ(judged.ridges.size(), 1u);
  const std::string &text = judged.ridges[0].text;
  EXPECT_NE(text.find("raising E_c by"), std::string::npos) << text;
  EXPECT_NE(text.find("raising kn_ks by"), std::string::npos) << text;
  EXPECT_EQ(text.find("sigma_c"), std::string::npos) << text;
}

TEST(Uncertainty, SingularValueThatTheNoiseCouldMakeCountsAsNone) {
  Bench bench(regular());
  bench.jacobian.rows.col(2) << 0.4, -0.3,
      0.5;  // what noise of this size leaves of a column of zeros
  bench.jacobian.noise_sd.col(2).setConstant(0.5);
  auto judged = bench.judge();
  EXPECT_FALSE(judged.parameters[2].identifiable);
  EXPECT_TRUE(judged.parameters[0].identifiable);
  bench.jacobian.noise_sd.setZero();
  judged = bench.judge();
  EXPECT_EQ(judged.ridges.size(), 0u);
}

// Ten planted cases on both sides of the 3.84 line: a sd of s between the bounds, the value in the
// middle, so that the profile rises to (0.5 / s)^2 at either bound.
TEST(Uncertainty, FlatProfileAndNotIdentifiableAreTheSame) {
  for (const double s : {0.01, 0.05, 0.1, 0.2, 0.25, 0.26, 0.3, 0.5, 1.0, 5.0}) {
    Bench bench(regular());
    bench.point = {{0, 0, 0}};
    bench.jacobian.rows = Eigen::Matrix3d::Identity() * 20;
    bench.jacobian.rows(2, 2) = 0.25 / s;  // du/dz is 1/4 in the middle
    const auto judged = bench.judge();
    EXPECT_EQ(judged.parameters[2].identifiable, std::pow(0.5 / s, 2) >= 3.84) << s;
    EXPECT_TRUE(judged.parameters[0].identifiable);
  }
}

TEST(Uncertainty, ProfileFlatTowardsOneBoundOnlyIsSaid) {
  Bench bench(Eigen::Matrix3d::Identity() * 20);
  bench.point = {{0, 0, 2}};  // u = 0.88
  bench.jacobian.rows(2, 2) =
      0.105 / 0.3;  // sd of u 0.3: 0.88 away from the lower bound, 0.12 from the upper
  const auto p = bench.judge().parameters[2];
  EXPECT_TRUE(p.identifiable);
  EXPECT_EQ(p.reason, "the data limit it from below only");
}

TEST(Uncertainty, ParameterAtItsBoundHasNoSdAndSaysWhatTheDataAsk) {
  Bench bench(regular());
  bench.point.z[2] = 5;  // u = 0.993
  Eigen::VectorXd standardised(3);
  standardised << 0, 0, -4;  // the strength is 4 sd too low and grows with sigma_c
  const auto judged = bench.judge(standardised);
  const auto &p = judged.parameters[2];
  EXPECT_EQ(p.at_bound, BoundSide::upper);
  EXPECT_FALSE(p.identifiable);
  EXPECT_TRUE(std::isnan(p.sd));
  EXPECT_NE(p.reason.find("lies at its upper bound, 60 MPa"), std::string::npos) << p.reason;
  EXPECT_NE(p.reason.find("ask for a value beyond it"), std::string::npos) << p.reason;
  EXPECT_TRUE(judged.parameters[0].identifiable);  // judged with the other held
  EXPECT_NE(bench.judge(-standardised).parameters[2].reason.find("pull back"), std::string::npos);
  EXPECT_NE(bench.judge().parameters[2].reason.find("do not say"), std::string::npos);
}

TEST(Uncertainty, OtherWeightsScaleTheRows) {
  Bench bench(regular());
  FitProblem other = bench.problem;
  other.sd = {1, 1, 2};
  const auto scaled = reweighted(bench.jacobian, bench.problem, other);
  EXPECT_EQ(scaled.rows(2, 2), 2.5);
  EXPECT_EQ(scaled.rows(0, 0), 9);
}

}  // namespace
}  // namespace bondlab
