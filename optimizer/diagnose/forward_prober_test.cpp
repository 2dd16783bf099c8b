// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/forward_prober.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "diagnose/straight_model_for_tests.h"

namespace bondlab::diagnose {
namespace {

using ProberOverAModel = StraightModelTest;

TEST_F(ProberOverAModel, BaseJacobianAndEffectsAreOneBatchOfDifferentRuns) {
  ForwardProber prober(study, effects, model, series, {0, 1});
  const auto base = prober.start();
  std::vector<ModelPoint> batch = {base};
  for (Eigen::Index i = 0; i < 3; ++i)
    batch.push_back(moved(base, i, prober.parameter_step(static_cast<std::size_t>(i))));
  batch.push_back(with(base, "bond_gap", 1));
  EXPECT_EQ(prober.probe(batch).size(), batch.size());
  ASSERT_EQ(model.batches.size(), 1u);
  EXPECT_EQ(model.batches[0].size(), 5u * 2 * 2);  // points, tests, packings
  std::set<std::tuple<std::string, int, std::map<std::string, double>>> different;
  for (const auto &r : model.batches[0]) different.insert({r.test, r.packing, r.variables});
  EXPECT_EQ(different.size(), model.batches[0].size());
  prober.probe(batch);
  EXPECT_EQ(model.batches.size(), 1u);  // nothing is run again
}

TEST_F(ProberOverAModel, RowsAreTheMeanOverThePackings) {
  ForwardProber prober(study, effects, model, series, {0, 3});
  const auto base = prober.start();
  const auto rows = prober.probe({base}).front();
  const auto x = prober.physical(base);
  ASSERT_EQ(rows.size(), 4);
  EXPECT_NEAR(rows(ucs_slope), -std::log(x[E_c]), 1e-9);
  EXPECT_NEAR(rows(ucs_peak), std::log(x[sigma_c] * (1 + gap / gap_scale)) + 1.5 * by_packing,
              1e-9);
  const auto each = prober.by_packing(base, {0, 3});
  EXPECT_NEAR(each(1, ucs_peak) - each(0, ucs_peak), 3 * by_packing, 1e-9);
}

TEST_F(ProberOverAModel, DerivativesAreThoseOfTheModelInZ) {
  ForwardProber prober(study, effects, model, series, {0, 1, 2});
  const ParameterSpace space(study.parameters);
  const auto base = prober.start();
  const auto x = prober.physical(base);
  const double h = 1e-5;
  const auto rows =
      prober.probe({base, moved(base, E_c, h), moved(base, kn_ks, h), moved(base, sigma_c, h)});
  const auto derivative = [&](std::size_t i) -> Eigen::VectorXd {
    return (rows[i + 1] - rows[0]) / h;
  };
  const auto relative = [&](std::size_t i) {  // d ln x / dz
    return space.dx_dz(i, base.z(static_cast<Eigen::Index>(i))) / x[i];
  };
  EXPECT_NEAR(derivative(E_c)(ucs_slope), -relative(E_c), 1e-4 * relative(E_c));
  EXPECT_NEAR(derivative(E_c)(ucs_peak), 0, 1e-8);
  EXPECT_NEAR(derivative(sigma_c)(brazilian_peak), relative(sigma_c), 1e-4 * relative(sigma_c));
  EXPECT_NEAR(derivative(sigma_c)(brazilian_slope), 0, 1e-8);
  EXPECT_NEAR(derivative(kn_ks).norm(), 0, 1e-8);
  for (std::size_t i = 0; i < 3; ++i)  // the study asks for steps of this share of the value
    EXPECT_NEAR(prober.parameter_step(i) * relative(i), study.options.difference_step, 1e-9);
}

TEST_F(ProberOverAModel, AnAmplitudeCountsInSwitchOnSizes) {
  ForwardProber prober(study, effects, model, series, {0});
  const auto base = prober.start();
  const auto rows = prober.probe({base, with(base, "bond_gap", 2)});
  const double size = 2 * switch_on("bond_gap");
  const double change =
      std::log((1 + gap * (1 + size) / gap_scale) / (1 + gap / gap_scale));
  EXPECT_NEAR(rows[1](ucs_peak) - rows[0](ucs_peak), change, 1e-9);
  EXPECT_NEAR(rows[1](brazilian_peak) - rows[0](brazilian_peak), change, 1e-9);
  EXPECT_NEAR(rows[1](ucs_slope), rows[0](ucs_slope), 1e-9);
}

TEST_F(ProberOverAModel, AConversionScalesTheLoadsOfItsTestWithoutARun) {
  ForwardProber prober(study, effects, model, series, {0});
  const auto base = prober.start();
  const auto rows = prober.probe({base, with(base, "compression_conversion", 1)});
  EXPECT_EQ(prober.runs(), 2);
  const double change = std::log(1 + switch_on("compression_conversion"));
  EXPECT_NEAR(rows[1](ucs_peak) - rows[0](ucs_peak), change, 1e-9);
  EXPECT_NEAR(rows[1](ucs_slope) - rows[0](ucs_slope), -change, 1e-9);
  EXPECT_EQ(rows[1](brazilian_peak), rows[0](brazilian_peak));
}

TEST_F(ProberOverAModel, AWordIsATestOfItsOwnWithTheWordFixed) {
  ForwardProber prober(study, effects, model, series, {0});
  prober.probe({with(prober.start(), "strength_scatter", 1)});
  const std::string name = "ucs+strength_scatter";
  ASSERT_EQ(model.batches.size(), 1u);
  const auto &request = model.batches[0][0];
  EXPECT_EQ(request.test, name);
  EXPECT_NEAR(request.variables.at("strength_spread"), 1 / switch_on("strength_scatter"), 1e-9);
  EXPECT_EQ(study.test(name).variables.at("strength_distribution").word, "weibull");
  EXPECT_EQ(given.test("ucs").variables.count("strength_distribution"), 0u);
}

TEST_F(ProberOverAModel, WhatADeckRefusesIsNotRunAndHasNoRows) {
  ForwardProber prober(study, effects, model, series, {0});
  const auto base = prober.start();
  const double negative_gap = -1.2 / switch_on("bond_gap");
  const auto rows = prober.probe({base, with(base, "bond_gap", negative_gap)});
  EXPECT_EQ(prober.runs(), 2);
  EXPECT_TRUE(rows[0].allFinite());
  for (Eigen::Index i = 0; i < rows[1].size(); ++i) EXPECT_TRUE(std::isnan(rows[1](i)));
}

TEST_F(ProberOverAModel, ARunThatFailsTakesTheRowsOfItsSeriesOnly) {
  model.failing = "brazilian";
  ForwardProber prober(study, effects, model, series, {0, 1});
  const auto rows = prober.probe({prober.start()}).front();
  EXPECT_TRUE(rows.head(2).allFinite());
  EXPECT_TRUE(std::isnan(rows(brazilian_slope)) && std::isnan(rows(brazilian_peak)));
}

TEST(CatalogueOfAStudy, CutsSizesToWhatTheDecksAccept) {
  const std::filesystem::path inputs = std::filesystem::path(BONDLAB_SOURCE_DIR) / "inputs";
  const Study study = read_study(inputs / "studies" / "granite.toml");
  const auto effects = effects_of_study(study, read_effects(inputs / "effects"));
  const auto catalogue = catalogue_of(study, effects);
  for (std::size_t k = 0; k < effects.size(); ++k)
    for (const auto &test : study.tests) {
      auto defaults = plan_run(study, {test.name, {}, 0}).numeric;
      const auto start = ParameterSpace(study.parameters).start().x;
      for (const auto &[name, value] : deck_variables(study, test.name, start))
        defaults[name] = value;
      for (const double share : {catalogue[k].lowest, catalogue[k].largest}) {
        if (share == 0) continue;
        bool touched = false;
        for (const auto &[name, value] : with_effect(effects[k], share, defaults, touched)) {
          const auto variable = test.definition.variables.find(name);
          if (variable != test.definition.variables.end() && value != defaults.at(name)) {
            EXPECT_EQ(why_not_allowed(variable->second, value), "") << effects[k].name << name;
          }
        }
      }
    }
}

// A moment counts whole or less: with beta 1 there is no more of it to be had, only less.
TEST(CatalogueOfAStudy, LetsAMomentCountWholeAtMost) {
  const std::filesystem::path inputs = std::filesystem::path(BONDLAB_SOURCE_DIR) / "inputs";
  const Study study = read_study(inputs / "studies" / "granite.toml");
  const auto effects = read_effects(inputs / "effects");
  const auto catalogue = catalogue_of(study, effects);
  const auto moment = std::find_if(catalogue.begin(), catalogue.end(), [](const auto &entry) {
    return entry.name == "moment_contribution";
  });
  ASSERT_NE(moment, catalogue.end());
  EXPECT_EQ(moment->switch_on, -0.1);
  EXPECT_EQ(std::max(moment->lowest, moment->largest), 0);
  EXPECT_EQ(std::min(moment->lowest, moment->largest), -1);
}

}  // namespace
}  // namespace bondlab::diagnose
