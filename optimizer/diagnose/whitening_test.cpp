// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/whitening.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace bondlab::diagnose {
namespace {

constexpr int count = 5;

Eigen::MatrixXd covariance() {
  Eigen::MatrixXd c = Eigen::MatrixXd::Constant(count, count, 0.6);
  c.diagonal().setConstant(1);
  return 4 * c;
}

// One series of `replicates` specimens of known covariance about `mean`.
Evidence draw(int replicates, double mean, double stated_over_true, std::uint64_t seed) {
  RandomStream random(seed);
  const Eigen::MatrixXd root = covariance().llt().matrixL();
  Evidence out;
  SeriesEvidence series;
  series.name = "s";
  series.test = "t";
  series.count = count;
  series.replicates.resize(replicates, count);
  for (int r = 0; r < replicates; ++r) {
    Eigen::VectorXd z(count);
    for (auto &x : z) x = random.normal();
    series.replicates.row(r) = (root * z).transpose().array() + mean;
  }
  series.stated = stated_over_true * stated_over_true * covariance();
  series.simulated = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i) out.rows.push_back({"t", "s", CurvePart::slope, "q"});
  out.series.push_back(series);
  return out;
}

TEST(Whitening, MeansOfSpecimensBecomeUncorrelatedWithUnitVariance) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count, count);
  const int draws = 3000;
  for (int d = 0; d < draws; ++d) {
    const Whitening whitening(draw(8, 0, 1, static_cast<std::uint64_t>(d)));
    const Eigen::VectorXd w = whitening.residual(Eigen::VectorXd::Zero(count));
    sum += w * w.transpose() / draws;
  }
  EXPECT_LT((sum - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(), 0.12);
}

TEST(Whitening, ScatterStatedWrongByTwoIsReportedAndReplacedByTheMeasured) {
  for (const double wrong : {0.5, 2.0}) {
    const Whitening right(draw(40, 3, 1, 5)), stated(draw(40, 3, wrong, 5));
    EXPECT_FALSE(right.noise().stated_wrong);
    EXPECT_TRUE(stated.noise().stated_wrong);
    EXPECT_NEAR(stated.noise().scale * wrong, right.noise().scale, 1e-9);
    ASSERT_EQ(stated.noise().notes.size(), 1u);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(count);
    EXPECT_LT((right.residual(zero) - stated.residual(zero)).norm(), 1e-6);
  }
}

TEST(Whitening, SimulationScatterLowersTheWeightOfARow) {
  auto evidence = draw(4, 1, 1, 9);
  const double alone = Whitening(evidence).residual(Eigen::VectorXd::Zero(count)).norm();
  evidence.series.front().simulated = covariance();
  EXPECT_LT(Whitening(evidence).residual(Eigen::VectorXd::Zero(count)).norm(), 0.6 * alone);
}

TEST(Whitening, ShiftOfTheMeanGrowsWithTheMeasuredVariance) {
  auto evidence = draw(40, 3, 0.5, 5);
  const Whitening without(evidence);
  evidence.series.front().shift = Eigen::VectorXd::Constant(count, 0.1);
  const Whitening with(evidence);
  const double variance = std::pow(with.noise().by_test.at("t"), 2);
  EXPECT_NEAR(without.measured()(0) - with.measured()(0), 0.1 * variance, 1e-12);
  EXPECT_GT(variance, 3);
}

TEST(Whitening, BeforeAnyDataTheStatedScatterStands) {
  auto evidence = draw(4, 0, 1, 9);
  evidence.series.front().replicates.resize(0, 0);
  evidence.series.front().planned = 4;
  const Whitening plan(evidence);
  EXPECT_EQ(plan.noise().scale, 1);
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(count, 2);
  const Eigen::MatrixXd mean = covariance() / 4;
  EXPECT_NEAR(plan.apply(unit).squaredNorm(), unit.dot(mean.inverse() * unit), 1e-9);
}

TEST(Whitening, ScatterRowIsOneWhenReplicatesScatterAsStated) {
  auto evidence = draw(30, 0, 1, 11);
  evidence.rows.push_back({"t", "t", CurvePart::scatter, "scatter"});
  ScatterEvidence scatter;
  scatter.row = count;
  scatter.dof = 29;
  scatter.stated = 4;
  scatter.variance = 8;
  evidence.scatter.push_back(scatter);
  const Whitening whitening(evidence);
  const double scale = whitening.noise().scale;
  EXPECT_NEAR(whitening.measured()(count), std::cbrt(2 / (scale * scale)), 1e-12);
}

}  // namespace
}  // namespace bondlab::diagnose
