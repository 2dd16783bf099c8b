// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the pictures of a diagnosis: curves measured, before and after; and where the residual lies.
// Method: SVG written here, no program needed. The map has a row a series and a column a part of
//   the curve; a cell is the sum of the whitened residuals over the root of their number, which is
//   a standard normal score where nothing is missing: red where the measurement lies above the
//   model, blue where it lies below, full colour at six. It is drawn for the fit before and for the
//   fit after, side by side.
// Units: noise units. Failure: an empty string when there is nothing to draw.
#pragma once

#include <string>

#include "diagnose/study_diagnosis.h"

namespace bondlab::diagnose {

std::string curve_picture(const ShownSeries &series);
std::string where_picture(const StudyDiagnosis &diagnosis);

}  // namespace bondlab::diagnose
