// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the figures that judge one run of a test instead of measuring the material.
// Method: those of the families its responses belong to (response.h), and, of a Brazilian test,
//   where the first cracks are, which stands in the list of broken bonds.
// Units: SI. Failure: none; a figure that can't be had is left out.
#pragma once

#include <map>
#include <string>

#include "forward/forward_model.h"
#include "study/study.h"

namespace bondlab {

std::map<std::string, double> run_quality(const TestEntry &test, const ForwardOutcome &outcome);

// The words a person reads for a figure of how quasi-static or valid the run is; "" for the others.
std::string quality_words(const std::string &figure);

// Platens that differ by more than this: the test is not quasi-static.
constexpr double noticeable_imbalance = 0.05;
// Ten times the kinetic over strain energy that good practice stays below.
constexpr double noticeable_kinetic_share = 0.01;
// Where cracks spread evenly over a disc are, as a share of its radius: beyond it they began at the
// platens.
constexpr double cracks_anywhere = 2.0 / 3;

// A sentence for a person where the figure is beyond its bound; "" where it is well or has none.
std::string quality_warning(const std::string &figure, double value);

}  // namespace bondlab
