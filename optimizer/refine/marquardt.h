// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: Levenberg-Marquardt with forward runs, from one start to a point whose gradient is zero
//   within the noise.
// Method: Ceres' trust region in transformed space, without its bounds (setting them makes it ask
//   for ten times the gradients; the logit transform needs none). The cost function serves
//   residuals and Jacobian from the evaluator, so that a point asked for twice is run once, and
//   every Jacobian is one batch. A Jacobian is kept as long as the point stays within half of its
//   steps: it is a secant over just that region. Success is judged by judge_stationarity() and by
//   nothing else. After three rejected steps in a row Ceres is left: with a kept Jacobian it starts
//   again with a fresh one; without one the search ends as not converged if what a step promises is
//   of the size of the noise, else it goes on with shorter steps.
// Failure: at the start, that is the caller's to avoid (started = false). In a Jacobian, see
//   jacobian.h. At a trial point: the step is rejected and the trust region shrinks. FitFailed,
//   UserError and Interrupted end it at once.
// Units: none in z; misfits are sums of squares of standardised differences.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "refine/stationarity.h"

namespace bondlab {

struct MarquardtOptions {
  int max_iterations = 8;       // trial points
  double relative_step = 0.03;  // see difference_steps()
  Immaterial immaterial;
  bool keep_jacobian = true;
};

struct MarquardtStep {
  TransformedPoint point;
  double misfit = 0;  // without the prior; NaN: failed
  bool accepted = false;
  std::string note;
};

struct MarquardtResult {
  bool started = false;
  bool converged = false;
  bool limit_reached = false;  // max_iterations
  TransformedPoint point;
  Jacobian jacobian;  // within half of its steps from the point, or at it
  Stationarity stationarity;
  int trials = 0, accepted = 0, jacobians = 0;
  std::string ended;  // why it stopped, in words
  std::vector<std::string> notes;
};

MarquardtResult marquardt(Evaluator &evaluator, const FitProblem &problem,
                          const TransformedPoint &start, const MarquardtOptions &options,
                          const std::function<void(const MarquardtStep &)> &on_step = nullptr);

}  // namespace bondlab
