// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what every loading test has in common: find the peak, see that the test went beyond it, take
//   a window of the loading branch, fit a straight line in it.
// Method: the window runs from the last crossing of the lower level to the first crossing of the
//   upper one, before the peak. That leaves out the platen's first knock (an early spike over the
//   lower level) and anything after the peak.
// Source: ISRM 1979 and ASTM D7012 (tangent over a fixed part around half of the peak, by
//   regression).
// Units: those of the columns given. Failure: ResponseError.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "forward/forward_model.h"

namespace bondlab {

/// A sample range [first, last), indices into the curve's columns.
struct SampleWindow {
  std::size_t first = 0, last = 0;
  std::size_t size() const { return last - first; }
};

struct LineFit {
  double slope = 0, intercept = 0;
  double slope_error = 0;  ///< standard errors, from the scatter about the line
  double intercept_error = 0;
};

/// Fewest samples that a regression window must hold.
constexpr std::size_t minimum_window_samples = 10;
/// Share of the peak that the load must lose after it, else the test counts as not finished.
constexpr double minimum_drop_after_peak = 0.05;
/// Part of the peak load over which tangents are taken.
constexpr double window_lower = 0.40, window_upper = 0.60;

/// Column of the curve; ResponseError when it is absent, of another length than time, or not
/// finite.
const std::vector<double> &finite_column(const Curve &curve, const std::string &name);

/// ResponseError unless time grows from sample to sample.
void require_monotonic_time(const Curve &curve);

/// Index of the peak of `load`; ResponseError when there is no load or no fall behind the peak.
std::size_t find_peak(const std::vector<double> &load);

/// Greatest `load` of a test that is to end at `wanted` (a deck variable, whose name is given),
/// with or without a peak before. ResponseError when it ended at `end`, short of that, and no load
/// had fallen.
double greatest_until(const std::vector<double> &load, double end, const std::string &variable,
                      double wanted);

/// Part of the loading branch between the two shares of the peak.
SampleWindow loading_window(const std::vector<double> &load, std::size_t peak,
                            double lower = window_lower, double upper = window_upper);

/// Least squares of y on x in the window.
LineFit fit_line(const std::vector<double> &x, const std::vector<double> &y, SampleWindow window);

/// Largest |a - b| over the window, as a share of the mean of |a| and |b| over the window: how far
/// two forces that must be equal at rest are apart.
double relative_imbalance(const std::vector<double> &a, const std::vector<double> &b,
                          SampleWindow window);

/// Largest kinetic over strain energy (columns kinetic_energy, strain_energy, J) in the window: how
/// far a test is from quasi-static (below 1e-3 is good practice).
double kinetic_share(const Curve &curve, SampleWindow window);

/// Share of the samples' range as a window behind `first`: the last `share` of [first, last).
SampleWindow last_part(SampleWindow window, double share);

}  // namespace bondlab
