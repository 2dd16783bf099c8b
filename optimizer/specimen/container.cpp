// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/container.h"

#include <array>

#include "base/user_error.h"

namespace bondlab {

namespace {

constexpr double pi = 3.14159265358979323846;

struct ShapeEntry {
  ContainerShape shape;
  const char *name;
  bool flat, notch;
  std::vector<NamedDimension> sizes;
};

const std::array<ShapeEntry, 5> &shapes() {
  constexpr NamedDimension width{"width", &Dimensions::width},
      height{"height", &Dimensions::height}, diameter{"diameter", &Dimensions::diameter},
      length{"length", &Dimensions::length};
  static const std::array<ShapeEntry, 5> table = {
      {{ContainerShape::rectangle, "rectangle", true, true, {width, height}},
       {ContainerShape::disc, "disc", true, false, {diameter}},
       {ContainerShape::cylinder, "cylinder", false, true, {height, diameter}},
       {ContainerShape::prism, "prism", false, true, {width, height, length}},
       {ContainerShape::sphere, "sphere", false, false, {diameter}}}};
  return table;
}

const ShapeEntry &entry_of(ContainerShape shape) {
  return shapes()[static_cast<std::size_t>(shape)];
}

// Area that a chord at height `sagitta` cuts off a circle: the integral of 2 sqrt(2 R t - t^2) with
// t = s^2, by Simpson's rule. Not by the arc cosine, which is rounded differently from one C
// library to the next and would make the count of particles depend on it.
double segment_area(double radius, double sagitta) {
  constexpr int intervals = 256;
  const double step = std::sqrt(sagitta) / intervals;
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double s = i * step;
    const double weight = i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * 4 * s * s * std::sqrt(std::max(2 * radius - s * s, 0.0));
  }
  return sum * step / 3;
}

}  // namespace

std::string shape_name(ContainerShape shape) { return entry_of(shape).name; }

bool is_flat(ContainerShape shape) { return entry_of(shape).flat; }

bool can_have_notch(ContainerShape shape) { return entry_of(shape).notch; }

const std::vector<NamedDimension> &dimensions_of(ContainerShape shape) {
  return entry_of(shape).sizes;
}

std::vector<std::string> container_shape_names() {
  std::vector<std::string> names;
  for (const ShapeEntry &entry : shapes()) names.push_back(entry.name);
  return names;
}

ContainerShape shape_from_name(const std::string &name) {
  for (const ShapeEntry &entry : shapes())
    if (name == entry.name) return entry.shape;
  throw UserError("unknown specimen shape \"" + name +
                  "\" (allowed: " + join(container_shape_names()) + ")");
}

Container::Container(ContainerShape shape, const Dimensions &size) : shape_(shape), size_(size) {
  if (!can_have_notch(shape)) size_.notch_depth = size_.notch_width = 0;
}

double Container::measure() const {
  const Dimensions &s = size_;
  const double circle = 0.25 * pi * s.diameter * s.diameter, notch = s.notch_depth * s.notch_width;
  switch (shape_) {
    case ContainerShape::rectangle:
      return s.width * s.height - notch;
    case ContainerShape::disc:
      return circle;
    case ContainerShape::cylinder:
      return circle * s.height -
             (has_notch() ? s.notch_width * segment_area(0.5 * s.diameter, s.notch_depth) : 0);
    case ContainerShape::prism:
      return (s.height * s.length - notch) * s.width;
    case ContainerShape::sphere:
      return circle * s.diameter * 2 / 3;
  }
  return 0;
}

double Container::boundary() const {
  const Dimensions &s = size_;
  switch (shape_) {
    case ContainerShape::rectangle:
      return 2 * (s.width + s.height) + 2 * s.notch_depth;
    case ContainerShape::disc:
      return pi * s.diameter;
    case ContainerShape::cylinder:  // the slot's end is about as large as the arc it takes away
      return pi * s.diameter * s.height + 0.5 * pi * s.diameter * s.diameter +
             (has_notch() ? 2 * segment_area(0.5 * s.diameter, s.notch_depth) : 0);
    case ContainerShape::prism:
      return 2 * (s.width * s.height + s.height * s.length + s.length * s.width) +
             2 * s.notch_depth * (s.width - s.notch_width);
    case ContainerShape::sphere:
      return pi * s.diameter * s.diameter;
  }
  return 0;
}

double Container::smallest_size() const {
  const Dimensions &s = size_;
  double smallest = INFINITY;
  for (const NamedDimension &dimension : dimensions_of(shape_))
    smallest = std::min(smallest, s.*dimension.value);
  if (!has_notch()) return smallest;
  const double across = shape_ == ContainerShape::cylinder ? s.diameter : s.height;
  const double along = shape_ == ContainerShape::rectangle  ? s.width
                       : shape_ == ContainerShape::cylinder ? s.height
                                                            : s.length;
  return std::min({smallest, across - s.notch_depth, 0.5 * (along - s.notch_width)});
}

void Container::bounds(double lo[3], double hi[3]) const {
  const double radius = 0.5 * size_.diameter;
  const double half[3] = {0.5 * size_.width, 0.5 * size_.height, 0};
  lo[2] = hi[2] = 0;
  if (shape_ == ContainerShape::rectangle || shape_ == ContainerShape::prism) {
    for (int k = 0; k < 2; ++k) lo[k] = -half[k], hi[k] = half[k];
    if (shape_ == ContainerShape::rectangle) lo[1] = 0, hi[1] = size_.height;
    if (shape_ == ContainerShape::prism) hi[2] = size_.length;
    return;
  }
  lo[0] = lo[1] = -radius;
  hi[0] = hi[1] = radius;
  if (shape_ == ContainerShape::cylinder) hi[2] = size_.height;
  if (shape_ == ContainerShape::sphere) lo[2] = -radius, hi[2] = radius;
}

double Container::depth(double x, double y, double z) const {
  double nearest = has_notch() ? notch_wall(notch_place(x, y, z)).distance : INFINITY;
  switch (shape_) {
    case ContainerShape::rectangle:
      return std::min({nearest, y, size_.height - y, 0.5 * size_.width - std::fabs(x)});
    case ContainerShape::prism:
      return std::min({nearest, z, size_.length - z, 0.5 * size_.width - std::fabs(x),
                       0.5 * size_.height - std::fabs(y)});
    case ContainerShape::cylinder:
      nearest = std::min({nearest, z, size_.height - z});
      break;
    case ContainerShape::disc:
    case ContainerShape::sphere:
      break;
  }
  const double up = shape_ == ContainerShape::sphere ? z : 0;
  return std::min(nearest, 0.5 * size_.diameter - std::sqrt(x * x + y * y + up * up));
}

bool Container::crosses_notch(const Particle &a, const Particle &b) const {
  if (!has_notch()) return false;
  const NotchPlace from = notch_place(a.x, a.y, a.z), to = notch_place(b.x, b.y, b.z);
  const double half = 0.5 * size_.notch_width, along = to.along - from.along;
  // The part of the line that is between the slot's sides.
  double first = 0, last = 1;
  if (along == 0) {
    if (std::fabs(from.along) >= half) return false;
  } else {
    const double in = (-half - from.along) / along, out = (half - from.along) / along;
    first = std::max(first, std::min(in, out));
    last = std::min(last, std::max(in, out));
    if (first >= last) return false;
  }
  const auto above = [&](double share) { return from.above + share * (to.above - from.above); };
  return std::min(above(first), above(last)) < size_.notch_depth;
}

// The slot is |along| < half its width below its depth, without end downwards: a point inside is
// pushed out sideways or up, never further down.
Container::NotchWall Container::notch_wall(const NotchPlace &at) const {
  const double side = at.along < 0 ? -1 : 1;
  const double beside = std::fabs(at.along) - 0.5 * size_.notch_width,
               over = at.above - size_.notch_depth;
  if (beside > 0 && over > 0) {
    const double distance = std::sqrt(beside * beside + over * over);
    return {distance, side * beside / distance, over / distance};
  }
  if (beside > over) return {beside, side, 0};
  return {over, 0, 1};
}

}  // namespace bondlab
