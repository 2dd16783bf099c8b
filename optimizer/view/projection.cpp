// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/projection.h"

#include <algorithm>
#include <cmath>

#include "base/user_error.h"

namespace bondlab {

namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double turn = 30 * degree, tip = 20 * degree;

double dot(const Vector3 &a, const Vector3 &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 cross(const Vector3 &a, const Vector3 &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 axis(int k) {
  Vector3 unit{};
  unit[static_cast<std::size_t>(k)] = 1;
  return unit;
}

// Extent without the outermost 1 % at each end: what has flown off doesn't count.
double extent(const RunView &run, std::size_t k, double *middle) {
  std::vector<double> values;
  for (const ViewParticle &p : run.particles) values.push_back(p.start[k]);
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 100;
  const double low = values[cut], high = values[values.size() - 1 - cut];
  *middle = 0.5 * (low + high);
  return high - low;
}

std::string chosen_plane(const double size[3]) {
  const double across = std::max(size[0], size[1]);
  if (size[2] < 0.8 * across) return "xy";  // a disc
  if (size[2] > 2.7 * across) return "zy";  // a beam
  return "xz";
}

}  // namespace

Projection::Projection(const RunView &run, Look3d look, const std::string &plane)
    : flat_(run.dimension == 2), whole_(run.dimension == 3 && look == Look3d::whole) {
  double size[3], middle[3] = {0, 0, 0}, r_mean = 0;
  for (std::size_t k = 0; k < 3; ++k) size[k] = extent(run, k, &middle[k]);
  for (const ViewParticle &p : run.particles)
    r_mean += p.r / static_cast<double>(run.particles.size());
  if (!plane.empty()) {
    const auto is_axis = [](char c) { return c == 'x' || c == 'y' || c == 'z'; };
    if (plane.size() != 2 || !is_axis(plane[0]) || !is_axis(plane[1]) || plane[0] == plane[1])
      throw UserError("the plane is \"" + plane +
                      "\" (allowed: two of x, y and z, horizontal and vertical: xy, xz, zy ...)");
    names_ = plane;
  } else {
    names_ = flat_ ? "xy" : chosen_plane(size);
  }
  const Vector3 right = axis(names_[0] - 'x'), up = axis(names_[1] - 'x');
  // Right-handed, so that a look from a side isn't a mirror image; of a slice the reader may stand
  // on either side.
  const Vector3 towards = cross(right, up);
  axes_ = {right, up, towards};
  if (whole_) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double turned = -std::sin(turn) * right[k] + std::cos(turn) * towards[k];
      axes_[0][k] = std::cos(turn) * right[k] + std::sin(turn) * towards[k];
      axes_[1][k] = std::cos(tip) * up[k] - std::sin(tip) * turned;
      axes_[2][k] = std::sin(tip) * up[k] + std::cos(tip) * turned;
    }
  }
  plane_ = whole_ || flat_ ? 0 : dot(axes_[2], {middle[0], middle[1], middle[2]});
  half_ = r_mean;
}

std::string Projection::horizontal() const { return names_.substr(0, 1); }
std::string Projection::vertical() const { return names_.substr(1, 1); }

std::string Projection::words() const {
  if (whole_) return "seen from a side, " + vertical() + " up";
  const std::string plane = horizontal() + "\u2013" + vertical();
  return flat_ ? plane + " plane" : plane + " slice through the middle";
}

Projection::Place Projection::at(const Vector3 &place) const {
  return {dot(axes_[0], place), dot(axes_[1], place), dot(axes_[2], place) - plane_};
}

double Projection::radius(const Vector3 &place, double r) const {
  if (!slice()) return r;
  const double off = at(place).depth;
  return std::fabs(off) < r ? std::sqrt(r * r - off * off) : 0;
}

bool Projection::shows(const Vector3 &place) const {
  return !slice() || std::fabs(at(place).depth) <= half_;
}

}  // namespace bondlab
