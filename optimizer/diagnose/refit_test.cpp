// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/refit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bondlab::diagnose {
namespace {

// Two rows, straight in one parameter and one effect: row 0 = z, row 1 = z + amplitude.
class Straight : public Prober {
 public:
  std::size_t parameters() const override { return 1; }
  std::size_t effects() const override { return 1; }
  double parameter_step(std::size_t) const override { return 0.1; }
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override {
    std::vector<Eigen::VectorXd> out;
    for (const auto &point : batch)
      out.push_back(Eigen::Vector2d(point.z(0), point.z(0) + point.amplitude(0)));
    return out;
  }
};

// Both rows have an sd of 0.1, so the amplitude has one of 0.1 sqrt(2) = 0.141; it is 0 to 1.
Refit fit_of(double z, double amplitude) {
  Evidence evidence;
  SeriesEvidence series;
  series.name = series.test = "ucs";
  series.count = 2;
  series.replicates = Eigen::RowVector2d(z, z + amplitude);
  series.stated = 0.01 * Eigen::Matrix2d::Identity();
  series.simulated = Eigen::Matrix2d::Zero();
  evidence.series = {series};
  evidence.rows.assign(2, {"ucs", "ucs", CurvePart::slope, "row"});
  EffectEntry entry;
  entry.switch_on = 1, entry.lowest = 0, entry.largest = 1;
  Straight model;
  const Whitening whitening(evidence);
  const ModelPoint start{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1)};
  return refit(model, whitening, {entry}, linearise(model, whitening, start), {0});
}

TEST(Refit, SizeWithinItsBoundsIsFoundAndAdmissible) {
  const Refit fit = fit_of(0.3, 0.8);
  EXPECT_NEAR(fit.point.z(0), 0.3, 0.004);  // held back by the damping, 1 in 100
  EXPECT_NEAR(fit.point.amplitude(0), 0.8, 0.004);
  EXPECT_FALSE(fit.at_bound[0]);
  EXPECT_EQ(fit.pull[0], 0);
  EXPECT_TRUE(fit.admissible());
}

// Data that ask for 1.2 where 1 is the largest: 1.4 sd, which chance may do.
TEST(Refit, BoundThatChanceMayHavePushedOverIsAdmissible) {
  const Refit fit = fit_of(0.3, 1.2);
  EXPECT_EQ(fit.point.amplitude(0), 1);
  EXPECT_TRUE(fit.at_bound[0]);
  EXPECT_NEAR(fit.pull[0], 0.2 / (0.1 * std::sqrt(2.0)), 0.03);
  EXPECT_TRUE(fit.admissible());
}

TEST(Refit, BoundThatTheRowsAskFarBeyondIsNot) {
  const Refit fit = fit_of(0.3, 1.5);
  EXPECT_EQ(fit.point.amplitude(0), 1);
  EXPECT_NEAR(fit.pull[0], 0.5 / (0.1 * std::sqrt(2.0)), 0.05);
  EXPECT_FALSE(fit.admissible());
}

// An effect held at nothing explains nothing, however little the rows ask for the other sign.
TEST(Refit, BoundAtNothingIsNotAdmissible) {
  const Refit fit = fit_of(0.3, -0.05);
  EXPECT_EQ(fit.point.amplitude(0), 0);
  EXPECT_LT(fit.pull[0], 1);
  EXPECT_FALSE(fit.admissible());
}

}  // namespace
}  // namespace bondlab::diagnose
