// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: after a search has come down to the noise, find a parameter set whose own run meets the
//   targets.
// Method: near the minimum single runs scatter about the mean response, so that the run at the best
//   mean point may miss a target by chance. A regression weighted towards the best point smooths
//   the scatter; the point it proposes and three neighbours within 0.6 % of it are run, and the
//   best run counts. Up to three rounds, and none when the regression itself says that a target
//   cannot be met. Where targets exclude each other no run meets them all, and the lowest misfit
//   among single runs is a draw of luck: with differences of several sd its scatter is several
//   units. Then the run at the regression's own minimum is taken, unless it is worse than the best
//   run by more than that scatter explains.
// What it is not: a way to a smaller true misfit. It chooses among runs that differ by noise; how
//   many were tried is noted, and the other packings say what the parameter set is worth.
// Units: none in z. Failure: a round without a figure is a round lost.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "refine/marquardt.h"

namespace bondlab {

// |simulated - measured| that counts as met.
double target_tolerance(const Target &target);
constexpr double relative_tolerance = 0.03;
std::string tolerance_in_words();

// Whether every target of the problem is met by the run at the point.
bool all_met(const Evaluator &evaluator, const FitProblem &problem, const TransformedPoint &point);

// The best of all points run: those that meet every target first, then the lower misfit with the
// prior. Nothing when no point has all figures.
std::optional<TransformedPoint> best_point(const Evaluator &evaluator, const FitProblem &problem);

// The run at the minimum of a regression near `best`, if it is as good as `best` within the noise;
// makes that run.
std::optional<TransformedPoint> smooth_minimum(Evaluator &evaluator, const FitProblem &problem,
                                               const TransformedPoint &best);

// Runs more points about `best` until all targets are met or nothing is to be gained. Returns notes
// in plain words.
std::vector<std::string> polish(
    Evaluator &evaluator, const FitProblem &problem, const TransformedPoint &best,
    std::uint64_t seed, const std::function<void(const MarquardtStep &)> &on_step = nullptr);

}  // namespace bondlab
