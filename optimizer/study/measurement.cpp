// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/measurement.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace bondlab {

const std::vector<double> &MeasuredCurve::column(const std::string &name) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return columns[i];
  throw UserError({file, 0, 0}, "there is no column '" + name + "'; columns: " + join(names));
}

// y at `at` on the polyline; x increases and covers it.
static double interpolate(const std::vector<double> &x, const std::vector<double> &y, double at) {
  const auto above = std::lower_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  const std::size_t i = static_cast<std::size_t>(above - x.begin());
  const double share = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + share * (y[i] - y[i - 1]);
}

Envelope make_envelope(const std::vector<MeasuredCurve> &replicates, const std::string &x,
                       const std::string &y, int points) {
  if (replicates.empty()) throw UserError("there are no curves to take the mean of");
  double lower = -HUGE_VAL, upper = HUGE_VAL;
  for (const MeasuredCurve &curve : replicates) {
    const std::vector<double> &column = curve.column(x);
    for (std::size_t i = 1; i < column.size(); ++i)
      if (column[i] <= column[i - 1])
        throw UserError({curve.file, 0, 0},
                        "the column '" + x + "' must increase from row to row; row " +
                            std::to_string(i + 1) + " has " + canonical_number(column[i]) +
                            " after " + canonical_number(column[i - 1]));
    if (column.size() < 2) throw UserError({curve.file, 0, 0}, "a curve needs at least two rows");
    lower = std::max(lower, column.front());
    upper = std::min(upper, column.back());
  }
  if (lower >= upper)
    throw UserError("the replicates have no common range of '" + x + "': it would run from " +
                    canonical_number(lower) + " to " + canonical_number(upper));

  Envelope envelope;
  const double count = static_cast<double>(replicates.size());
  for (int i = 0; i < points; ++i) {
    const double at = i + 1 == points ? upper : lower + (upper - lower) * i / (points - 1);
    std::vector<double> values;
    double mean = 0;
    for (const MeasuredCurve &curve : replicates) {
      values.push_back(interpolate(curve.column(x), curve.column(y), at));
      mean += values.back() / count;
    }
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    envelope.x.push_back(at);
    envelope.mean.push_back(mean);
    if (replicates.size() > 1) envelope.sd.push_back(std::sqrt(squares / (count - 1)));
  }
  return envelope;
}

}  // namespace bondlab
