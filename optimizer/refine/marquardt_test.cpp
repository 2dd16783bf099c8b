// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/marquardt.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <cmath>

#include "refine/emulator_for_tests.h"

namespace bondlab {
namespace {

using testing::granite_study;
using testing::GraniteEmulator;
using testing::MacroFigures;

// Curved in every direction, so that neither a plane nor a power law is exact.
MacroFigures curved_law(const std::map<std::string, double> &v) {
  const double e = v.at("E_c") / 1e9, k = v.at("kn_ks"), s = v.at("sigma_c") / 1e6;
  return {3.2e9 * e / (1 + 0.12 * std::sqrt(e) * std::pow(k, 0.4)),
          0.42 * (1 - std::exp(-0.42 * k)) * std::pow(e / 25, 0.05),
          9e6 * s / (1 + 0.05 * s) * std::pow(k, -0.3) * std::pow(e, 0.12),
          0.6e6 * s / (1 + 0.004 * s) * std::pow(k, -0.25)};
}

// One problem with everything it needs, kept together because the parts refer to each other.
struct Bench {
  Study study = granite_study();
  GraniteEmulator model;
  ParameterSpace space{study.parameters};
  Evaluator evaluator{study, space, model};
  FitProblem problem;

  explicit Bench(int targets = 3) {
    model.law = curved_law;
    for (int i = 0; i < targets; ++i) problem.targets.push_back(static_cast<std::size_t>(i));
    weigh();
  }
  void weigh() {
    problem.sd.clear();
    problem.noise.clear();
    for (const std::size_t i : problem.targets) {
      const double noise =
          (i < 2 ? model.noise_elastic : model.noise_strength) * study.targets[i].value;
      problem.noise.push_back(noise);
      problem.sd.push_back(combined_sd(study.targets[i].sd, noise));
    }
  }
  // Targets that the given parameters meet exactly.
  void plant(const std::vector<double> &u) {
    const auto x = space.from_unit_cube(u).x;
    const auto f = curved_law({{"E_c", x[0]}, {"kn_ks", x[1]}, {"sigma_c", x[2]}});
    const double values[] = {f.E, f.nu, f.UCS, f.sigma_t};
    for (std::size_t i = 0; i < 4; ++i) {
      study.targets[i].sd *= values[i] / study.targets[i].value;
      study.targets[i].value = values[i];
    }
    weigh();
  }
  TransformedPoint at(const std::vector<double> &u) const {
    return space.to_transformed(space.from_unit_cube(u));
  }
};

TransformedPoint random_start(const Bench &bench, RandomStream &random) {
  return bench.at(
      {random.uniform(0.03, 0.97), random.uniform(0.03, 0.97), random.uniform(0.03, 0.97)});
}

// The same sum of squares in closed form, for Ceres with its own derivatives.
struct Reference {
  const Bench &bench;
  bool operator()(double const *const *parameters, double *residuals) const {
    const TransformedPoint point{{parameters[0][0], parameters[0][1], parameters[0][2]}};
    const auto x = bench.space.to_physical(point).x;
    const auto f = curved_law({{"E_c", x[0]}, {"kn_ks", x[1]}, {"sigma_c", x[2]}});
    const double values[] = {f.E, f.nu, f.UCS, f.sigma_t};
    const std::size_t n = bench.problem.targets.size();
    for (std::size_t i = 0; i < n; ++i)
      residuals[i] = (values[i] - bench.study.targets[i].value) / bench.problem.sd[i];
    for (std::size_t k = 0; k < 3; ++k) residuals[n + k] = point.z[k] / bench.problem.prior_sd;
    return true;
  }
};

double reference_cost(const Bench &bench) {
  double z[3] = {0, 0, 0};
  auto *cost = new ceres::DynamicNumericDiffCostFunction<Reference>(new Reference{bench});
  cost->AddParameterBlock(3);
  cost->SetNumResiduals(static_cast<int>(bench.problem.targets.size()) + 3);
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, z);
  ceres::Solver::Options options;
  options.max_num_iterations = 500;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-15;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return 2 * summary.final_cost;
}

TEST(Marquardt, ReachesTheReferenceMinimumWithFewRunsAndNoneTwice) {
  RandomStream random(3);
  double worst = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    Bench bench(4);  // four targets, three parameters: the misfit at the minimum is not zero
    MarquardtOptions options;
    options.max_iterations = 60;
    options.relative_step = 0.02;
    options.immaterial = {2e-4, 0};
    options.keep_jacobian = false;
    const auto found =
        marquardt(bench.evaluator, bench.problem, random_start(bench, random), options);
    ASSERT_TRUE(found.converged) << found.ended;
    const double reference = reference_cost(bench);
    const double cost = misfit_with_prior(bench.evaluator, bench.problem, found.point);
    worst = std::max(worst, std::fabs(cost / reference - 1));
    EXPECT_EQ(bench.model.repeated, 0);
    // start + trial points + one Jacobian at the start and after each accepted step; two tests a
    // point
    const int needed = 1 + found.trials + 2 * 3 * (1 + found.accepted);
    EXPECT_LE(bench.model.runs, 2 * 1.15 * needed);
    EXPECT_EQ(bench.model.largest_batch, 2 * 6);
  }
  EXPECT_LE(worst, 1e-6);
}

TEST(Marquardt, KeepingTheJacobianSavesRunsAndChangesNoResult) {
  int kept = 0, fresh = 0;
  for (const bool keep : {true, false}) {
    RandomStream random(4);
    for (int repeat = 0; repeat < 20; ++repeat) {
      Bench bench;
      bench.plant({0.4, 0.5, 0.6});
      MarquardtOptions options;
      options.max_iterations = 30;
      options.keep_jacobian = keep;
      options.relative_step = 0.15;  // as wide as noise makes it
      const auto found =
          marquardt(bench.evaluator, bench.problem, random_start(bench, random), options);
      EXPECT_TRUE(found.converged) << found.ended;
      EXPECT_LT(misfit(bench.evaluator, bench.problem, found.point), 0.2);
      (keep ? kept : fresh) += bench.model.runs;
    }
  }
  EXPECT_LT(kept, fresh);
}

// Noise of 1e-3 of the signal, 200 starts: nearly all end right, and none claims a success that is
// not there.
TEST(Marquardt, UnderNoiseMostStartsEndRightAndNoneClaimsFalsely) {
  RandomStream random(5);
  int right = 0, false_claims = 0;
  constexpr int starts = 200;
  for (int start = 0; start < starts; ++start) {
    Bench bench;
    bench.model.noise_elastic = bench.model.noise_strength = 1e-3;
    bench.model.seed = static_cast<std::uint64_t>(start + 1);
    bench.plant({0.4, 0.5, 0.6});
    MarquardtOptions options;
    options.max_iterations = 30;
    const auto found =
        marquardt(bench.evaluator, bench.problem, random_start(bench, random), options);
    // Right: no target is off by more than a third of its sd (the prior alone moves them by up to
    // 0.05 sd).
    const auto rows = standardised(bench.evaluator, bench.problem, found.point);
    const bool good = rows && rows->cwiseAbs().maxCoeff() < 0.33;
    right += good;
    false_claims += found.converged && !good;
  }
  EXPECT_GE(right, 190);
  EXPECT_EQ(false_claims, 0);
}

// The same with the noise of strengths in a brittle specimen.
TEST(Marquardt, UnderStrengthNoiseOf2PercentNoneClaimsFalsely) {
  RandomStream random(6);
  int right = 0, false_claims = 0;
  constexpr int starts = 200;
  for (int start = 0; start < starts; ++start) {
    Bench bench;
    bench.model.noise_elastic = 5e-4;
    bench.model.noise_strength = 0.02;
    bench.model.seed = static_cast<std::uint64_t>(start + 1);
    bench.plant({0.4, 0.5, 0.6});
    MarquardtOptions options;
    options.max_iterations = 30;
    const auto found =
        marquardt(bench.evaluator, bench.problem, random_start(bench, random), options);
    const auto rows = standardised(bench.evaluator, bench.problem, found.point);
    // Strength: three sd of its noise (2 % of 5.4 %) are 1.1; moduli as above, and what the noise
    // allows as gain.
    const bool good =
        rows && std::fabs((*rows)(2)) < 1.3 && rows->head(2).cwiseAbs().maxCoeff() < 0.6;
    right += good;
    false_claims += found.converged && !good;
  }
  EXPECT_GE(right, 180);
  EXPECT_EQ(false_claims, 0);
}

TEST(Marquardt, WrongBranchesAreNotCalledConverged) {
  // Two iterations from a far corner can't arrive; the search must say so.
  Bench bench;
  bench.plant({0.8, 0.2, 0.9});
  MarquardtOptions options;
  options.max_iterations = 1;
  const auto found =
      marquardt(bench.evaluator, bench.problem, bench.at({0.03, 0.97, 0.03}), options);
  EXPECT_FALSE(found.converged);
  EXPECT_NE(found.ended.find("limit of 1 steps"), std::string::npos);
}

TEST(Marquardt, FailedStartIsReportedAndNothingElseIsRun) {
  Bench bench;
  bench.study.options.max_failed = 5;
  bench.model.fail = [](const ForwardRequest &) { return FailureCause::lost_atoms; };
  const auto found = marquardt(bench.evaluator, bench.problem, bench.at({0.5, 0.5, 0.5}), {});
  EXPECT_FALSE(found.started);
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(bench.model.runs, 1);
}

TEST(Marquardt, FailedTrialPointIsTakenBackAndTheSearchArrives) {
  Bench bench;
  bench.study.options.max_failed = 5;
  bench.plant({0.45, 0.5, 0.55});
  int trials = 0;
  bench.model.fail = [&](const ForwardRequest &) {
    // The first trial point is the 8th run: start, six derivatives, trial.
    return ++trials == 8 ? FailureCause::engine_crash : FailureCause::none;
  };
  MarquardtOptions options;
  options.max_iterations = 20;
  const auto found = marquardt(bench.evaluator, bench.problem, bench.at({0.2, 0.8, 0.3}), options);
  EXPECT_TRUE(found.converged) << found.ended;
  EXPECT_LT(misfit(bench.evaluator, bench.problem, found.point), 0.2);
  ASSERT_FALSE(found.notes.empty());
  EXPECT_NE(found.notes.front().find("step taken back"), std::string::npos);
}

TEST(Marquardt, FailureBesideThePointMakesAOneSidedDerivative) {
  Bench bench;
  bench.study.options.max_failed = 5;
  bench.plant({0.45, 0.5, 0.55});
  int runs = 0;
  bench.model.fail = [&](const ForwardRequest &) {
    return ++runs == 2 ? FailureCause::timeout : FailureCause::none;
  };
  MarquardtOptions options;
  options.max_iterations = 20;
  const auto found = marquardt(bench.evaluator, bench.problem, bench.at({0.2, 0.8, 0.3}), options);
  EXPECT_TRUE(found.converged) << found.ended;
  EXPECT_LT(misfit(bench.evaluator, bench.problem, found.point), 0.2);
  ASSERT_FALSE(found.notes.empty());
  EXPECT_NE(found.notes.front().find("one-sided"), std::string::npos);
}

TEST(Marquardt, ParameterWithoutADerivativeIsHeldAndNoSuccessIsClaimed) {
  Bench bench;
  bench.study.options.max_failed = 1000;
  bench.plant({0.45, 0.5, 0.55});
  const auto start = bench.at({0.2, 0.8, 0.3});
  const double k = bench.space.to_physical(start).x[1];
  bench.model.fail = [&](const ForwardRequest &request) {
    return request.variables.at("kn_ks") != k ? FailureCause::not_a_number : FailureCause::none;
  };
  const auto found = marquardt(bench.evaluator, bench.problem, start, {});
  EXPECT_FALSE(found.converged);
  EXPECT_TRUE(found.jacobian.frozen[1]);
  EXPECT_EQ(bench.space.to_physical(found.point).x[1], k);
  EXPECT_LT(misfit(bench.evaluator, bench.problem, found.point),
            misfit(bench.evaluator, bench.problem, start));
}

TEST(Marquardt, TooManyFailuresEndItThroughTheSolver) {
  Bench bench;
  bench.study.options.max_failed = 2;
  int runs = 0;
  bench.model.fail = [&](const ForwardRequest &) {
    return ++runs > 1 ? FailureCause::timeout : FailureCause::none;
  };
  EXPECT_THROW(marquardt(bench.evaluator, bench.problem, bench.at({0.2, 0.8, 0.3}), {}), FitFailed);
}

}  // namespace
}  // namespace bondlab
