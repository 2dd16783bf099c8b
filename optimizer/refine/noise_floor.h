// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how far a response scatters when the parameters hardly change: the floor below which no
//   difference means anything.
// Method: a few runs at seeded random changes of up to 2 % about a centre, the least step that
//   derivatives take; the part that the parameters explain (slopes from regressions over the runs
//   there are) is taken off, and what is left gives the standard deviation. Smaller changes would
//   find less: a specimen breaks along the same path until a change is large enough to turn a
//   crack, and derivatives and steps are of that size. A brittle specimen breaks along another path
//   for a change in the last digits, so that strengths scatter by percents while moduli hardly do;
//   a solver that took one for the other would differentiate noise. The sd is given for a figure of
//   the measured size: it is scaled by measured over simulated, since scatter is a share of the
//   figure.
// Why not other packings: a fit runs on one packing, and its differences cancel what packings have
//   in common. The scatter between packings is measured at the end and enters the uncertainty of
//   the result.
// Units: SI. Failure: a target with fewer than 3 figures has NaN (unknown) and a note.
// Limits: with 4 repeats the sd itself is known to some 35 %.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "refine/evaluator.h"

namespace bondlab {

struct NoiseFloor {
  std::vector<double> sd;  // one a target of the study, SI; NaN: unknown
  std::vector<std::string> notes;
};

// Largest change of a parameter, relative to its value.
constexpr double noise_wiggle = 0.02;

// Points within `wiggle` of `centre`; the centre itself is not among them.
std::vector<TransformedPoint> noise_points(const ParameterSpace &space,
                                           const TransformedPoint &centre, double wiggle,
                                           int repeats, std::uint64_t seed);

NoiseFloor measure_noise(Evaluator &evaluator, const TargetIndices &targets,
                         const TransformedPoint &centre, int repeats, std::uint64_t seed);

}  // namespace bondlab
