// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the plots of the fit's way: misfit, parameters, responses over the parameters, and the
//   conflict of two targets.
// Method: one function a plot, each from ReportInput alone. Every point is a run that was made;
//   nothing is interpolated. The pair of targets that is shown in conflict is the one the fit found
//   (finding `unreachable_ratio`); without such a finding it is the target missed by most and, of
//   those in the same dimension, the one whose ratio to it varies least.
// Units: those of the parameters and targets.
// Failure: none; without data a function returns nothing.
#pragma once

#include <optional>
#include <string>

#include "report/plot.h"
#include "report/report.h"

namespace bondlab {

std::optional<Plot> misfit_plot(const ReportFit &fit);
std::optional<Plot> parameter_plot(const ReportFit &fit);
std::optional<Plot> response_plot(const ReportInput &input);

// Two targets whose ratio the model doesn't reach.
struct Conflict {
  ReportTarget above, below;  // ratio above / below
  double measured = no_number, measured_sd = no_number;
  std::vector<double> above_values, below_values, ratios;  // one a point with both
};
std::optional<Conflict> find_conflict(const ReportInput &input);
Plot conflict_plot(const Conflict &conflict);

}  // namespace bondlab
