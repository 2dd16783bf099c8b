// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: radii of a sieve curve given by three points: the diameters below which 10, 50 and 90 % of
//   the mass is.
// Method: the passing mass is linear in the logarithm of the size between the points, and goes on
//   with the same slope to 0 and 100 % (a quarter of a 40 % step at each end). A mass dm at radius
//   r is dm / r^D particles (D = 2 for discs, 3 for spheres), so within a step the number of
//   particles smaller than r is c (r_a^-D - r^-D), which is turned round for the quantile.
// Units: m (or any one length unit).
// Failure: none; the values are checked by check_sizes().
// Limits: by number most particles are of the smallest sizes: D90 = 3 D10 in 3D has 60 % of them in
//   the finest 10 % of the mass.
#pragma once

#include <array>
#include <cmath>

#include "base/plain_math.h"
#include "specimen/size_distribution.h"

namespace bondlab {

class SizesByMass : public SizeDistribution {
 public:
  SizesByMass(double d10, double d50, double d90, int dimension) : dimension_(dimension) {
    const double low = std::sqrt(std::sqrt(d50 / d10)), high = std::sqrt(std::sqrt(d90 / d50));
    const double d[5] = {d10 / low, d10, d50, d90, d90 * high};
    const double mass[4] = {0.1, 0.4, 0.4, 0.1};
    double total = 0;
    for (int k = 0; k < 5; ++k) edge_[k] = 0.5 * d[k];
    for (int k = 0; k < 4; ++k) {
      slope_[k] = mass[k] / plain_log(edge_[k + 1] / edge_[k]);
      total += number_[k] =
          slope_[k] * (power(edge_[k], -dimension) - power(edge_[k + 1], -dimension)) / dimension;
    }
    for (int k = 0; k < 4; ++k) {
      slope_[k] /= total;
      number_[k] /= total;
    }
  }
  double quantile(double u) const override {
    int k = 0;
    for (; k < 3 && u > number_[k]; ++k) u -= number_[k];
    const double left = power(edge_[k], -dimension_) - u * dimension_ / slope_[k];
    const double least = power(edge_[k + 1], -dimension_);
    const double inverse = 1 / (left > least ? left : least);
    return dimension_ == 2 ? std::sqrt(inverse) : scaled_root(inverse);
  }
  double smallest() const override { return edge_[0]; }
  double largest() const override { return edge_[4]; }
  double moment(int order) const override {
    double sum = 0;
    const int n = order - dimension_;  // of the integral of slope r^(n - 1)
    for (int k = 0; k < 4; ++k)
      sum += slope_[k] * (n == 0 ? plain_log(edge_[k + 1] / edge_[k])
                                 : (power(edge_[k + 1], n) - power(edge_[k], n)) / n);
    return sum;
  }

 private:
  static double power(double x, int n) {
    double result = 1;
    for (int k = 0; k < std::abs(n); ++k) result *= x;
    return n < 0 ? 1 / result : result;
  }
  // The cube root of a small number is taken of its ratio to a known cube, near 1.
  double scaled_root(double cube) const {
    return edge_[4] * plain_cube_root(cube / power(edge_[4], 3));
  }

  int dimension_;
  std::array<double, 5> edge_{};              // radii
  std::array<double, 4> slope_{}, number_{};  // of each step, per particle
};

}  // namespace bondlab
