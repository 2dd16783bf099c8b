// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/covariance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace bondlab::diagnose {
namespace {

Eigen::MatrixXd draw(const Eigen::MatrixXd &covariance, int count, RandomStream &random) {
  Eigen::MatrixXd out(count, covariance.rows());
  for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = random.normal();
  const Eigen::MatrixXd factor = covariance.llt().matrixL();
  return out * factor.transpose();
}

Eigen::MatrixXd correlated(double r, Eigen::Index rows) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Constant(rows, rows, r);
  out.diagonal().setOnes();
  return out;
}

TEST(ShrunkCovariance, KeepsVariancesAndStrongCorrelationsOfManySamples) {
  RandomStream random(1, 1);
  const Eigen::MatrixXd sample = draw(correlated(0.9, 5), 60, random);
  const Eigen::MatrixXd found = shrunk_covariance(sample);
  EXPECT_LT((found.diagonal() - variances(sample)).norm(), 1e-12);
  double mean = 0;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < i; ++j) mean += found(i, j) / std::sqrt(found(i, i) * found(j, j)) / 10;
  EXPECT_GT(mean, 0.84);  // n / (n + rows) of 0.9 would be 0.83, and less with few samples
}

TEST(ShrunkCovariance, DropsCorrelationsThatAreNoise) {
  RandomStream random(2, 1);
  double raw = 0, shrunk = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::MatrixXd sample = draw(correlated(0, 6), 8, random);
    const Eigen::MatrixXd centred = sample.rowwise() - sample.colwise().mean();
    Eigen::MatrixXd full = centred.transpose() * centred / 7, less = shrunk_covariance(sample);
    full.diagonal().setZero(), less.diagonal().setZero();
    raw += full.squaredNorm(), shrunk += less.squaredNorm();
  }
  EXPECT_LT(shrunk, 0.15 * raw);
}

TEST(ShrunkCovariance, CanBeInvertedWithFewerSamplesThanRows) {
  RandomStream random(3, 1);
  const Eigen::MatrixXd found = shrunk_covariance(draw(correlated(0.95, 9), 5, random));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(found);
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0.01 * solver.eigenvalues().maxCoeff() / 9);
}

TEST(ShrunkCovariance, OfOneSampleIsZero) {
  EXPECT_EQ(shrunk_covariance(Eigen::MatrixXd::Ones(1, 3)).norm(), 0);
}

// Quantities whose specimens scatter 1, 1 and 4 times as much (variance), with the dof given.
std::vector<double> mean_excess(int specimens, int series, RandomStream &random) {
  constexpr int repeats = 300, packings = 40;
  const std::vector<double> truth = {1, 1, 4};
  std::vector<double> mean(truth.size(), 0.0);
  for (int r = 0; r < repeats; ++r) {
    std::vector<ExcessTally> tallies(truth.size());
    for (std::size_t q = 0; q < truth.size(); ++q)
      for (int s = 0; s < series; ++s) {
        const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
        tallies[q].add(variances(draw(one * truth[q], specimens, random))(0),
                       variances(draw(one, packings, random))(0), specimens - 1, packings - 1);
      }
    const auto excess = excess_scatter(tallies);
    for (std::size_t q = 0; q < truth.size(); ++q) mean[q] += std::log(excess[q]) / repeats;
  }
  for (double &m : mean) m = std::exp(m);
  return mean;
}

TEST(ExcessScatter, OfOneQuantityIsFoundFromManySeriesAndGivenToNoOther) {
  RandomStream random(4, 1);
  const auto found = mean_excess(4, 20, random);
  EXPECT_NEAR(found[2], 4, 0.9);
  EXPECT_LT(found[0], 1.25);
  EXPECT_GE(found[0], 1);
}

// Three specimens' worth against quantities known well to have none: weight 0.25 / (0.25 + 2 / 3).
TEST(ExcessScatter, OfFewSpecimensLeansOnAllQuantitiesAndHoldsWhatStaysUnknown) {
  const auto with_ratio = [](double ratio) {
    std::vector<ExcessTally> tallies(9);
    for (auto &tally : tallies) tally.sum = tally.dof = 1e6;
    tallies[4].dof = 3;
    tallies[4].sum = 3 * ratio * std::exp(-1.0 / 3);
    return excess_scatter(tallies)[4];
  };
  const double chance = 2.0 / 3, weight = 0.25 / (0.25 + chance);
  EXPECT_NEAR(with_ratio(1), std::exp(weight * chance), 1e-5);
  EXPECT_NEAR(with_ratio(2), std::exp(weight * std::log(2.0) + weight * chance), 1e-5);
}

// What is nearly the same in every packing (a servo's hold) and measured with a noisy sensor.
TEST(ExcessScatter, OfASensorFarWorseThanAllOthersIsBelievedFromFewSpecimens) {
  std::vector<ExcessTally> tallies(8);
  for (auto &tally : tallies) tally.add(1, 1, 3, 39);
  tallies[3].sum = 0, tallies[3].dof = 0;
  tallies[3].add(100, 1, 3, 39);
  EXPECT_GT(excess_scatter(tallies)[3], 60);
}

TEST(ExcessScatter, NothingMeasuredTwiceHasNone) {
  EXPECT_EQ(excess_scatter({ExcessTally(), ExcessTally()}), (std::vector<double>{1, 1}));
}

TEST(SpecimenCovariance, HasTheExcessOnItsDiagonalOnly) {
  RandomStream random(6, 1);
  const Eigen::MatrixXd packings = draw(correlated(0.8, 3), 40, random);
  Eigen::MatrixXd specimens = draw(correlated(0.8, 3), 6, random);
  const Eigen::VectorXd none = Eigen::VectorXd::Ones(3);
  const Eigen::MatrixXd plain = specimen_covariance(packings, specimens, none);
  Eigen::VectorXd excess = none;
  excess(1) = 9;
  specimens.col(1) *= 3;
  const Eigen::MatrixXd noisy = specimen_covariance(packings, specimens, excess);
  EXPECT_NEAR(noisy(1, 1), 9 * plain(1, 1), 1e-12);
  EXPECT_NEAR(noisy(0, 0), plain(0, 0), 1e-12);
  // A sensor's noise is its own: what the rows share stays as large as it was.
  EXPECT_NEAR(noisy(0, 1), plain(0, 1), 0.2 * plain(0, 1));
}

TEST(SpecimenCovariance, ASpecimenFarOffInOneRowWidensThatRowAlone) {
  RandomStream random(7, 1);
  const Eigen::MatrixXd packings = draw(correlated(0.5, 3), 40, random);
  Eigen::MatrixXd specimens = draw(correlated(0.5, 3), 4, random);
  const Eigen::VectorXd none = Eigen::VectorXd::Ones(3);
  const Eigen::MatrixXd plain = specimen_covariance(packings, specimens, none);
  specimens(2, 1) += 30;
  const Eigen::MatrixXd off = specimen_covariance(packings, specimens, none);
  // Its mean is off by 30 / 4, which must be within 3 sd of the mean of four.
  EXPECT_GT(3 * std::sqrt(off(1, 1) / 4), 30.0 / 4);
  EXPECT_NEAR(off(0, 0), plain(0, 0), 1e-12);
}

}  // namespace
}  // namespace bondlab::diagnose
