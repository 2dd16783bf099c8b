// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one picture of the curves behind a published table: a panel a test, a line a case.
// Method: mean force of the two platens against the displacement, which every deck's curve has; of
//   each case one run (the first packing), up to the sample where its force has fallen for good to
//   a third of its peak, or its end. A run without these columns is left out.
// Units: SI in; mm or um and N, kN or MN on the axes, one unit a panel.
// Failure: none; nothing where no run can be drawn.
// Limits: ten cases at most, the first ones; the picture's sentence says how many there are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "forward/curve.h"
#include "report/plot.h"

namespace bondlab {

constexpr std::size_t most_cases_drawn = 10;

struct CaseCurve {
  std::string test, name;  // of the case
  const Curve *curve = nullptr;
};

// Runs in the order of the cases; the panels are in the order in which tests first come.
std::optional<Plot> case_plot(const std::string &title, const std::vector<CaseCurve> &runs);

}  // namespace bondlab
