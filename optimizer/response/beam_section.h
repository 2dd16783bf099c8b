// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the section of a beam or bar from the deck variables: area, second moment, shear coefficient.
// Method: 2D: a rectangle, depth `height`, breadth `thickness`; 3D: a prism, depth `height`, breadth
//   `width`, if `length` is above 0, else a round bar of `diameter`. Shear coefficient after Cowper
//   1966: 10(1+nu)/(12+11nu) rectangle, 6(1+nu)/(7+6nu) circle.
// Units: SI. Failure: ResponseError for a variable that is absent or not positive.
#pragma once

#include <cmath>

#include "response/response.h"

namespace bondlab {

struct BeamSection {
  bool round = false;
  double depth = 0, breadth = 0;  // m; the diameter in depth if round
  double area() const { return round ? M_PI * depth * depth / 4 : breadth * depth; }
  double inertia() const {
    return round ? M_PI * std::pow(depth, 4) / 64 : breadth * std::pow(depth, 3) / 12;
  }
  double shear_factor(double nu) const {
    return round ? 6 * (1 + nu) / (7 + 6 * nu) : 10 * (1 + nu) / (12 + 11 * nu);
  }
};

inline BeamSection beam_section(const ResponseContext &context) {
  if (context.positive("dim") == 2)
    return {false, context.positive("height"), context.positive("thickness")};
  const auto length = context.variables.find("length");
  if (length != context.variables.end() && length->second > 0)
    return {false, context.positive("height"), context.positive("width")};
  return {true, context.positive("diameter"), 0};
}

}  // namespace bondlab
