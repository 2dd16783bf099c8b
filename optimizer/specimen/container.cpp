// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/container.h"

#include <algorithm>

#include "base/user_error.h"

namespace bondlab {

namespace {
constexpr double pi = 3.14159265358979323846;
}

std::string shape_name(ContainerShape shape) {
  switch (shape) {
    case ContainerShape::rectangle:
      return "rectangle";
    case ContainerShape::disc:
      return "disc";
    case ContainerShape::cylinder:
      return "cylinder";
  }
  return "unknown";
}

ContainerShape shape_from_name(const std::string &name) {
  if (name == "rectangle") return ContainerShape::rectangle;
  if (name == "disc") return ContainerShape::disc;
  if (name == "cylinder") return ContainerShape::cylinder;
  throw UserError("unknown specimen shape \"" + name + "\" (allowed: rectangle, disc, cylinder)");
}

Container::Container(ContainerShape shape, double width, double height, double diameter)
    : shape_(shape), width_(width), height_(height), diameter_(diameter) {}

double Container::measure() const {
  if (shape_ == ContainerShape::rectangle) return width_ * height_;
  const double circle = 0.25 * pi * diameter_ * diameter_;
  return shape_ == ContainerShape::disc ? circle : circle * height_;
}

double Container::boundary() const {
  if (shape_ == ContainerShape::rectangle) return 2 * (width_ + height_);
  if (shape_ == ContainerShape::disc) return pi * diameter_;
  return pi * diameter_ * height_ + 0.5 * pi * diameter_ * diameter_;
}

double Container::smallest_size() const {
  if (shape_ == ContainerShape::rectangle) return std::min(width_, height_);
  if (shape_ == ContainerShape::disc) return diameter_;
  return std::min(diameter_, height_);
}

void Container::bounds(double lo[3], double hi[3]) const {
  const double radius = 0.5 * diameter_;
  lo[2] = hi[2] = 0;
  if (shape_ == ContainerShape::rectangle) {
    lo[0] = -0.5 * width_;
    hi[0] = 0.5 * width_;
    lo[1] = 0;
    hi[1] = height_;
    return;
  }
  lo[0] = lo[1] = -radius;
  hi[0] = hi[1] = radius;
  if (shape_ == ContainerShape::cylinder) hi[2] = height_;
}

double Container::depth(double x, double y, double z) const {
  if (shape_ == ContainerShape::rectangle)
    return std::min(std::min(y, height_ - y), 0.5 * width_ - std::fabs(x));
  const double side = 0.5 * diameter_ - std::sqrt(x * x + y * y);
  return shape_ == ContainerShape::disc ? side : std::min(side, std::min(z, height_ - z));
}

}  // namespace bondlab
