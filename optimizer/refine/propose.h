// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: where the runs made so far say that the minimum is: the next point worth running.
// Method: a ResponseModel for each target of the fit, over all points or weighted towards a centre,
//   and the minimum of the misfit of these models with the prior, by Ceres on closed forms (costs
//   no runs).
// Units: none in z. Failure: nullopt when a target has too few figures for a model.
// Limits: a proposal is never a result; what counts is the run at it.
#pragma once

#include <optional>

#include "refine/fit_problem.h"

namespace bondlab {

struct Proposal {
  TransformedPoint point;
  Eigen::VectorXd standardised;  // what the models expect there
};

// Over all points with equal weight.
std::optional<Proposal> propose_from_all(const Evaluator &evaluator, const FitProblem &problem,
                                         const TransformedPoint &from);

// Points count by exp(-(d/reach)^2 / 2), d their distance from `centre` in positions between the
// bounds.
std::optional<Proposal> propose_near(const Evaluator &evaluator, const FitProblem &problem,
                                     const TransformedPoint &centre, double reach);

}  // namespace bondlab
