// SPDX-License-Identifier: GPL-2.0-or-later
//
// Cohesion and friction angle of an envelope as targets of a fit, on a shear box in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "refine/emulator_for_tests.h"
#include "refine/evaluator.h"
#include "refine/fit_driver.h"
#include "refine/fit_plan.h"

namespace bondlab {
namespace {

const double kNormal[] = {2e6, 5e6, 10e6};  // Pa, of the tests shear_0, shear_1, shear_2

// Coulomb's strength at a normal stress: c = 0.4 sigma_c, tan(phi) = 1.2 mu.
double strength(double sigma_c, double mu, double normal) {
  return 0.4 * sigma_c + 1.2 * mu * normal;
}

// A curve whose peak is the strength and that has fallen behind it.
class ShearBox : public ForwardModel {
 public:
  int runs = 0;
  std::string fails, ends_early;  // names of tests

  std::vector<ForwardOutcome> run(const std::vector<ForwardRequest> &requests,
                                  std::function<void(const BatchProgress &)>) override {
    std::vector<ForwardOutcome> outcomes;
    for (const ForwardRequest &request : requests) {
      ++runs;
      ForwardOutcome one;
      one.run_id = request.test;
      one.deck_variables = request.variables;
      const double normal = kNormal[request.test.back() - '0'];
      one.deck_variables["normal_stress"] = normal;
      const double peak =
          strength(request.variables.at("sigma_c"), request.variables.at("mu"), normal) *
          (1 + 0.01 * request.packing);
      one.curve.names = {"time", "axial_stress"};
      one.curve.units = {"s", "Pa"};
      one.curve.columns = {{0, 1, 2, 3}, {0, peak / 2, peak, peak / 2}};
      if (request.test == ends_early)
        for (auto &column : one.curve.columns) column.resize(3);
      one.ok = request.test != fails;
      if (!one.ok) {
        one.failure.cause = FailureCause::lost_atoms;
        one.failure.message = "planted failure";
      }
      outcomes.push_back(one);
    }
    return outcomes;
  }
};

Target envelope_target(const std::string &response, const std::string &unit, double value) {
  Target target = testing::make_target(response, "", unit, value, 0.03);
  target.envelope = "peak";
  return target;
}

Study shear_study() {
  Study study;
  study.name = "shear", study.file = "shear.toml";
  EnvelopeEntry envelope;
  envelope.name = "peak", envelope.response = "tau_peak", envelope.over = "normal_stress";
  envelope.unit = "MPa";
  for (const std::string name : {"shear_0", "shear_1", "shear_2"}) {
    TestEntry test;
    test.name = name, test.test = "direct_shear";
    test.definition.responses["tau_peak"] = {"tau_peak", "Pa", "uniaxial.peak_stress", {}};
    for (const std::string variable : {"sigma_c", "mu"})
      test.definition.variables[variable].name = variable;
    study.tests.push_back(test);
    envelope.tests.push_back(name);
  }
  study.envelopes = {envelope};
  study.parameters = {testing::make_parameter("sigma_c", "MPa", 10e6, 80e6),
                      testing::make_parameter("mu", "1", 0.1, 1)};
  study.targets = {envelope_target("cohesion", "MPa", 12e6),
                   envelope_target("friction_angle", "deg", std::atan(0.6))};
  FitEntry fit;
  fit.name = "main", fit.targets = {"cohesion", "friction_angle"};
  study.fits = {fit};
  return study;
}

struct Bench {
  Study study = shear_study();
  ShearBox model;
  ParameterSpace space{study.parameters};
  Evaluator evaluator{study, space, model};
  TransformedPoint middle() const { return space.to_transformed(space.from_unit_cube({0.5, 0.5})); }
};

TEST(EnvelopeTargets, NeedTheRunsOfAllTestsOnce) {
  Bench bench;
  EXPECT_EQ(bench.evaluator.value(bench.middle(), 0).why, "not run");
  bench.evaluator.run({bench.middle()}, {0}, "design");
  EXPECT_EQ(bench.model.runs, 3);
  bench.evaluator.run({bench.middle()}, {0, 1}, "design");
  EXPECT_EQ(bench.model.runs, 3);
  const auto x = bench.space.to_physical(bench.middle()).x;
  EXPECT_NEAR(bench.evaluator.value(bench.middle(), 0).value, 0.4 * x[0], 1e-9 * x[0]);
  EXPECT_NEAR(bench.evaluator.value(bench.middle(), 1).value, std::atan(1.2 * x[1]), 1e-9);
  EXPECT_EQ(bench.evaluator.ledger().at(0).responses.size(), 2u);
}

TEST(EnvelopeTargets, HaveNoFigureWhenATestGivesNoPoint) {
  for (const bool fails : {true, false}) {
    Bench bench;
    (fails ? bench.model.fails : bench.model.ends_early) = "shear_1";
    bench.evaluator.run({bench.middle()}, {0, 1}, "design");
    for (const std::size_t target : {0u, 1u}) {
      const ResponseValue value = bench.evaluator.value(bench.middle(), target);
      EXPECT_FALSE(value.had());
      EXPECT_EQ(value.why.find("the envelope 'peak' lacks the point of shear_1: "), 0u)
          << value.why;
      EXPECT_EQ(value.why.find("planted failure") != std::string::npos, fails) << value.why;
    }
  }
}

TEST(EnvelopeTargets, AreMetByAFit) {
  const Study study = shear_study();
  ShearBox model;
  const SingleFit fit = run_fits(study, {}, model).fits.front();
  EXPECT_TRUE(fit.all_met) << fit.verdict;
  EXPECT_NEAR(fit.parameters.at(0).value / 30e6, 1, 0.03);  // what "met" allows, 3 %
  EXPECT_NEAR(fit.parameters.at(1).value / 0.5, 1,
              0.04);  // of the angle: 3 % of atan(0.6) are 3.9 % of its tangent
  ASSERT_EQ(fit.best.size(), 3u);
  ASSERT_EQ(fit.envelopes.size(), 1u);
  EXPECT_EQ(fit.envelopes[0].points.size(), 3u);
  EXPECT_EQ(fit.envelopes[0].line->cohesion, fit.targets.at(0).simulated);
  EXPECT_EQ(fit.targets.at(0).envelope, "peak");
  // packing k is k % stronger: the cohesion with it
  EXPECT_NEAR(fit.packings.at(0).values.at(2) / fit.packings.at(0).reference, 1.03, 1e-9);
}

TEST(EnvelopeTargets, CountEveryTestInThePlan) {
  const Study study = shear_study();
  const FitPlan plan = plan_of(study, study.fits.front(), true);
  EXPECT_EQ(plan.packings, 3 * study.options.packings);
}

}  // namespace
}  // namespace bondlab
