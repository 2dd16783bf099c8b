// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the plot of one virtual test's curve, with the figures read from it marked in it.
// Method: a curve with stress and gauge strains is drawn the way rock laboratories do, axial strain
//   to the right and lateral strain to the left; any other curve as force over displacement. The
//   number of broken bonds has the right-hand axis. Tangent and peak are taken by the functions of
//   response/ that the fit used, so that the mark is the number of the table. Curves of many
//   samples are thinned without losing a peak.
// Units: SI in; %, MPa (or the prefix that suits), mm and kN on the axes.
// Failure: UserError when the curve has neither set of columns. A figure that can't be read from
//   the curve is left out.
#pragma once

#include <vector>

#include "forward/curve.h"
#include "report/plot.h"
#include "report/report.h"

namespace bondlab {

// A unit whose numbers are short for values up to `largest`, SI.
struct AxisUnit {
  const char *name;
  double factor;  // in SI
};
AxisUnit force_unit(double largest);
AxisUnit way_unit(double largest);

bool is_stress_strain(const Curve &curve);

// Mean of the two platens' forces, N.
std::vector<double> platen_force(const Curve &curve);

// Samples of the load (stress or force) up to its greatest value.
std::size_t peak_index(const std::vector<double> &load);

Plot curve_plot(const Curve &curve, const ReportRunFiles &run,
                const std::vector<ReportTarget> &targets,
                const std::vector<ReportMeasuredCurve> &measured);

}  // namespace bondlab
