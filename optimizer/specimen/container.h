// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the rigid container of a packing, as distances to its walls: a rectangle or disc (2D), a
//   cylinder, prism or sphere (3D), with or without a notch.
// Method: every wall is a plane or the inside of a circle, circular cylinder or sphere, so the
//   distance and the inward normal are closed forms; no mesh. A notch is a slot with flat sides
//   and a flat end; the nearest point of it is a closed form too, and seen from the specimen it is
//   convex as a particle is.
//   The places are those of the specimen file:
//     rectangle  x in [-width/2, width/2], y in [0, height]
//     disc       centred at the origin
//     cylinder   axis z, z in [0, height]
//     prism      x in [-width/2, width/2], y in [-height/2, height/2], z in [0, length]
//     sphere     centred at the origin
//   A notch lies in the middle of the long side: of a rectangle at x = 0, open towards -y; of a
//   cylinder (a round bar) at z = height/2 and of a prism (a beam) at z = length/2, both open
//   towards -y and as deep everywhere across x.
// Units: any one length unit (the generator works in mean radii, everything else in m).
// Failure: UserError for an unknown shape name; sizes are judged by check_request() in
//   specimen.h, not here.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bondlab {

enum class ContainerShape { rectangle, disc, cylinder, prism, sphere };

std::string shape_name(ContainerShape shape);
// UserError when the name is none of container_shape_names().
ContainerShape shape_from_name(const std::string &name);
std::vector<std::string> container_shape_names();
bool is_flat(ContainerShape shape);  // 2D

struct Dimensions {
  double width = 0, height = 0, diameter = 0, length = 0;  // those the shape has
  double notch_depth = 0, notch_width = 0;                 // depth 0: no notch
};

// A size of a shape under the name it has in options, studies and files.
struct NamedDimension {
  const char *name;
  double Dimensions::*value;
};
// Those a shape has, in the order of the files; the two of the notch are not among them.
const std::vector<NamedDimension> &dimensions_of(ContainerShape shape);
bool can_have_notch(ContainerShape shape);

// One particle, four doubles wide so that the relaxation loop loads it at once.
struct Particle {
  double x = 0, y = 0, z = 0, r = 0;
};

class Container {
 public:
  // Sizes that the shape doesn't have are ignored.
  Container(ContainerShape shape, const Dimensions &size);
  Container(ContainerShape shape, double width, double height, double diameter)
      : Container(shape, Dimensions{width, height, diameter}) {}

  ContainerShape shape() const { return shape_; }
  const Dimensions &size() const { return size_; }
  int dimension() const { return is_flat(shape_) ? 2 : 3; }
  // Area (2D) or volume (3D), without the notch.
  double measure() const;
  // Perimeter (2D) or surface (3D), the notch's included.
  double boundary() const;
  // The smallest of the sizes; with a notch also what is left above and beside it.
  double smallest_size() const;
  // Corners of the smallest axis-parallel box around it; z is 0 in 2D.
  void bounds(double lo[3], double hi[3]) const;
  // Distance from a point to the nearest wall, negative outside.
  double depth(double x, double y, double z) const;

  bool has_notch() const { return size_.notch_depth > 0; }
  // The place of a point relative to the notch: `along` the specimen from the notch's middle,
  // `above` the face it is cut into.
  struct NotchPlace {
    double along, above;
  };
  NotchPlace notch_place(double x, double y, double z) const {
    if (shape_ == ContainerShape::rectangle) return {x, y};
    if (shape_ == ContainerShape::prism) return {z - 0.5 * size_.length, y + 0.5 * size_.height};
    return {z - 0.5 * size_.height, y + 0.5 * size_.diameter};
  }

  // Whether the straight line between two points runs through the notch.
  bool crosses_notch(const Particle &a, const Particle &b) const;

  // Calls visit(distance, nx, ny, nz, wall) for each wall nearer to the point than reach; n points
  // inwards. wall: 0 bottom (y = 0 of a rectangle, z = 0 of a cylinder or prism), 1 top, 2 left,
  // 3 right, 4 curved, 5 and 6 the low and high side of a prism in y, 7 the notch.
  template <class Visit>
  void walls_within(double x, double y, double z, double reach, Visit &&visit) const {
    if (has_notch()) visit_notch(x, y, z, reach, visit);
    if (shape_ == ContainerShape::rectangle) {
      visit_pair(y, size_.height - y, 1, reach, 0, visit);
      visit_pair(x + 0.5 * size_.width, 0.5 * size_.width - x, 0, reach, 2, visit);
      return;
    }
    if (shape_ == ContainerShape::prism) {
      visit_pair(z, size_.length - z, 2, reach, 0, visit);
      visit_pair(x + 0.5 * size_.width, 0.5 * size_.width - x, 0, reach, 2, visit);
      visit_pair(y + 0.5 * size_.height, 0.5 * size_.height - y, 1, reach, 5, visit);
      return;
    }
    if (shape_ == ContainerShape::cylinder) visit_pair(z, size_.height - z, 2, reach, 0, visit);
    const double radius = 0.5 * size_.diameter;
    const double up = shape_ == ContainerShape::sphere ? z : 0.0;
    const double rho2 = x * x + y * y + up * up;
    const double inner = radius - reach;
    if (inner <= 0 || rho2 > inner * inner) {
      const double rho = std::sqrt(rho2);
      if (rho > 0) visit(radius - rho, -x / rho, -y / rho, up == 0 ? 0.0 : -up / rho, 4);
    }
  }

 private:
  // Two parallel planes across `axis`.
  template <class Visit>
  static void visit_pair(double low, double high, int axis, double reach, int wall, Visit &&visit) {
    if (low < reach)
      visit(low, axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0, wall);
    if (high < reach)
      visit(high, axis == 0 ? -1.0 : 0.0, axis == 1 ? -1.0 : 0.0, axis == 2 ? -1.0 : 0.0, wall + 1);
  }
  struct NotchWall {
    double distance, along, above;  // of the nearest point; direction away from it
  };
  NotchWall notch_wall(const NotchPlace &at) const;
  template <class Visit>
  void visit_notch(double x, double y, double z, double reach, Visit &&visit) const {
    const NotchWall wall = notch_wall(notch_place(x, y, z));
    if (wall.distance >= reach) return;
    if (shape_ == ContainerShape::rectangle)
      visit(wall.distance, wall.along, wall.above, 0.0, 7);
    else
      visit(wall.distance, 0.0, wall.above, wall.along, 7);
  }

  ContainerShape shape_;
  Dimensions size_;
};

}  // namespace bondlab
