// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the strength envelopes of a study in one plot: every test a point, every envelope its line,
//   what was measured of it dashed beside.
// Method: all envelopes share one panel; a line runs from 0 to the largest abscissa, so that it
//   meets the axis at the cohesion. An envelope without a line has only points. Of a measured
//   envelope whose angle isn't known only the cohesion is drawn, as a ring on the axis; one whose
//   cohesion isn't known is drawn through the middle of our points, so that the angles can be
//   compared.
// Units: those of the first envelope; one unit on both axes, which are of one dimension.
// Failure: none; without a point the panel says "no data", and the sentence names the tests left out.
#pragma once

#include <vector>

#include "report/plot.h"
#include "report/report.h"

namespace bondlab {

Plot envelope_plot(const std::vector<ReportEnvelope> &envelopes);

}  // namespace bondlab
