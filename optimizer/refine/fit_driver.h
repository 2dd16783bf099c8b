// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the whole identification of a study, from the first design point to the last packing.
// Method, one fit: Latin hypercube of all tests the fit names (predicted ones too: their figures
//   are the evidence of what cannot be reached together) -> a regression over it proposes one more
//   point -> noise floor about the best point -> Levenberg-Marquardt from the best point, from the
//   next best when that fails -> a last look through the noise when a target of the fit is missed
//   by less than the regression says is needed -> the other packings -> uncertainty and findings. A
//   later fit with more targets goes through the same steps; what was run is not run again, and the
//   solution of the fit before is among its starts.
// Resuming: every decision depends on the study and on the outcomes only, so that the same call
//   with a store of runs takes the same way and goes on where it was killed.
// Units: SI. Failure: FitFailed when no point gives all figures, or too many runs fail; UserError
//   and Interrupted pass.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "refine/fit_plan.h"
#include "refine/fit_result.h"
#include "study/study.h"

namespace bondlab {

struct FitProgress {
  std::string fit, phase;
  int runs_done = 0, runs_expected = 0, failed = 0;
  double best_misfit = -1;   // negative: none yet
  double seconds_left = -1;  // negative: unknown yet
};

using FitProgressSink = std::function<void(const FitProgress &)>;
using FitCheckpoint = std::function<void(const FitResult &)>;

// Runs the fits named, in the order given; all of the study's when `names` is empty. `checkpoint`
// gets the result so far after each of them, so that a failure in a later fit doesn't lose an
// earlier one.
FitResult run_fits(const Study &study, const std::vector<std::string> &names, ForwardModel &model,
                   const FitProgressSink &progress = nullptr,
                   const FitCheckpoint &checkpoint = nullptr);

}  // namespace bondlab
