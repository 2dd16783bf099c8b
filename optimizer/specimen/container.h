// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the rigid container of a packing: a rectangle or disc (2D) or a cylinder (3D), as distances
//   to its walls.
// Method: every wall is a plane or the inside of a circle or circular cylinder, so the distance
//   and the inward normal are closed forms; no mesh. The places are those of the specimen file:
//   rectangle x in [-W/2, W/2], y in [0, H]; disc centred at the origin; cylinder with axis z,
//   z in [0, H].
// Units: any one length unit (the generator works in mean radii, everything else in m).
// Failure: UserError for an unknown shape name; sizes are judged by check_request() in
//   specimen.h, not here.
#pragma once

#include <cmath>
#include <string>

namespace bondlab {

enum class ContainerShape { rectangle, disc, cylinder };

std::string shape_name(ContainerShape shape);
// UserError when the name isn't rectangle, disc or cylinder.
ContainerShape shape_from_name(const std::string &name);

// One particle, four doubles wide so that the relaxation loop loads it at once.
struct Particle {
  double x = 0, y = 0, z = 0, r = 0;
};

class Container {
 public:
  // Rectangle: width, height. Disc: diameter. Cylinder: diameter, height. Other sizes are ignored.
  Container(ContainerShape shape, double width, double height, double diameter);

  ContainerShape shape() const { return shape_; }
  int dimension() const { return shape_ == ContainerShape::cylinder ? 3 : 2; }
  // Area (2D) or volume (3D).
  double measure() const;
  // Perimeter (2D) or surface (3D).
  double boundary() const;
  // The smallest of the sizes.
  double smallest_size() const;
  // Corners of the smallest axis-parallel box around it; z is 0 in 2D.
  void bounds(double lo[3], double hi[3]) const;
  // Distance from a point to the nearest wall, negative outside.
  double depth(double x, double y, double z) const;

  // Calls visit(distance, nx, ny, nz, wall) for each wall nearer to the point than reach; n points
  // inwards. wall: 0 bottom (y = 0 or z = 0), 1 top, 2 left, 3 right, 4 curved.
  template <class Visit>
  void walls_within(double x, double y, double z, double reach, Visit &&visit) const {
    if (shape_ == ContainerShape::rectangle) {
      if (y < reach) visit(y, 0.0, 1.0, 0.0, 0);
      if (height_ - y < reach) visit(height_ - y, 0.0, -1.0, 0.0, 1);
      if (x + 0.5 * width_ < reach) visit(x + 0.5 * width_, 1.0, 0.0, 0.0, 2);
      if (0.5 * width_ - x < reach) visit(0.5 * width_ - x, -1.0, 0.0, 0.0, 3);
      return;
    }
    if (shape_ == ContainerShape::cylinder) {
      if (z < reach) visit(z, 0.0, 0.0, 1.0, 0);
      if (height_ - z < reach) visit(height_ - z, 0.0, 0.0, -1.0, 1);
    }
    const double radius = 0.5 * diameter_;
    const double rho2 = x * x + y * y;
    const double inner = radius - reach;
    if (inner <= 0 || rho2 > inner * inner) {
      const double rho = std::sqrt(rho2);
      if (rho > 0) visit(radius - rho, -x / rho, -y / rho, 0.0, 4);
    }
  }

 private:
  ContainerShape shape_;
  double width_, height_, diameter_;
};

}  // namespace bondlab
