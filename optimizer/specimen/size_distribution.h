// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: distributions of particle radii, by name.
// Method: a distribution is its quantile function and its mean radius; draw_radii() takes one
//   random draw from each of N equal strata of (0, 1), so that the sizes of two packings with the
//   same request hardly differ and the scatter between packings is that of the arrangement. A new
//   distribution is one file with a class like UniformSizes and one entry in
//   size_distribution.cpp.
// Units: m (or any one length unit).
// Failure: UserErrors for an unknown name and for values that make no distribution.
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
  // Radius below which the fraction u of the particles is, by number; u in (0, 1); increasing.
  virtual double quantile(double u) const = 0;
  virtual double smallest() const = 0;
  virtual double largest() const = 0;
  // Mean of radius^power by number, power 1 to 3.
  virtual double moment(int power) const = 0;
};

struct SizeClass {
  double r = 0;      // m
  double share = 0;  // of the number of particles, in any unit
};

// What a distribution is made of; only the values of the one that is named are used.
struct SizeSettings {
  std::string name = "uniform";
  double r_min = 0, r_ratio = 1.66;   // uniform: smallest radius, largest over smallest
  double r_median = 0, r_spread = 0;  // log-normal: median, standard deviation of ln r
  std::vector<SizeClass> classes;     // discrete
  double d10 = 0, d50 = 0, d90 = 0;   // d10-d50-d90: diameters below which that part of the mass is
};

// The same in another length unit.
SizeSettings in_units_of(SizeSettings settings, double unit);

// dimension 2 or 3: of the particles' mass.
std::unique_ptr<SizeDistribution> size_distribution(const SizeSettings &settings, int dimension);
// Of the names that need no more than these two.
std::unique_ptr<SizeDistribution> size_distribution(const std::string &name, double r_min,
                                                    double r_ratio);
std::vector<std::string> size_distribution_names();

// UserErrors with everything that is wrong.
void check_sizes(const SizeSettings &settings);

// "0.5 mm: 30 %" -> 0.5e-3, 0.3; the share may be any number.
SizeClass parse_size_class(const std::string &text);

// `count` radii in random order.
std::vector<double> draw_radii(const SizeDistribution &sizes, std::size_t count,
                               RandomStream &random);

}  // namespace bondlab
