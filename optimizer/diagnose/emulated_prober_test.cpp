// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/emulated_prober.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/row_selection.h"
#include "diagnose/parameter_step.h"
#include "diagnose/straight_model_for_tests.h"

namespace bondlab::diagnose {
namespace {

class Emulated : public EmulatedModelTest {
 protected:
  // The centre with a parameter's physical value times a factor.
  ModelPoint scaled(std::size_t parameter, double factor) const {
    ModelPoint out = engine.start();
    auto x = engine.physical(out);
    x[parameter] *= factor;
    out.z(static_cast<Eigen::Index>(parameter)) = engine.space().to_transformed({x}).z[parameter];
    return out;
  }
};

TEST_F(Emulated, PowerLawsOfParametersAreExactWithinAndBeyondTheSteps) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan, false);
  const auto base = emulated.probe({engine.start()}).front();
  for (const double factor : {0.8, 0.95, 1.05, 1.1}) {
    const auto rows = emulated.probe({scaled(sigma_c, factor)}).front();
    EXPECT_NEAR(rows(ucs_peak) - base(ucs_peak), std::log(factor), 1e-9) << factor;
    EXPECT_NEAR(rows(ucs_slope), base(ucs_slope), 1e-9) << factor;
  }
}

TEST_F(Emulated, CentreIsTheMeanOverAllItsPackings) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan, false);
  const auto rows = emulated.probe({engine.start()}).front();
  const double sigma = engine.physical(engine.start())[sigma_c];
  EXPECT_NEAR(rows(ucs_peak), std::log(sigma * (1 + gap / gap_scale)) + 3.5 * by_packing, 1e-12);
}

// The peak bends with the gap: log(1 + g) at two sizes is a parabola.
TEST_F(Emulated, EffectIsExactAtTheSizesThatWereRun) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto base = emulated.probe({engine.start()}).front();
  for (const double amplitude : {-1.0, 1.0, 2.0}) {
    const double added = switch_on("bond_gap") * amplitude;
    const auto rows = emulated.probe({with(engine.start(), "bond_gap", amplitude)}).front();
    const double now = (gap * (1 + added) + gap_scale) / (gap + gap_scale);
    EXPECT_NEAR(rows(ucs_peak) - base(ucs_peak), std::log(now), 1e-9) << amplitude;
  }
}

TEST_F(Emulated, ProbingAsksForNoRun) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto made = model.batches.size();
  emulated.probe({with(engine.start(), "bond_gap", 0.3), scaled(sigma_c, 1.03)});
  emulated.uncertainty(with(engine.start(), "bond_gap", 0.3));
  EXPECT_EQ(model.batches.size(), made);
}

TEST_F(Emulated, SmoothModelHasNoUncertainty) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  EXPECT_LT(emulated.uncertainty(with(engine.start(), "bond_gap", 1)).norm(), 1e-18);
}

TEST_F(Emulated, UncertaintyIsWhatOtherNoiseWouldChange) {
  model.chaos = 0.02;
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  EXPECT_EQ(emulated.uncertainty(engine.start()).norm(), 0);
  // Noise at a knot and at the centre, six packings, widened by 5/3.
  const auto at = with(engine.start(), "bond_gap", 2);
  const double expected = model.chaos * std::sqrt(2.0 / 6 * 5 / 3);
  const double found = std::sqrt(emulated.uncertainty(at)(ucs_peak, ucs_peak));
  EXPECT_GT(found, 0.4 * expected);
  EXPECT_LT(found, 2.5 * expected);
  EXPECT_EQ(emulated.uncertainty(at)(ucs_slope, ucs_peak),
            emulated.uncertainty(at)(ucs_peak, ucs_slope));
  EXPECT_EQ(emulated.uncertainty(at)(ucs_peak, brazilian_peak), 0) << "series are independent";
}

// Rows of an effect that does nothing (Brazilian platens, in compression) must not keep what
// packings make of them by chance, and rows that change must not lose their change.
TEST_F(Emulated, WhatChanceMakesOfARowIsTakenOffItsMeanAndLeftInItsChanges) {
  model.chaos = 0.02;
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto base = emulated.probe({engine.start()}).front();
  double kept = 0, raw = 0;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    if (effects[k].name == "bond_gap" || !effects[k].scales_test.empty()) continue;
    const auto at = with(engine.start(), effects[k].name, 1);
    const auto rows = emulated.probe({at}).front();
    if (!rows.allFinite()) continue;
    kept += std::pow(rows(ucs_peak) - base(ucs_peak), 2);
    raw += std::pow(emulated.changes(at).col(ucs_peak).mean(), 2);
  }
  ASSERT_GT(raw, 0);
  EXPECT_LT(kept, 0.45 * raw);
  const auto gap_on = with(engine.start(), "bond_gap", 2);
  EXPECT_NEAR(emulated.probe({gap_on}).front()(ucs_peak) - base(ucs_peak),
              emulated.changes(gap_on).col(ucs_peak).mean(), 0.01);
}

TEST_F(Emulated, ConfirmIsTheEngineOnTheSamePackings) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto at = with(scaled(sigma_c, 1.07), "bond_gap", 1.4);
  const auto rows = emulated.confirm({at}).front();
  const double sigma = 1.07 * engine.physical(engine.start())[sigma_c];
  const double now = gap * (1 + 1.4 * switch_on("bond_gap"));
  // Packings 0 to 5 change alike, the mean stays that of packings 0 to 7.
  EXPECT_NEAR(rows(ucs_peak), std::log(sigma * (1 + now / gap_scale)) + 3.5 * by_packing, 1e-9);
}

TEST_F(Emulated, EnginesChangesAreThoseOfThePackingsThatEffectsAreSwitchedOnOn) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto at = with(engine.start(), "bond_gap", 1.4);
  const double now = gap * (1 + 1.4 * switch_on("bond_gap"));
  const Eigen::MatrixXd changes = emulated.engine_changes(at);
  ASSERT_EQ(changes.rows(), plan.differences);
  for (Eigen::Index p = 0; p < changes.rows(); ++p)
    EXPECT_NEAR(changes(p, ucs_peak), std::log((1 + now / gap_scale) / (1 + gap / gap_scale)),
                1e-9);
  // A test that gives nothing there is taken not to change.
  model.failing = "brazilian";
  const Eigen::MatrixXd some = emulated.engine_changes(with(engine.start(), "bond_gap", 1.7));
  EXPECT_TRUE(some.allFinite());
  EXPECT_EQ(some.col(brazilian_peak).norm(), 0);
  EXPECT_GT(some.col(ucs_peak).norm(), 0.01);
}

TEST_F(Emulated, RenewedEffectIsTakenAtItsNewSize) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto k = static_cast<std::size_t>(index("bond_gap"));
  EXPECT_TRUE(emulated.covers(k, 2));
  EXPECT_FALSE(emulated.covers(k, 4));
  const double grown = 2 * catalogue[k].switch_on;
  catalogue[k].switch_on = grown;
  engine.rescale(k, grown);
  emulated.renew(k, catalogue[k]);
  const auto base = emulated.probe({engine.start()}).front();
  const auto rows = emulated.probe({with(engine.start(), "bond_gap", 1)}).front();
  const double now = (gap * (1 + grown) + gap_scale) / (gap + gap_scale);
  EXPECT_NEAR(rows(ucs_peak) - base(ucs_peak), std::log(now), 1e-9);
  EXPECT_GT(rows(ucs_peak) - base(ucs_peak), 0.1);
}

TEST_F(Emulated, StepsComeFromTheNoise) {
  plan.steps.clear();
  const EmulatedProber quiet(engine, catalogue, engine.start(), plan, false);
  for (const auto k : {E_c, sigma_c}) EXPECT_EQ(quiet.steps()[k], smallest_parameter_step);
  EXPECT_EQ(quiet.steps()[kn_ks], largest_parameter_step) << "these tests don't see it";
  model.chaos = 0.01;
  ForwardProber noisy(study, effects, model, series, {0, 1, 2, 3, 4, 5, 6, 7});
  const EmulatedProber emulated(noisy, catalogue, engine.start(), plan, false);
  for (const auto k : {E_c, sigma_c}) {
    EXPECT_GT(emulated.steps()[k], 2 * smallest_parameter_step);
    EXPECT_LE(emulated.steps()[k], largest_parameter_step);
  }
  const double x = emulated.steps()[sigma_c];
  EXPECT_TRUE(emulated.covers(scaled(sigma_c, std::exp(1.9 * x))));
  EXPECT_FALSE(emulated.covers(scaled(sigma_c, std::exp(2.1 * x))));
}

TEST_F(Emulated, StepsGivenNeedNoPilot) {
  const auto runs = [&] {
    ForwardProber fresh(study, effects, model, series, {0, 1, 2, 3, 4, 5, 6, 7});
    const EmulatedProber made(fresh, catalogue, fresh.start(), plan, false);
    return fresh.runs();
  };
  const int given = runs();
  plan.steps.clear();
  // Three parameters up and down on six packings of two tests.
  EXPECT_EQ(runs() - given, 3 * 2 * 6 * 2);
}

TEST_F(Emulated, CentreMovesOnlyAsFarAsStepsCanBeTrusted) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan, false);
  EXPECT_TRUE(emulated.covers(scaled(sigma_c, 1.2)));
  EXPECT_FALSE(emulated.covers(scaled(sigma_c, 1.4)));
  const auto x = engine.physical(emulated.towards(scaled(sigma_c, 1.4)));
  EXPECT_NEAR(x[sigma_c], 1.4 * engine.physical(engine.start())[sigma_c], 1e-3 * x[sigma_c]);
  const auto far = engine.physical(emulated.towards(scaled(sigma_c, 1.7)));
  EXPECT_NEAR(far[sigma_c] / engine.physical(engine.start())[sigma_c],
              std::exp(4 * plan.steps[sigma_c]), 1e-6);
}

TEST_F(Emulated, EffectWhoseRunsFailIsDead) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  model.failing = "ucs";
  ForwardProber other(study, effects, model, {series[0]}, {0, 1, 2, 3, 4, 5, 6, 7});
  EmulatedProber none(other, catalogue, engine.start(), plan);
  EXPECT_FALSE(none.probe({with(engine.start(), "bond_gap", 1)}).front().allFinite());
  EXPECT_TRUE(std::isinf(none.trace_noise(static_cast<std::size_t>(index("bond_gap")))));
}

// One packing of eight has no Brazilian peak: the mean is that of the seven, changes are those of
// the packings that have it, and nothing is lost.
TEST_F(Emulated, PackingThatLacksARowLeavesItToTheOthers) {
  const double start = engine.physical(engine.start())[sigma_c];
  model.lacks = [start](const ForwardRequest &request) {
    return request.test == "brazilian" && request.packing == 2 &&
           std::abs(request.variables.at("sigma_c") / start - 1) < 1e-6;
  };
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto base = emulated.probe({engine.start()}).front();
  ASSERT_TRUE(base.allFinite());
  EXPECT_NEAR(base(brazilian_peak) - base(ucs_peak), ((28 - 2) / 7.0 - 3.5) * by_packing, 1e-12);
  const auto at = with(scaled(sigma_c, 1.05), "bond_gap", 2);
  const double now = (gap * (1 + 2 * switch_on("bond_gap")) + gap_scale) / (gap + gap_scale);
  const double change = std::log(1.05 * now);
  EXPECT_NEAR(emulated.probe({at}).front()(brazilian_peak) - base(brazilian_peak), change, 1e-9);
  EXPECT_NEAR(emulated.confirm({at}).front()(brazilian_peak) - base(brazilian_peak), change, 1e-9);
  const Eigen::MatrixXd changes = emulated.engine_changes(at);
  EXPECT_NEAR(changes(2, brazilian_peak), change, 1e-9);
  // An anchor is made of the packings that have all.
  const auto near = emulated.anchored(at, Anchoring::whole);
  ASSERT_NE(near, nullptr);
  EXPECT_NEAR(near->probe({at}).front()(brazilian_peak) - base(brazilian_peak), change, 1e-9);
}

TEST_F(Emulated, SelectionOfRowsIsTheSameModelWithFewerRows) {
  model.chaos = 0.02;
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  RowSelection some(emulated, {brazilian_peak, ucs_peak});
  const auto at = with(engine.start(), "bond_gap", 1);
  const auto whole = emulated.probe({at}).front(), part = some.probe({at}).front();
  ASSERT_EQ(part.size(), 2);
  EXPECT_EQ(part(0), whole(brazilian_peak));
  EXPECT_EQ(part(1), whole(ucs_peak));
  EXPECT_EQ(some.uncertainty(at)(1, 1), emulated.uncertainty(at)(ucs_peak, ucs_peak));
}

}  // namespace
}  // namespace bondlab::diagnose
