// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/fit_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace bondlab::diagnose {
namespace {

// One parameter that moves all rows alike, in two series of correlated rows; nothing is missing.
class Interval : public ::testing::Test {
 protected:
  static constexpr int rows = 6, replicates = 4;
  Eigen::MatrixXd draw(int count, RandomStream &random) const {
    Eigen::MatrixXd truth = Eigen::MatrixXd::Constant(rows, rows, 0.7);
    truth.diagonal().setOnes();
    Eigen::MatrixXd out(count, rows);
    for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = random.normal();
    const Eigen::MatrixXd factor = truth.llt().matrixL();
    return 0.02 * out * factor.transpose();
  }
  // A fit of the parameter (truth 0) to drawn data: the estimate over its sd, plain and widened.
  std::pair<double, double> deviation(int packings, RandomStream &random) {
    std::vector<MeasuredSeries> series;
    Eigen::MatrixXd by_packing(packings, 2 * rows);
    for (int i = 0; i < 2; ++i) {
      MeasuredSeries s;
      s.probed.name = s.probed.test = i == 0 ? "ucs" : "brazilian";
      for (int row = 0; row < rows; ++row)
        s.probed.quantities.push_back({CurvePart::slope, std::to_string(row)});
      s.replicates = draw(replicates, random);
      by_packing.middleCols(i * rows, rows) = draw(packings, random);
      series.push_back(s);
    }
    const Evidence evidence = evidence_of(study, series, by_packing);
    const Whitening whitening(evidence);
    const Eigen::MatrixXd column = Eigen::MatrixXd::Ones(2 * rows, 1);
    Refit fit;
    fit.columns = whitening.apply(column);
    fit.covariance = (fit.columns.transpose() * fit.columns).inverse();
    const double estimate =
        fit.covariance(0, 0) * fit.columns.col(0).dot(whitening.residual(
                                   Eigen::VectorXd(by_packing.colwise().mean().transpose())));
    const double plain = std::sqrt(fit.covariance(0, 0));
    widen_covariance(fit, {study, series, by_packing, evidence, {}, column, {}}, 1);
    EXPECT_GE(fit.covariance(0, 0), plain * plain * (1 - 1e-12));
    return {estimate / plain, estimate / std::sqrt(fit.covariance(0, 0))};
  }
  Study study =
      read_study(std::filesystem::path(BONDLAB_SOURCE_DIR) / "inputs/studies/granite.toml");
};

TEST_F(Interval, OfFewPackingsIsWidenedAndCoversTheTruth) {
  RandomStream random(8, 1);
  constexpr int repeats = 250;
  int plain = 0, widened = 0;
  for (int i = 0; i < repeats; ++i) {
    const auto [a, b] = deviation(7, random);
    plain += std::abs(a) < 1.96, widened += std::abs(b) < 1.96;
  }
  EXPECT_LT(plain, 0.93 * repeats) << "nothing to widen: this test would show nothing";
  EXPECT_GT(widened, plain);
  EXPECT_GT(widened, 0.90 * repeats);
}

}  // namespace
}  // namespace bondlab::diagnose
