// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the distribution of particle radii, as the fraction of particles (by number) below a
//   radius, inverted.
// Method: a distribution is its quantile function and its mean radius; draw_radii() takes one
//   random draw from each of N equal strata of (0, 1), so that the sizes of two packings with the
//   same request hardly differ and the scatter between packings is that of the arrangement. A new
//   distribution is one file with a class like UniformSizes and one line in
//   size_distribution.cpp.
// Units: m (or any one length unit).
// Failure: UserError for an unknown name.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/random.h"

namespace bondlab {

class SizeDistribution {
 public:
  virtual ~SizeDistribution() = default;
  // Radius below which the fraction u of the particles is; u in (0, 1); increasing.
  virtual double quantile(double u) const = 0;
  virtual double smallest() const = 0;
  virtual double largest() const = 0;
  // Mean of radius^power by number.
  virtual double moment(int power) const = 0;
};

// name: "uniform". r_min in m, r_ratio = largest over smallest radius.
std::unique_ptr<SizeDistribution> size_distribution(const std::string &name, double r_min,
                                                    double r_ratio);
std::vector<std::string> size_distribution_names();

// `count` radii in random order.
std::vector<double> draw_radii(const SizeDistribution &sizes, std::size_t count,
                               RandomStream &random);

}  // namespace bondlab
