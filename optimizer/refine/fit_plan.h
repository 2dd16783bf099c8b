// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how many forward runs a fit will usually take, by phase: for the estimate before anything
//   starts and for the time left while it runs.
// Method: the design, the noise runs and the packings are fixed by the study; the search is counted
//   with what it usually needs. A later fit finds the design and half of its noise runs made.
// Units: runs. Failure: UserError for a fit that isn't in the study.
// Limits: an estimate; a search that has to go on takes more.
#pragma once

#include <string>
#include <vector>

#include "refine/evaluator.h"

namespace bondlab {

constexpr int noise_repeats = 4;

struct FitPlan {
  int design = 0, noise = 0, refine = 0, packings = 0;
  int all() const { return design + noise + refine + packings; }
};

FitPlan plan_of(const Study &study, const FitEntry &entry, bool first);

// Positions of targets in Study::targets.
TargetIndices indices_of(const Study &study, const std::vector<std::string> &names);

// The fits named, or all of the study's in their order.
std::vector<std::string> fits_or_all(const Study &study, const std::vector<std::string> &names);

// Of several fits together.
int expected_runs(const Study &study, const std::vector<std::string> &names);

}  // namespace bondlab
