// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the strength envelopes of a study in one plot: every test a point, every envelope its line.
// Method: all envelopes share one panel; the line runs from 0 to the largest
//   abscissa, so that it meets the axis at the cohesion. An envelope without a line has only points.
// Units: MPa or the prefix that suits the largest value; one unit on both axes where they are of one
//   dimension, as in a shear test.
// Failure: none; without a point the panel says "no data".
#pragma once

#include <vector>

#include "report/plot.h"
#include "response/envelope.h"

namespace bondlab {

Plot envelope_plot(const std::vector<StrengthEnvelope> &envelopes);

}  // namespace bondlab
