// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what `bondlab run` found as a file for other programs, run.json in the results folder.
// Method: the point, every test with its run, cost, responses and quality figures, and the study's
//   envelopes. It holds the last `bondlab run` of the folder; the runs themselves stay in the store.
// Units: SI, named beside each figure; angles in degrees.
// Failure: none; a figure that couldn't be had is null with the reason beside it.
#pragma once

#include <string>
#include <vector>

#include "forward/forward_model.h"
#include "response/envelope.h"
#include "study/study.h"

namespace bondlab {

// `values` in the order of the study's parameters; outcomes[i] is that of tests[i].
std::string run_record(const Study &study, const std::vector<double> &values,
                       const std::vector<std::string> &tests,
                       const std::vector<ForwardOutcome> &outcomes,
                       const std::vector<StrengthEnvelope> &envelopes);

}  // namespace bondlab
