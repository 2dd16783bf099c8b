// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_null.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace bondlab::diagnose {
namespace {

constexpr int packings = 10, replicates = 4, rows = 4, series_count = 2;

class NullOfAStudy : public ::testing::Test {
 protected:
  NullOfAStudy() {
    truth = Eigen::MatrixXd::Identity(rows, rows) * 4e-4;
    truth(0, 1) = truth(1, 0) = 2e-4;
  }
  Eigen::MatrixXd draw(int count, RandomStream &random) const {
    Eigen::MatrixXd out(count, rows);
    for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = random.normal();
    const Eigen::MatrixXd factor = truth.llt().matrixL();
    return out * factor.transpose();
  }
  // A data set of a laboratory that lacks nothing.
  void measure(RandomStream &random) {
    series.clear();
    by_packing.resize(packings, rows * series_count);
    for (int i = 0; i < series_count; ++i) {
      MeasuredSeries s;
      s.probed.name = s.probed.test = i == 0 ? "ucs" : "brazilian";
      for (int row = 0; row < rows; ++row)
        s.probed.quantities.push_back({CurvePart::slope, std::to_string(row)});
      s.replicates = draw(replicates, random);
      by_packing.middleCols(i * rows, rows) = draw(packings, random);
      series.push_back(s);
    }
    evidence = evidence_of(study, series, by_packing);
  }
  static double quantile_90(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() * 9 / 10];
  }
  Study study = read_study(std::filesystem::path(BONDLAB_SOURCE_DIR) / "inputs/studies/granite.toml");
  Eigen::MatrixXd truth, by_packing;
  std::vector<MeasuredSeries> series;
  Evidence evidence;
};

TEST_F(NullOfAStudy, IsAsWideAsRealDataAfterTheirCovarianceWasEstimated) {
  RandomStream random(3, 1);
  std::vector<double> real, drawn, known;
  for (int i = 0; i < 1500; ++i) {
    measure(random);
    const Whitening whitening(evidence);
    real.push_back(whitening.residual(by_packing.colwise().mean().transpose()).norm());
  }
  // Each laboratory has one data set to judge by; the mean over some of them is what counts.
  for (int laboratory = 0; laboratory < 10; ++laboratory) {
    measure(random);
    const auto source = study_null({study, series, by_packing, evidence, {},
                                    Eigen::MatrixXd::Zero(rows * series_count, 1),
                                    Eigen::MatrixXd::Zero(rows * series_count, 1)});
    for (int i = 0; i < 150; ++i) drawn.push_back(source(random).residual.norm());
  }
  for (int i = 0; i < 1500; ++i) {
    double sum = 0;
    for (int row = 0; row < rows * series_count; ++row) sum += std::pow(random.normal(), 2);
    known.push_back(std::sqrt(sum));
  }
  EXPECT_NEAR(quantile_90(drawn) / quantile_90(real), 1, 0.06);
  EXPECT_GT(std::abs(quantile_90(known) / quantile_90(real) - 1), 0.04)
      << "the estimate would not matter, and this test would show nothing";
}

TEST_F(NullOfAStudy, ModelsDoubtIsInTheDrawsAndInTheirWhitening) {
  RandomStream random(4, 1);
  measure(random);
  const Eigen::MatrixXd doubt = Eigen::MatrixXd::Identity(rows * series_count, rows * series_count);
  const Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(rows * series_count, 1);
  const auto source = study_null({study, series, by_packing, evidence, doubt, columns, columns});
  double sum = 0;
  constexpr int count = 400;
  for (int i = 0; i < count; ++i) {
    const auto draw = source(random);
    sum += draw.residual.squaredNorm() / (count * rows * series_count);
    // The doubt is 50 times what scatters: columns are whitened by it.
    EXPECT_NEAR(draw.jacobian(0, 0), 1, 0.01);
  }
  EXPECT_NEAR(sum, 1, 0.1);
}

TEST(MeasuredRows, ThoseThatTheModelLacksAreLeftOutAndToldByName) {
  MeasuredSeries series;
  series.probed = {"ucs", "ucs", {{CurvePart::slope, "E"}, {CurvePart::peak, "UCS"}}};
  series.replicates = Eigen::MatrixXd::Random(3, 2);
  const std::vector<ProbedSeries> model = {{"ucs", "ucs", {{CurvePart::peak, "UCS"}}}};
  EXPECT_EQ(not_modelled({series}, model), std::vector<std::string>{"ucs, E"});
  const Eigen::VectorXd kept = series.replicates.col(1);
  std::vector<MeasuredSeries> all = {series};
  EXPECT_EQ(keep_modelled(all, model), std::vector<Eigen::Index>{0});
  EXPECT_EQ(all.front().replicates.col(0), kept);
  EXPECT_TRUE(not_modelled(all, model).empty());
}

}  // namespace
}  // namespace bondlab::diagnose
