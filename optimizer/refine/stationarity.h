// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: say whether a point is a minimum as far as the noise of the responses lets anyone tell.
// Method: with standardised rows r and derivatives A (targets and prior stacked) the gradient is g
//   = A'r. If the point were the minimum of the mean response, g would still be A'e with e the
//   noise of the rows, plus the noise of A times r. Its covariance C follows from the measured
//   noise, so g'C^-1 g is then chi squared with as many degrees of freedom as parameters; up to the
//   95 % point the gradient counts as zero. Rows count with at least `immaterial` noise: a
//   difference of some hundredths of a sd is not worth a run. A gradient that is not zero counts as
//   zero nevertheless when a full step promises to lower the misfit by less than the noise alone
//   adds to it (no run could show the gain) or by next to nothing (the step is then a fifth of a sd
//   of the parameters). Parameters held at a bound are left out. And one that could be zero is not
//   taken as zero when a full step promises a gain worth having (the gain is the square of the step
//   in standard deviations of the parameters): then the derivatives are too noisy to tell, which is
//   no success.
// Why not a solver's own tolerances: they compare the cost with itself. With noise they stop
//   anywhere and call it success (200 of 200 in our measurement with too small a step); this test
//   asks what the noise could have done.
// Units: none (standardised). Failure: a point with a missing figure, or a Jacobian with a frozen
//   column, is not stationary.
#pragma once

#include "refine/jacobian.h"

namespace bondlab {

struct Immaterial {
  double row = 0.03;   // sd of a target
  double gain = 0.05;  // of the misfit
};
constexpr double gain_worth_having = 0.5;  // and four times the noise's share on top

struct Stationarity {
  bool stationary = false;
  double statistic = 0;   // g'C^-1 g
  double limit = 0;       // 95 % point of chi squared
  double gain = 0;        // fall of the misfit that a full Gauss-Newton step promises
  double noise_gain = 0;  // what the noise of single runs adds to the misfit, on average
};

Stationarity judge_stationarity(const Evaluator &evaluator, const FitProblem &problem,
                                const TransformedPoint &point, const Jacobian &jacobian,
                                const Immaterial &immaterial = {});

}  // namespace bondlab
