// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/sensor_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/random.h"
#include "diagnose/covariance.h"
#include "diagnose/study_evidence.h"
#include "study/study.h"

namespace bondlab::diagnose {
namespace {

// Loading that bends a little, and a brittle fall.
Curve specimen(int points = 200) {
  Curve curve;
  curve.names = {"axial_stress", "strain_axial"};
  curve.units = {"Pa", "1"};
  curve.columns.resize(2);
  for (int i = 0; i < points; ++i) {
    const double x = static_cast<double>(i) / points;
    curve.columns[1].push_back(3e-3 * x);
    curve.columns[0].push_back(x < 0.8 ? 80e6 * x * (1 - 0.1 * x) : 9e6);
  }
  return curve;
}

Curve noisy(Curve curve, double load, double strain, std::uint64_t seed) {
  RandomStream random(seed, 3);
  for (std::size_t i = 0; i < curve.columns[0].size(); ++i) {
    curve.columns[0][i] += load * random.normal();
    curve.columns[1][i] += strain * random.normal();
  }
  return curve;
}

TEST(SensorNoise, IsItsSdWhateverTheCurveDoes) {
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    sum += white_noise({noisy(specimen(), 2e5, 0, seed).columns[0]})[0] / 40;
  EXPECT_NEAR(sum / 2e5, 1, 0.05);
}

TEST(SensorNoise, SmoothCurveHasNone) {
  std::vector<double> wave;
  for (int i = 0; i < 300; ++i) wave.push_back(std::sin(0.05 * i));
  EXPECT_EQ(white_noise({wave})[0], 0);
  EXPECT_EQ(white_noise({specimen().columns[0]})[0], 0);
  // A drift from point to point is no white noise either.
  RandomStream random(1, 1);
  double at = 0;
  std::vector<double> drift;
  for (int i = 0; i < 2000; ++i) drift.push_back(at += random.normal());
  EXPECT_EQ(white_noise({drift})[0], 0);
}

TEST(SensorNoise, FewPointsShowNone) {
  EXPECT_EQ(white_noise({noisy(specimen(19), 2e5, 0, 1).columns[0]})[0], 0);
  EXPECT_GT(white_noise({noisy(specimen(40), 2e5, 0, 1).columns[0]})[0], 0);
}

// Sixty points alone are often taken for a drift; six specimens' together are not.
TEST(SensorNoise, SpecimensAreDecidedOnTogether) {
  int alone = 0, together = 0;
  for (std::uint64_t set = 0; set < 20; ++set) {
    std::vector<std::vector<double>> columns;
    for (std::uint64_t i = 0; i < 6; ++i) {
      columns.push_back(noisy(specimen(60), 2e5, 0, 10 * set + i).columns[0]);
      alone += white_noise({columns.back()})[0] == 0;
    }
    const auto found = white_noise(columns);
    together += static_cast<int>(std::count(found.begin(), found.end(), 0.0));
  }
  EXPECT_GT(alone, 5);
  EXPECT_EQ(together, 0) << "of 120";
}

class SensorRows : public ::testing::Test {
 protected:
  Study study =
      read_study(std::filesystem::path(BONDLAB_SOURCE_DIR) / "inputs" / "studies" / "granite.toml");
  std::vector<CurveQuantity> quantities = {{CurvePart::toe, "gauge strain to 0.2"},
                                           {CurvePart::slope, "gauge compliance 0.3 to 0.6"},
                                           {CurvePart::peak, "log peak"}};
  TestDefinition test = study.test("ucs").definition;
};

// What a hundred specimens that differ by their sensors alone would scatter, from six of them.
TEST_F(SensorRows, VarianceIsThatOfSpecimensThatDifferBySensorsOnly) {
  Eigen::MatrixXd rows(200, 3);
  for (int i = 0; i < 200; ++i)
    rows.row(i) = rows_of_curve(noisy(specimen(), 2e5, 1e-5, 100 + static_cast<unsigned>(i)),
                                quantities, test, {})
                      .transpose();
  std::vector<Curve> six;
  for (std::uint64_t i = 0; i < 6; ++i) six.push_back(noisy(specimen(), 2e5, 1e-5, i));
  const Eigen::VectorXd found = sensor_variance(six, quantities, test, {}, 1),
                        right = variances(rows);
  for (Eigen::Index row = 0; row < 3; ++row)
    EXPECT_NEAR(std::sqrt(found(row) / right(row)), 1, 0.25) << quantities[row].name;
}

TEST_F(SensorRows, NoneWithoutNoise) {
  EXPECT_EQ(sensor_variance({specimen(), specimen()}, quantities, test, {}, 1).norm(), 0);
}

// Six specimens that agree by luck in a row that packings hardly scatter in.
TEST_F(SensorRows, LuckyAgreementIsNotBelieved) {
  RandomStream random(1, 9);
  Eigen::MatrixXd packings(40, 3);
  for (Eigen::Index i = 0; i < 40; ++i)
    packings.row(i) << 1e-5 * random.normal(), 0.01 * random.normal(), 0.05 * random.normal();
  MeasuredSeries series;
  series.probed = {"ucs", "ucs", quantities};
  series.replicates.resize(6, 3);
  for (Eigen::Index i = 0; i < 6; ++i)
    series.replicates.row(i) << 5e-4 * random.normal(), 0.01 * random.normal(),
        0.05 * random.normal();
  const double sensor = 4e-3;
  const auto sd = [&] {
    return std::sqrt(evidence_of(study, {series}, packings).series.front().stated(0, 0));
  };
  EXPECT_LT(sd(), 1.5e-3);
  series.sensors = Eigen::Vector3d(sensor * sensor, 0, 0);
  EXPECT_GT(sd(), 0.9 * sensor);
  EXPECT_LT(sd(), 2 * sensor);
}

}  // namespace
}  // namespace bondlab::diagnose
