// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: say in plain sentences what a fit met and what it missed, and by how much.
// Method: from the table of targets alone, so that words and table can't disagree. The fit's own
//   verdict, where there is one, stands before these.
// Units: those of the targets.
// Failure: none; a target without a simulated value is named as not simulated.
#pragma once

#include <string>

#include "report/report.h"

namespace bondlab {

double deviation(
    const ReportTarget &target);  // simulated / measured - 1; no number when either is missing
std::string with_unit(const std::string &number,
                      const std::string &unit);  // "1" and "" show no unit

// "E, nu and UCS are met ... Predicted, not fitted: sigma_t is missed: ..."
std::string targets_sentence(const ReportFit &fit);

// What the page opens with.
std::string headline(const ReportInput &input);

// How many of the parameter sets run meet every target of the fit, in words; "" when that can't be
// told.
std::string all_met_sentence(const ReportInput &input, const ReportFit &fit);

}  // namespace bondlab
