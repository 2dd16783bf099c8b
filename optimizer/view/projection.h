// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: from the places of a body to the places of a picture: a plane (2D), a slice (3D), or a look
//   at the whole body from a side (3D).
// Method: a slice is the plane through the middle of the body; spheres are the circles it cuts out
//   of them, and lines are shown when both ends are within one mean radius of it. The look from a
//   side is orthographic, turned 30 degrees about the upright axis and tipped by 20, farthest
//   first, with light from the upper left. Upright is y in 2D. In 3D it is the longest axis, unless
//   the body is short (a Brazilian disc: the short axis looks at the reader) or slender (a beam
//   lies: its long axis z to the right, y up).
// Units: m. Failure: UserError for a plane that isn't two of x, y, z. Limits: none.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "view/run_data.h"

namespace bondlab {

enum class Look3d { slice, whole };

class Projection {
 public:
  // plane: two letters, horizontal and vertical axis ("zy"); empty: chosen from the body's extents.
  Projection(const RunView &run, Look3d look, const std::string &plane = "");

  bool flat() const { return flat_; }    // 2D
  bool whole() const { return whole_; }  // a 3D body from a side
  bool slice() const { return !flat_ && !whole_; }
  std::string words() const;       // "x-z slice through the middle"
  std::string horizontal() const;  // name of the axis
  std::string vertical() const;

  // In the picture, m; depth grows towards the reader, 0 in the slice's plane.
  struct Place {
    double x, y, depth;
  };
  Place at(const Vector3 &place) const;
  // Radius of the circle drawn for a sphere; 0 when it isn't in the picture.
  double radius(const Vector3 &place, double r) const;
  // Whether a point (a crack, a bond) belongs into the picture.
  bool shows(const Vector3 &place) const;

 private:
  bool flat_ = true, whole_ = false;
  std::array<Vector3, 3> axes_{};  // right, up, towards the reader
  std::string names_ = "xy";
  double plane_ = 0;  // depth of the slice
  double half_ = 0;   // half of its thickness for lines
};

}  // namespace bondlab
