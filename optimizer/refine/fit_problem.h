// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: which targets are fitted with which weights, and the residuals of a point under it.
// Method: rows of misfit/residual.h plus, where a solver needs them, one prior row a parameter: z /
//   prior_sd. The prior is centred at the middle of the bounds and weak; it holds what the data do
//   not fix and keeps a search from running to a bound for nothing (Tikhonov: an extra row instead
//   of a changed cost).
// Units: SI; rows and z have none. Failure: a point with a missing figure has no residual
//   (nullopt).
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "refine/evaluator.h"

namespace bondlab {

struct FitProblem {
  TargetIndices targets;
  std::vector<double> sd;     // weight of each target's row: measurement and noise
  std::vector<double> noise;  // of it, the noise of the simulation; 0: unknown
  double prior_sd = 1.5;
};

// Standardised differences, in the order of problem.targets.
std::optional<Eigen::VectorXd> standardised(const Evaluator &evaluator, const FitProblem &problem,
                                            const TransformedPoint &point, int packing = 0);

// Sum of squares of the above; NaN when a figure is missing.
double misfit(const Evaluator &evaluator, const FitProblem &problem, const TransformedPoint &point,
              int packing = 0);

// What a search compares: the misfit and the prior's rows.
double misfit_with_prior(const Evaluator &evaluator, const FitProblem &problem,
                         const TransformedPoint &point);

Eigen::VectorXd prior_rows(const FitProblem &problem, const TransformedPoint &point);

}  // namespace bondlab
