// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/engine_fit.h"

#include <gtest/gtest.h>

#include <limits>

namespace bondlab::diagnose {
namespace {

// Three rows of one series, sd 0.1; the data are those of the engine at parameter 2.
class OnTheEngine : public ::testing::Test {
 protected:
  OnTheEngine() {
    SeriesEvidence series;
    series.name = series.test = "ucs";
    series.count = 3;
    series.replicates =
        engine({{Eigen::VectorXd::Constant(1, 2.0), Eigen::VectorXd::Zero(1)}}).front().transpose();
    series.stated = Eigen::MatrixXd::Identity(3, 3) * 0.01;
    series.simulated = Eigen::MatrixXd::Zero(3, 3);
    evidence.series = {series};
    evidence.rows.assign(3, {"ucs", "ucs", CurvePart::slope, "row"});
    entry.switch_on = 1, entry.lowest = 0, entry.largest = 1;
    fit.ok = true;
    fit.point = {Eigen::VectorXd::Constant(1, 1.7), Eigen::VectorXd::Zero(1)};
    fit.columns = Eigen::MatrixXd::Constant(3, 1, slope / 0.1);
    fit.covariance = (fit.columns.transpose() * fit.columns).inverse();
  }
  std::vector<Eigen::VectorXd> engine(const std::vector<ModelPoint> &points) {
    std::vector<Eigen::VectorXd> out;
    for (const auto &point : points) {
      ++runs;
      out.push_back(
          Eigen::VectorXd::Constant(3, slope * point.z(0) + bend * point.z(0) * point.z(0)));
    }
    return out;
  }
  EngineFit moved() {
    const Whitening whitening(evidence);
    runs = 0;
    return fit_on_engine(fit, [this](const auto &points) { return engine(points); }, whitening,
                         {entry});
  }
  double slope = 1, bend = 0;
  int runs = 0;
  Evidence evidence;
  EffectEntry entry;
  Refit fit;
};

TEST_F(OnTheEngine, FitGoesWhereTheEngineHasIt) {
  const auto done = moved();
  ASSERT_TRUE(done.ok);
  EXPECT_NEAR(fit.point.z(0), 2, 0.01);  // the damping of 1 in z holds it back by 1 in 300
  EXPECT_GE(done.steps, 1);
  EXPECT_LT(done.chi2, 1e-2 * done.chi2_first);
}

TEST_F(OnTheEngine, FitThatTheEngineAgreesWithCostsOneRun) {
  fit.point.z(0) = 2.001;
  const auto done = moved();
  EXPECT_TRUE(done.ok);
  EXPECT_EQ(done.steps, 0);
  EXPECT_EQ(runs, 1);
  EXPECT_EQ(fit.point.z(0), 2.001);
}

TEST_F(OnTheEngine, StepThatMakesThingsWorseIsNotTaken) {
  fit.columns = -fit.columns;  // a linear model that points the wrong way
  const auto done = moved();
  EXPECT_EQ(done.steps, 0);
  EXPECT_EQ(fit.point.z(0), 1.7);
}

TEST_F(OnTheEngine, EngineWithoutRowsLeavesTheFitAlone) {
  const Whitening whitening(evidence);
  const auto done = fit_on_engine(fit,
                                  [](const auto &) {
                                    return std::vector<Eigen::VectorXd>{Eigen::VectorXd::Constant(
                                        3, std::numeric_limits<double>::quiet_NaN())};
                                  },
                                  whitening, {entry});
  EXPECT_FALSE(done.ok);
  EXPECT_EQ(fit.point.z(0), 1.7);
}

}  // namespace
}  // namespace bondlab::diagnose
