// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/polish.h"

#include <fmt/format.h>

#include <cmath>

#include "base/random.h"
#include "refine/noise_floor.h"
#include "refine/propose.h"

namespace bondlab {

namespace {

constexpr int rounds = 3, neighbours = 3;
constexpr double wiggle =
    0.006;  // enough to turn a crack now and then, a fifth of what counts as met
constexpr double reach =
    0.2;  // of the bounds: about the width of the derivatives' steps in a noisy study

}  // namespace

double target_tolerance(const Target &target) {
  // A target of zero has no percent; its own sd is then the only measure there is.
  return target.value != 0 ? relative_tolerance * std::fabs(target.value) : target.sd;
}

std::string tolerance_in_words() {
  return fmt::format(
      "a target is met when the simulated figure lies within {:.0f} % of the measured one",
      100 * relative_tolerance);
}

bool all_met(const Evaluator &evaluator, const FitProblem &problem, const TransformedPoint &point) {
  for (const std::size_t index : problem.targets) {
    const auto &target = evaluator.study().targets[index];
    const auto figure = evaluator.value(point, index);
    if (!figure.had() || std::fabs(figure.value - target.value) > target_tolerance(target))
      return false;
  }
  return true;
}

std::optional<TransformedPoint> best_point(const Evaluator &evaluator, const FitProblem &problem) {
  std::optional<TransformedPoint> best;
  bool best_meets = false;
  double lowest = 0;
  for (const auto &point : evaluator.points()) {
    const double cost = misfit_with_prior(evaluator, problem, point);
    if (std::isnan(cost)) continue;
    const bool meets = all_met(evaluator, problem, point);
    const bool better = !best || (meets != best_meets ? meets : cost < lowest);
    if (!better) continue;
    best = point;
    best_meets = meets;
    lowest = cost;
  }
  return best;
}

std::optional<TransformedPoint> smooth_minimum(Evaluator &evaluator, const FitProblem &problem,
                                               const TransformedPoint &best) {
  const auto proposal = propose_near(evaluator, problem, best, reach);
  if (!proposal) return std::nullopt;
  evaluator.run({proposal->point}, problem.targets, "polish");
  const auto rows = standardised(evaluator, problem, best);
  const double gained = misfit_with_prior(evaluator, problem, proposal->point) -
                        misfit_with_prior(evaluator, problem, best);
  if (!rows || std::isnan(gained)) return std::nullopt;
  double variance = 0;  // of a misfit: each row's square has the variance (2 r f)^2 + 2 f^4
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const double r = (*rows)(static_cast<Eigen::Index>(i)), f = problem.noise[i] / problem.sd[i];
    variance += 4 * r * r * f * f + 2 * f * f * f * f;
  }
  if (gained > 2 * std::sqrt(2 * variance)) return std::nullopt;  // the difference of two misfits
  return proposal->point;
}

std::vector<std::string> polish(Evaluator &evaluator, const FitProblem &problem,
                                const TransformedPoint &best, std::uint64_t seed,
                                const std::function<void(const MarquardtStep &)> &on_step) {
  std::vector<std::string> notes;
  TransformedPoint centre = best;
  int tried = 0;
  for (int round = 0; round < rounds && !all_met(evaluator, problem, centre); ++round) {
    const auto proposal = propose_near(evaluator, problem, centre, reach);
    if (!proposal) {
      notes.push_back("too few runs near the best point for a regression: no last look was taken");
      break;
    }
    bool hopeless = false;
    for (std::size_t i = 0; i < problem.targets.size(); ++i) {
      const auto &target = evaluator.study().targets[problem.targets[i]];
      hopeless = hopeless ||
                 std::fabs(proposal->standardised(static_cast<Eigen::Index>(i))) * problem.sd[i] >
                     target_tolerance(target);
    }
    if (hopeless) {
      if (tried == 0)
        notes.push_back(
            "a regression over the runs near the best point says that no set there meets all "
            "targets: "
            "no last look was taken");
      break;
    }
    auto points = noise_points(evaluator.space(), proposal->point, wiggle, neighbours,
                               hash_ints({seed, static_cast<std::uint64_t>(round + 1)}));
    points.insert(points.begin(), proposal->point);
    evaluator.run(points, problem.targets, "polish");
    tried += static_cast<int>(points.size());
    if (on_step)
      for (const auto &point : points)
        on_step({point, misfit(evaluator, problem, point), false, ""});
    centre = best_point(evaluator, problem).value_or(centre);
  }
  if (tried > 0)
    notes.push_back(fmt::format(
        "{} more parameter sets that differ by little more than the noise were run about the "
        "minimum, because the best run until then missed a target",
        tried));
  return notes;
}

}  // namespace bondlab
