// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: radii uniform between r_min and r_max by number, the size distribution of Potyondy &
//   Cundall 2004.
// Units: m (or any one length unit).
// Failure: none; bounds are checked by check_request() in specimen.h.
#pragma once

#include "specimen/size_distribution.h"

namespace bondlab {

class UniformSizes : public SizeDistribution {
 public:
  UniformSizes(double r_min, double r_max) : r_min_(r_min), r_max_(r_max) {}
  double quantile(double u) const override { return r_min_ + u * (r_max_ - r_min_); }
  double smallest() const override { return r_min_; }
  double largest() const override { return r_max_; }
  // (b^(n+1) - a^(n+1)) / ((n+1)(b - a)) written as a sum, which stays exact for equal bounds.
  double moment(int power) const override {
    double sum = 0;
    for (int k = 0; k <= power; ++k) {
      double term = 1;
      for (int i = 0; i < k; ++i) term *= r_max_;
      for (int i = k; i < power; ++i) term *= r_min_;
      sum += term;
    }
    return sum / (power + 1);
  }

 private:
  double r_min_, r_max_;
};

}  // namespace bondlab
