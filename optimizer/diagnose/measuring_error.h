// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what an error of measuring makes of measured curves: a gauge that reads low, a load cell at
//   its end, a drift over the order of tests.
// Method: the curves of all specimens of a campaign, in the order they were tested, are changed in
//   place by the rules of the effect's file. A load cell's end is a share of the largest load of
//   the series, since nobody buys a cell for each specimen.
// Units: SI. Failure: none; a column that a curve lacks is left alone.
#pragma once

#include <string>
#include <vector>

#include "forward/curve.h"
#include "study/effect_definition.h"

namespace bondlab::diagnose {

struct MeasuredRun {
  std::string kind;    // of test
  std::string series;  // test under one condition
  Curve curve;
};

// `runs` in the order they were tested.
void apply_measuring_errors(const EffectDefinition &effect, double size,
                            std::vector<MeasuredRun> &runs);

}  // namespace bondlab::diagnose
