// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: derivatives of the targets by central differences in one batch of runs, with a step that
//   noise cannot drown.
// Method: the step of a parameter balances two errors of (f(z+h) - f(z-h)) / 2h: noise, s / (sqrt2
//   h), and curvature, |f'''| h^2 / 6. Summed over the standardised targets the best h is (3 s /
//   |f'''|)^(1/3), with |f'''| taken as half of |f'|, which is what the logit transform itself
//   gives a power law at the middle of its bounds; f' comes from regressions over the runs there
//   are. The step is never below the study's relative step (at least 2 %, where the noise of a
//   discrete specimen begins to hide the slope) and never above 0.8 in z. Failed runs: a column
//   keeps its other side (one-sided difference); a column with no side is frozen, that is zero for
//   this Jacobian, and says so. A parameter at a bound which the data push further out is held: the
//   logit is flat there, so that a step would either change nothing or leap through the whole
//   range. It is let go as soon as the data pull it back.
// Why not a solver's own differences: they go point by point, in series, with steps near 1e-6. With
//   noise of 1e-3 and steps of 1e-4 a solver claimed success 200 times in 200 starts and was right
//   in none.
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
  Eigen::MatrixXd rows;       // standardised: targets x parameters
  Eigen::MatrixXd noise_sd;   // of each entry
  std::vector<double> steps;  // in z
  std::vector<bool> frozen;   // one a parameter: no derivative could be had
  std::vector<bool> held;     // one a parameter: at a bound and pushed outwards
  std::vector<std::string> notes;
  bool any_frozen() const;
  bool moves(std::size_t parameter) const { return !frozen[parameter] && !held[parameter]; }
};

// Nearer to a bound than this share of the range counts as at the bound.
constexpr double bound_fraction = 0.02;

// Steps in z about `point`. `slopes` are standardised (targets x parameters), or empty when nothing
// is known.
std::vector<double> difference_steps(const ParameterSpace &space, const FitProblem &problem,
                                     const TransformedPoint &point, const Eigen::MatrixXd &slopes,
                                     double relative_step);

// Standardised slopes from regressions over all runs there are; empty when a target has too few.
Eigen::MatrixXd regression_slopes(const Evaluator &evaluator, const FitProblem &problem,
                                  const TransformedPoint &point);

// Sets `held` for a point near the Jacobian's own.
void hold_at_bounds(const Evaluator &evaluator, const FitProblem &problem,
                    const TransformedPoint &point, Jacobian &jacobian);

Jacobian difference_jacobian(Evaluator &evaluator, const FitProblem &problem,
                             const TransformedPoint &point, const std::vector<double> &steps);

}  // namespace bondlab
