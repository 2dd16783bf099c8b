// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/fit_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "refine/emulator_for_tests.h"
#include "refine/evaluator.h"
#include "refine/fit_plan.h"

namespace bondlab {
namespace {

using testing::granite_law;
using testing::granite_study;
using testing::GraniteEmulator;

// As noisy as a brittle specimen: moduli hardly, strengths by 2 %.
void make_noisy(GraniteEmulator &model, std::uint64_t seed) {
  model.noise_elastic = 5e-4;
  model.noise_strength = 0.02;
  model.packing_scatter = 0.03;
  model.seed = seed;
}

const TargetResult &target(const SingleFit &fit, const std::string &name) {
  return *std::find_if(fit.targets.begin(), fit.targets.end(),
                       [&](const TargetResult &t) { return t.name == name; });
}

const Finding *find(const SingleFit &fit, FindingKind kind) {
  const auto found = std::find_if(fit.findings.begin(), fit.findings.end(),
                                  [&](const Finding &f) { return f.kind == kind; });
  return found == fit.findings.end() ? nullptr : &*found;
}

bool noted(const SingleFit &fit, const std::string &words) {
  return std::any_of(fit.notes.begin(), fit.notes.end(), [&](const std::string &note) {
    return note.find(words) != std::string::npos;
  });
}

TEST(Fit, ThreeTargetsOfGraniteAreMetWithin3PercentUnderNoise) {
  int met = 0;
  constexpr int repeats = 50;
  for (std::uint64_t seed = 1; seed <= repeats; ++seed) {
    Study study = granite_study();
    study.options.seed = seed;
    GraniteEmulator model;
    make_noisy(model, seed);
    const auto result = run_fits(study, {"main"}, model);
    const auto &fit = result.fits.front();
    bool within = true;
    for (const auto &t : fit.targets)
      if (t.in_fit) within = within && std::fabs(t.simulated / t.measured - 1) <= 0.03;
    met += within;
    EXPECT_EQ(fit.all_met, within);
    EXPECT_EQ(fit.verdict.find("cannot be met together"), std::string::npos) << fit.verdict;
    EXPECT_EQ(model.repeated, 0);
    EXPECT_LE(model.runs, expected_runs(study, {"main"}) + 30);
  }
  EXPECT_EQ(met, repeats);
}

TEST(Fit, FourTargetsOfGraniteAreDeclaredIncompatibleInPlainWords) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Study study = granite_study();
    study.options.seed = seed;
    GraniteEmulator model;
    make_noisy(model, seed);
    const auto result = run_fits(study, {}, model);
    ASSERT_EQ(result.fits.size(), 2u);
    const auto &fit = result.fits[1];
    EXPECT_FALSE(fit.all_met);
    EXPECT_TRUE(target(fit, "E").met);
    EXPECT_LT(std::fabs(target(fit, "nu").off()), 0.05);  // pulled by the strengths, within its sd
    EXPECT_LT(target(fit, "UCS").off(), -0.03);
    EXPECT_GT(target(fit, "sigma_t").off(), 0.03);
    const auto *ratio = find(fit, FindingKind::unreachable_ratio);
    ASSERT_NE(ratio, nullptr);
    EXPECT_EQ(ratio->targets, (std::vector<std::string>{"UCS", "sigma_t"}));
    EXPECT_NEAR(ratio->measured, 138.8 / 9.5, 1e-9);
    EXPECT_LT(ratio->high, 11);
    EXPECT_GE(ratio->points, study.options.lhs_points);
    for (const std::string words :
         {"UCS and sigma_t cannot be met together", " of 4 targets of the fit are met",
          "Not met: UCS is", "Not met: sigma_t is", "over all", "measured: 14.6"})
      EXPECT_NE(fit.verdict.find(words), std::string::npos) << words << " not in: " << fit.verdict;
    EXPECT_NE(find(fit, FindingKind::joint_misfit), nullptr);
    EXPECT_TRUE(noted(fit, "they are too small"));
  }
}

TEST(Fit, SecondFitUsesTheRunsOfTheFirst) {
  const Study study = granite_study();
  GraniteEmulator both, alone;
  make_noisy(both, 3);
  make_noisy(alone, 3);
  const auto result = run_fits(study, {}, both);
  run_fits(study, {"trade-off"}, alone);
  EXPECT_EQ(both.repeated, 0);
  EXPECT_LT(result.fits[1].runs.forward, alone.runs);
  EXPECT_EQ(result.fits[0].runs.forward + result.fits[1].runs.forward, both.runs);
  EXPECT_EQ(result.runs.forward, both.runs);
}

TEST(Fit, PredictedTargetIsReportedAndDoesNotSteer) {
  Study study = granite_study();
  GraniteEmulator model;
  const auto before = run_fits(study, {"main"}, model).fits.front();
  study.targets[3].value *= 2;
  GraniteEmulator other;
  const auto after = run_fits(study, {"main"}, other).fits.front();
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(before.parameters[k].value, after.parameters[k].value);
  EXPECT_FALSE(target(before, "sigma_t").in_fit);
  EXPECT_NE(before.verdict.find("Predicted, not fitted: sigma_t"), std::string::npos);
}

TEST(Fit, OtherPackingsGiveMeanAndScatter) {
  Study study = granite_study();
  study.options.packings = 40;
  GraniteEmulator model;
  model.packing_scatter = 0.03;
  const auto fit = run_fits(study, {"main"}, model).fits.front();
  ASSERT_EQ(fit.packings.size(), 4u);
  EXPECT_EQ(fit.packings[2].values.size(), 40u);
  EXPECT_NEAR(fit.packings[2].sd / fit.packings[2].mean, 0.03, 0.01);
  EXPECT_EQ(target(fit, "UCS").packing_sd, fit.packings[2].sd);
  // The packings' scatter enters the uncertainty of sigma_c: sqrt(5^2 + 3^2) % on UCS instead of 5
  // %.
  study.options.packings = 0;
  GraniteEmulator single;
  const auto without = run_fits(study, {"main"}, single).fits.front();
  EXPECT_GT(fit.parameters[2].sd, 1.08 * without.parameters[2].sd);
}

TEST(Fit, SameStudyAndSameOutcomesGiveTheSameBits) {
  const Study study = granite_study();
  GraniteEmulator first, second;
  make_noisy(first, 9);
  make_noisy(second, 9);
  const auto a = run_fits(study, {}, first), b = run_fits(study, {}, second);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(a.fits[f].misfit, b.fits[f].misfit);
    EXPECT_EQ(a.fits[f].verdict, b.fits[f].verdict);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(a.fits[f].parameters[k].value, b.fits[f].parameters[k].value);
      EXPECT_EQ(a.fits[f].parameters[k].sd, b.fits[f].parameters[k].sd);
    }
  }
}

TEST(Fit, SimulatedFiguresAreThoseOfARunThatWasMade) {
  const Study study = granite_study();
  GraniteEmulator model;
  make_noisy(model, 5);
  const auto result = run_fits(study, {"main"}, model);
  const auto &fit = result.fits.front();
  std::vector<double> values;
  for (const auto &parameter : fit.parameters) values.push_back(parameter.value);
  const auto point = std::find_if(result.ledger.begin(), result.ledger.end(),
                                  [&](const LedgerPoint &p) { return p.parameters == values; });
  ASSERT_NE(point, result.ledger.end());
  for (const auto &t : fit.targets) EXPECT_EQ(point->responses.at(t.name), t.simulated);
  EXPECT_EQ(fit.best.size(), 2u);
}

TEST(Fit, HistoryFallsAndProgressCountsUpToTheEnd) {
  const Study study = granite_study();
  GraniteEmulator model;
  make_noisy(model, 6);
  int last = 0, checkpoints = 0;
  const auto result = run_fits(
      study, {}, model,
      [&](const FitProgress &progress) {
        EXPECT_GE(progress.runs_done, last);
        EXPECT_GE(progress.runs_expected, progress.runs_done);
        last = progress.runs_done;
      },
      [&](const FitResult &so_far) {
        EXPECT_EQ(so_far.fits.size(), static_cast<std::size_t>(++checkpoints));
      });
  EXPECT_EQ(last, result.runs.forward);
  EXPECT_EQ(checkpoints, 2);
  for (const auto &fit : result.fits)
    for (std::size_t i = 1; i < fit.history.size(); ++i) {
      EXPECT_LE(fit.history[i].best_misfit, fit.history[i - 1].best_misfit);
      EXPECT_GE(fit.history[i].runs, fit.history[i - 1].runs);
    }
}

// Each phase of a fit with a run that fails in it: the fit goes on, says so, and still arrives.
TEST(Fit, OneFailureInAnyRunIsSurvivedAndReported) {
  const Study study = granite_study();
  GraniteEmulator whole;
  make_noisy(whole, 4);
  run_fits(study, {"main"}, whole);
  int survived = 0;
  for (int failing = 1; failing <= whole.runs; ++failing) {
    GraniteEmulator model;
    make_noisy(model, 4);
    int run = 0;
    model.fail = [&](const ForwardRequest &) {
      return ++run == failing ? FailureCause::lost_atoms : FailureCause::none;
    };
    const auto fit = run_fits(study, {"main"}, model).fits.front();
    EXPECT_NE(find(fit, FindingKind::failure), nullptr) << "run " << failing;
    EXPECT_EQ(fit.runs.failed, 1);
    survived += fit.all_met;
    for (const auto &t : fit.targets)
      EXPECT_TRUE(std::isfinite(t.simulated) || !t.why_missing.empty());
  }
  EXPECT_EQ(survived, whole.runs);
}

TEST(Fit, BestDesignPointThatFailsMakesTheNextBestTheStart) {
  Study study = granite_study();
  GraniteEmulator model;
  // A fifth of the space fails: all points with a low sigma_c.
  study.options.max_failed = 100;
  model.fail = [](const ForwardRequest &request) {
    return request.variables.at("sigma_c") < 20e6 ? FailureCause::timeout : FailureCause::none;
  };
  const auto fit = run_fits(study, {"main"}, model).fits.front();
  EXPECT_TRUE(fit.all_met) << fit.verdict;
  EXPECT_GT(fit.runs.failed, 0);
}

TEST(Fit, CurvesThatEndTooEarlyCountAsPointsWithoutFigures) {
  Study study = granite_study();
  GraniteEmulator model;
  model.unfinished = [](const ForwardRequest &request) {
    return request.variables.at("E_c") > 35e9;
  };
  const auto fit = run_fits(study, {"main"}, model).fits.front();
  EXPECT_TRUE(fit.all_met) << fit.verdict;
  EXPECT_EQ(fit.runs.failed, 0);  // the runs themselves were good
}

TEST(Fit, TooManyFailuresEndItAndNameTheRuns) {
  Study study = granite_study();
  study.options.max_failed = 3;
  GraniteEmulator model;
  int run = 0;
  model.fail = [&](const ForwardRequest &) {
    return ++run % 3 == 0 ? FailureCause::engine_crash : FailureCause::none;
  };
  try {
    run_fits(study, {"main"}, model);
    FAIL() << "no error";
  } catch (const FitFailed &error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("max_failed"), std::string::npos) << text;
    EXPECT_NE(text.find("planted failure"), std::string::npos) << text;
    EXPECT_NE(text.find("runs/"), std::string::npos) << text;
  }
}

TEST(Fit, NoDesignPointWithAFigureIsAnErrorThatSaysWhy) {
  Study study = granite_study();
  GraniteEmulator model;
  model.unfinished = [](const ForwardRequest &) { return true; };
  try {
    run_fits(study, {"main"}, model);
    FAIL() << "no error";
  } catch (const FitFailed &error) {
    EXPECT_NE(std::string(error.what()).find("test_not_finished"), std::string::npos)
        << error.what();
  }
}

TEST(Fit, PackingThatFailsIsCountedAndTheRestIsUsed) {
  Study study = granite_study();
  GraniteEmulator model;
  model.fail = [](const ForwardRequest &request) {
    return request.packing == 2 && request.test == "ucs" ? FailureCause::specimen
                                                         : FailureCause::none;
  };
  const auto fit = run_fits(study, {"main"}, model).fits.front();
  EXPECT_EQ(fit.packings[2].failed, 1);
  EXPECT_EQ(fit.packings[2].values.size(), 2u);
  EXPECT_EQ(fit.packings[3].failed, 0);
}

// E and nu do not know sigma_c; with UCS left out of the fit the data say nothing about it.
TEST(Fit, ParameterThatNoTargetDependsOnIsNotIdentifiable) {
  Study study = granite_study();
  study.fits[0].targets = {"E", "nu"};
  study.fits[0].predicted = {};
  GraniteEmulator model;
  model.noise_elastic = 5e-4;
  const auto fit = run_fits(study, {"main"}, model).fits.front();
  EXPECT_TRUE(fit.parameters[0].identifiable);
  EXPECT_TRUE(fit.parameters[1].identifiable);
  EXPECT_FALSE(fit.parameters[2].identifiable);
  EXPECT_FALSE(fit.parameters[2].reason.empty());
  EXPECT_TRUE(std::isnan(fit.parameters[2].sd));
}

// A planted ridge: the responses know only the product of E_c and k.
TEST(Fit, PlantedRidgeIsNamedAndItsParametersAreNotIdentifiable) {
  Study study = granite_study();
  GraniteEmulator model;
  model.law = [](const std::map<std::string, double> &v) {
    return granite_law(v.at("E_c") * v.at("kn_ks") / 2, 2, v.at("sigma_c"));
  };
  study.targets[1].value = granite_law(2e10, 2, 3e7).nu;  // a target that the law meets
  const auto fit = run_fits(study, {"main"}, model).fits.front();
  EXPECT_FALSE(fit.parameters[0].identifiable);
  EXPECT_FALSE(fit.parameters[1].identifiable);
  EXPECT_TRUE(fit.parameters[2].identifiable);
  const auto *ridge = find(fit, FindingKind::ridge);
  ASSERT_NE(ridge, nullptr);
  EXPECT_NE(ridge->text.find("E_c"), std::string::npos) << ridge->text;
  EXPECT_NE(ridge->text.find("kn_ks"), std::string::npos) << ridge->text;
  EXPECT_EQ(ridge->text.find("sigma_c"), std::string::npos) << ridge->text;
}

TEST(Fit, OptimumBeyondTheBoundsIsReportedAtTheBound) {
  Study study = granite_study();
  study.parameters[2].upper = 28e6;  // 37 MPa would be needed
  study.options.prior_sd = 5;        // a weak prior lets it run there
  GraniteEmulator model;
  const auto fit = run_fits(study, {"main"}, model).fits.front();
  EXPECT_FALSE(fit.all_met);
  const auto &sigma_c = fit.parameters[2];
  EXPECT_EQ(sigma_c.at_bound, BoundSide::upper);
  EXPECT_FALSE(sigma_c.identifiable);
  EXPECT_NE(sigma_c.reason.find("beyond it"), std::string::npos) << sigma_c.reason;
  EXPECT_NE(find(fit, FindingKind::at_bound), nullptr);
  EXPECT_NE(find(fit, FindingKind::unreachable_target), nullptr) << fit.verdict;
}

// The reported 95 % intervals hold the truth in 95 % of the cases: data scatter by their sd, runs
// by their noise.
TEST(FitCoverage, IntervalsHoldThePlantedParameters) {
  constexpr int repeats = 300;
  RandomStream random(42);
  std::map<std::string, int> inside, inside_two_sd, judged;
  for (int repeat = 1; repeat <= repeats; ++repeat) {
    Study study = granite_study();
    study.options.seed = static_cast<std::uint64_t>(repeat);
    study.options.packings = 0;
    std::vector<double> truth;
    for (const auto &parameter : study.parameters)
      truth.push_back(parameter.lower *
                      std::pow(parameter.upper / parameter.lower, random.uniform(0.2, 0.8)));
    const auto figures = granite_law(truth[0], truth[1], truth[2]);
    const double values[] = {figures.E, figures.nu, figures.UCS, figures.sigma_t};
    for (std::size_t t = 0; t < 4; ++t) {
      study.targets[t].sd *= values[t] / study.targets[t].value;
      study.targets[t].value = values[t] + study.targets[t].sd * random.normal();
    }
    GraniteEmulator model;
    make_noisy(model, static_cast<std::uint64_t>(repeat));
    const auto fit = run_fits(study, {"main"}, model).fits.front();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &parameter = fit.parameters[k];
      if (!parameter.identifiable) continue;
      ++judged[parameter.name];
      inside[parameter.name] +=
          parameter.interval_lower <= truth[k] && truth[k] <= parameter.interval_upper;
      inside_two_sd[parameter.name] += std::fabs(parameter.value - truth[k]) <= 2 * parameter.sd;
    }
  }
  for (const auto &entry : judged) {
    const double n = entry.second;
    EXPECT_GE(n, 0.99 * repeats) << entry.first;
    EXPECT_NEAR(inside[entry.first] / n, 0.95, 0.03) << entry.first;  // 2.4 sd of the binomial
    EXPECT_NEAR(inside_two_sd[entry.first] / n, 0.95, 0.03) << entry.first;
  }
}

}  // namespace
}  // namespace bondlab
