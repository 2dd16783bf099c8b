// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the only place that transforms a parameter between its physical value and the unbounded
// space searches work in. Method: u = (g(x) - g(lower)) / (g(upper) - g(lower)) with g = log or
// identity, z = log(u / (1 - u)). Every z is then
//   inside the bounds, so that no search can ask for a value that isn't allowed. Both directions
//   are computed from the nearer bound, so that nothing is lost by cancellation near either.
// Why a type for each space: passing one where the other is meant doesn't compile.
// Units: physical values in SI; transformed ones have none. Failure: a value outside its bounds or
// a wrong count is a
//   UserError that names the parameter. Limits: |z| is cut at z_limit, where to_physical gives the
//   bound itself, so that a value on a bound has a finite z and comes back exactly; elsewhere the
//   round trip is exact to a few units in the last place (the property test states how many).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/study.h"

namespace bondlab {

struct PhysicalPoint {
  std::vector<double> x;
};
struct TransformedPoint {
  std::vector<double> z;
};

enum class BoundSide { none, lower, upper };

class ParameterSpace {
 public:
  static constexpr double z_limit =
      36.75;  // exp(-36.75) is below half a unit in the last place of 1

  explicit ParameterSpace(const std::vector<Parameter> &parameters);

  std::size_t n() const { return parameters_.size(); }
  const std::vector<std::string> &names() const { return names_; }
  const Parameter &parameter(std::size_t i) const { return parameters_.at(i); }

  PhysicalPoint to_physical(const TransformedPoint &point) const;
  TransformedPoint to_transformed(const PhysicalPoint &point) const;

  // A point of the unit cube (a Latin hypercube's) to the physical space: u is the position between
  // the bounds.
  PhysicalPoint from_unit_cube(const std::vector<double> &u) const;
  double unit_position(std::size_t i, double x) const;  // u of one value

  PhysicalPoint start() const;  // [[parameters]] start, or the middle

  double dx_dz(std::size_t i, double z) const;  // derivative of parameter i's physical value

  // Which bound a value lies at: within `fraction` of the range, measured in u.
  BoundSide at_bound(std::size_t i, double x, double fraction = 0.01) const;

 private:
  std::vector<Parameter> parameters_;
  std::vector<std::string> names_;
};

}  // namespace bondlab
