// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how well the data fix each parameter: standard deviation, interval, identifiable or not and
//   why, ridges in words.
// Method: singular values of the standardised Jacobian. A direction whose singular value is within
//   twice what the noise of the Jacobian alone would give, or below 1e-8 of the largest, is null:
//   no covariance is made of it, it is put into words as a combination of parameters. The rest
//   gives the covariance (the pseudo-inverse, as Ceres' DENSE_SVD with null_space_rank = -1; the
//   test holds one against the other), the prior included. A parameter is identifiable when its
//   profile of the misfit, the prior left out, rises by 3.84 (95 %, one degree of freedom) at one
//   bound at least; the profile is taken as a parabola in the parameter's position between its
//   bounds. A parameter at a bound has no covariance; the others are judged with it held there.
// Units: SI for values and sd, none for z. Failure: none; what can't be known is NaN with a reason.
// Limits: linear. Intervals say nothing about what the model cannot do: with a misfit far above its
//   degrees of freedom they are too small, and the fit's notes say so.
#pragma once

#include <string>
#include <vector>

#include "refine/jacobian.h"

namespace bondlab {

constexpr double flat_profile_rise = 3.84;      // 95 % point of chi squared, one degree of freedom
constexpr double interval_width = 1.959963985;  // sd to a 95 % interval

struct Uncertainty {
  std::vector<ParameterResult> parameters;
  std::vector<std::vector<double>> correlation;  // in z; empty when there is a null direction
  std::vector<Finding> ridges;
};

// `jacobian` and `problem.sd` standardise with the final sd (measurement and simulation); the point
// may differ from the Jacobian's by less than its steps.
Uncertainty judge_parameters(const ParameterSpace &space, const FitProblem &problem,
                             const Jacobian &jacobian, const TransformedPoint &point,
                             const Eigen::VectorXd &standardised);

// The same Jacobian under other weights.
Jacobian reweighted(const Jacobian &jacobian, const FitProblem &from, const FitProblem &to);

}  // namespace bondlab
