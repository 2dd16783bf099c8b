// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: say, from all runs ever made, which targets no parameter set can reach, alone or in pairs.
// Method: for each target the span of its simulated figure over all parameter sets; for each pair
//   of targets of the same dimension the span of their ratio. A measured figure (or ratio) outside
//   the span by more than two standard deviations counts as unreachable. A ratio is looked at
//   because it shows a conflict that a sum of squares hides: both strengths can be reached, each
//   with another set, and their ratio hardly moves. A ratio with a target that can't be reached
//   alone is left out, since it would only say the same again, unless the ratio moves much less
//   than its parts do: then it is the reason.
// Why all runs: the design points cover the bounds, so the span is evidence about the model class
//   within them and not about one search.
// Units: SI; the sentences carry the targets' own units. Failure: a target with no figures gives no
//   finding.
// Limits: evidence, not proof: a span over a few dozen points can miss a corner.
#pragma once

#include <vector>

#include "refine/fit_result.h"
#include "study/study.h"

namespace bondlab {

// Findings about the targets named, from the ledger. The order is that of `targets`, single ones
// first.
std::vector<Finding> judge_feasibility(const Study &study, const std::vector<std::string> &targets,
                                       const std::vector<LedgerPoint> &ledger);

}  // namespace bondlab
