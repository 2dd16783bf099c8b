// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/parameter_space.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace bondlab {

namespace {

// Distances of x from the two ends, in the scale. log1p, because log(x) - log(lower) cancels where
// the bounds are close.
double distance_from_lower(const Parameter &p, double x) {
  return p.scale == Scale::logarithmic ? std::log1p((x - p.lower) / p.lower) : x - p.lower;
}
double distance_from_upper(const Parameter &p, double x) {
  return p.scale == Scale::logarithmic ? std::log1p((p.upper - x) / x) : p.upper - x;
}
double range_of(const Parameter &p) { return distance_from_lower(p, p.upper); }

// Physical value at the share v of the range from one end: that end is met exactly and nothing
// cancels near it.
double from_end(const Parameter &p, double v, bool from_lower) {
  const double distance = range_of(p) * v;
  if (p.scale == Scale::logarithmic)
    return from_lower ? p.lower * std::exp(distance) : p.upper * std::exp(-distance);
  return from_lower ? p.lower + distance : p.upper - distance;
}

double physical_of(const Parameter &p, double z) {
  if (z <= -ParameterSpace::z_limit) return p.lower;
  if (z >= ParameterSpace::z_limit) return p.upper;
  // The logistic function from the nearer end: exp(-|z|) / (1 + exp(-|z|)) <= 1/2.
  const double tail = std::exp(-std::abs(z)), v = tail / (1 + tail);
  return std::clamp(from_end(p, v, z < 0), p.lower, p.upper);
}

}  // namespace

ParameterSpace::ParameterSpace(const std::vector<Parameter> &parameters) : parameters_(parameters) {
  for (const Parameter &p : parameters_) {
    names_.push_back(p.name);
    const bool positive = p.scale == Scale::linear || p.lower > 0;
    if (!(p.lower < p.upper) || !positive || !std::isfinite(p.lower) || !std::isfinite(p.upper))
      throw UserError(p.place, "the bounds of the parameter '" + p.name + "' can't be " +
                                   format_quantity(p.lower, p.unit) + " and " +
                                   format_quantity(p.upper, p.unit) +
                                   "; lower must be below upper" +
                                   (positive ? "" : ", and above 0 on a log scale"));
  }
}

static void check_count(std::size_t given, std::size_t n) {
  if (given != n)
    throw UserError("a point has " + std::to_string(given) + " values, the study has " +
                    std::to_string(n) + " parameters");
}

PhysicalPoint ParameterSpace::to_physical(const TransformedPoint &point) const {
  check_count(point.z.size(), n());
  PhysicalPoint physical;
  for (std::size_t i = 0; i < n(); ++i) {
    if (std::isnan(point.z[i]))
      throw UserError("the transformed value of the parameter '" + names_[i] + "' isn't a number");
    physical.x.push_back(physical_of(parameters_[i], point.z[i]));
  }
  return physical;
}

TransformedPoint ParameterSpace::to_transformed(const PhysicalPoint &point) const {
  check_count(point.x.size(), n());
  TransformedPoint transformed;
  for (std::size_t i = 0; i < n(); ++i) {
    const Parameter &p = parameters_[i];
    const double x = point.x[i];
    if (!(x >= p.lower && x <= p.upper))
      throw UserError("the parameter '" + p.name + "' can't be " + format_quantity(x, p.unit, 6) +
                      "; allowed: " + format_quantity(p.lower, p.unit, 6) + " to " +
                      format_quantity(p.upper, p.unit, 6));
    const double z = std::log(distance_from_lower(p, x) / distance_from_upper(p, x));
    transformed.z.push_back(std::clamp(z, -z_limit, z_limit));
  }
  return transformed;
}

PhysicalPoint ParameterSpace::from_unit_cube(const std::vector<double> &u) const {
  check_count(u.size(), n());
  PhysicalPoint physical;
  for (std::size_t i = 0; i < n(); ++i) {
    if (!(u[i] >= 0 && u[i] <= 1))
      throw UserError("the position of the parameter '" + names_[i] +
                      "' in the unit cube must lie in 0..1");
    const Parameter &p = parameters_[i];
    const double x = u[i] < 0.5 ? from_end(p, u[i], true) : from_end(p, 1 - u[i], false);
    physical.x.push_back(std::clamp(x, p.lower, p.upper));
  }
  return physical;
}

double ParameterSpace::unit_position(std::size_t i, double x) const {
  const Parameter &p = parameter(i);
  return distance_from_lower(p, x) / range_of(p);
}

PhysicalPoint ParameterSpace::start() const {
  PhysicalPoint point = to_physical({std::vector<double>(n(), 0.0)});
  for (std::size_t i = 0; i < n(); ++i)
    if (parameters_[i].start) point.x[i] = *parameters_[i].start;
  return point;
}

double ParameterSpace::dx_dz(std::size_t i, double z) const {
  const Parameter &p = parameter(i);
  const double tail = std::exp(-std::abs(z)), du_dz = tail / ((1 + tail) * (1 + tail));
  return (p.scale == Scale::logarithmic ? physical_of(p, z) : 1) * range_of(p) * du_dz;
}

BoundSide ParameterSpace::at_bound(std::size_t i, double x, double fraction) const {
  const Parameter &p = parameter(i);
  const double range = range_of(p);
  if (distance_from_lower(p, x) <= fraction * range) return BoundSide::lower;
  if (distance_from_upper(p, x) <= fraction * range) return BoundSide::upper;
  return BoundSide::none;
}

}  // namespace bondlab
