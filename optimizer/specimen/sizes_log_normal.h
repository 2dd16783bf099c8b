// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: radii whose logarithm is normal, by number, without the outermost 2.5 % at each end.
// Method: quantile median * exp(spread z); moments by the mid-point rule over the quantile. The
//   ends are left out because a packing has a largest particle, and its neighbour search and its
//   size are set by it: z runs from -1.96 to 1.96.
// Units: m (or any one length unit).
// Failure: none; the values are checked by check_sizes().
#pragma once

#include "base/plain_math.h"
#include "specimen/size_distribution.h"

namespace bondlab {

class LogNormalSizes : public SizeDistribution {
 public:
  LogNormalSizes(double median, double spread) : median_(median), spread_(spread) {}
  double quantile(double u) const override {
    return median_ * plain_exp(spread_ * plain_normal_quantile(cut + (1 - 2 * cut) * u));
  }
  double smallest() const override { return quantile(0); }
  double largest() const override { return quantile(1); }
  double moment(int power) const override {
    constexpr int strata = 2048;
    double sum = 0;
    for (int i = 0; i < strata; ++i) {
      const double r = quantile((i + 0.5) / strata);
      sum += power == 1 ? r : power == 2 ? r * r : r * r * r;
    }
    return sum / strata;
  }

 private:
  static constexpr double cut = 0.025;
  double median_, spread_;
};

}  // namespace bondlab
