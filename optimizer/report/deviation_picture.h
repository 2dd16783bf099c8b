// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the result at a glance: how far each simulated value is from the measured one, in per cent.
// Method: one row a target on one common scale, stretched about zero (inverse hyperbolic sine); the
//   band is the measured standard deviation, the full dot the fit, the ring the trade-off fit, the
//   whisker mean and standard deviation over the other packings.
// Units: per cent of the measured value.
// Failure: none; without a simulated value a row says so.
#pragma once

#include <string>

#include "report/report.h"

namespace bondlab {

struct DeviationPicture {
  std::string title, sentence, svg, data;  // data: TSV
};
DeviationPicture deviation_picture(
    const ReportInput &input);  // svg is empty when there are no targets

}  // namespace bondlab
