// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: radii of a few classes, each with its share of the number of particles.
// Units: m (or any one length unit).
// Failure: none; the classes are checked by check_sizes().
#pragma once

#include <algorithm>

#include "specimen/size_distribution.h"

namespace bondlab {

class DiscreteSizes : public SizeDistribution {
 public:
  explicit DiscreteSizes(std::vector<SizeClass> classes) : classes_(std::move(classes)) {
    std::sort(classes_.begin(), classes_.end(),
              [](const SizeClass &a, const SizeClass &b) { return a.r < b.r; });
    double sum = 0;
    for (const SizeClass &c : classes_) sum += c.share;
    for (SizeClass &c : classes_) c.share /= sum;
  }
  double quantile(double u) const override {
    for (const SizeClass &c : classes_)
      if ((u -= c.share) < 0) return c.r;
    return classes_.back().r;
  }
  double smallest() const override { return classes_.front().r; }
  double largest() const override { return classes_.back().r; }
  double moment(int power) const override {
    double sum = 0;
    for (const SizeClass &c : classes_) {
      double term = c.share;
      for (int k = 0; k < power; ++k) term *= c.r;
      sum += term;
    }
    return sum;
  }

 private:
  std::vector<SizeClass> classes_;
};

}  // namespace bondlab
