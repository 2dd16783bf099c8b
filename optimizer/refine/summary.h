// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: turn the end of a search into the tables and sentences of a SingleFit.
// Method: reads runs that were made and runs nothing. Parameters are judged with the weights of the
//   end: measurement sd joined with the larger of noise and packing-to-packing scatter
//   (misfit/residual.h). The verdict says, in this order: which targets of the fit are met, which
//   are not and by how much, what cannot be met at all and how that is known, what was predicted,
//   and whether the search came to an end.
// Units: SI; sentences carry the targets' own units. Failure: none; what could not be had says why.
#pragma once

#include <string>
#include <vector>

#include "refine/marquardt.h"

namespace bondlab {

// Fills targets, parameters, packings, best outcomes, findings, verdict. `noise` has one entry a
// target of the study.
void summarise(const Evaluator &evaluator, const FitEntry &entry, const FitProblem &problem,
               const std::vector<double> &noise, const MarquardtResult &found, SingleFit &result);

// "UCS is 118 MPa against 138.8 MPa measured, -15.0 % or 3.0 sd"
std::string difference_in_words(const TargetResult &target);

}  // namespace bondlab
