// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: derivatives of the targets by central differences in one batch of runs, with a step that noise cannot drown.
// Method: the step of a parameter balances two errors of (f(z+h) - f(z-h)) / 2h: noise, s / (sqrt2 h), and curvature,
//   |f'''| h^2 / 6. Summed over the standardised targets the best h is (3 s / |f'''|)^(1/3), with |f'''| taken as half of
//   |f'|, which is what the logit transform itself gives a power law at the middle of its bounds; f' comes from
//   regressions over the runs there are. The step is never below the study's relative step (at least 2 %, where the
//   noise of a discrete specimen begins to hide the slope) and never above 0.8 in z.
//   Failed runs: a column keeps its other side (one-sided difference); a column with no side is frozen, that is zero
//   for this Jacobian, and says so.
// Why not a solver's own differences: they go point by point, in series, with steps near 1e-6. With noise of 1e-3 and steps
//   of 1e-4 a solver claimed success 200 times in 200 starts and was right in none.
// Units: SI per unit of z. Failure: see above; never an exception of its own.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "refine/fit_problem.h"

namespace bondlab {

constexpr double smallest_relative_step = 0.02, largest_z_step = 0.8;

struct Jacobian {
  TransformedPoint point;
  Eigen::MatrixXd rows;      // standardised: targets x parameters
  Eigen::MatrixXd noise_sd;  // of each entry
  std::vector<double> steps; // in z
  std::vector<bool> frozen;  // one a parameter
  std::vector<std::string> notes;
  bool any_frozen() const;
};

// Steps in z about `point`. `slopes` are standardised (targets x parameters), or empty when nothing is known.
std::vector<double> difference_steps(const ParameterSpace &space, const FitProblem &problem,
                                     const TransformedPoint &point, const Eigen::MatrixXd &slopes,
                                     double relative_step);

// Standardised slopes from regressions over all runs there are; empty when a target has too few.
Eigen::MatrixXd regression_slopes(const Evaluator &evaluator, const FitProblem &problem, const TransformedPoint &point);

Jacobian difference_jacobian(Evaluator &evaluator, const FitProblem &problem, const TransformedPoint &point,
                             const std::vector<double> &steps);

}  // namespace bondlab
