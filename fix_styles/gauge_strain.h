// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: axial and lateral strain of a specimen from the mean displacement of layers of particles, as
// strain gauges and extensometers measure them: free of the platens' compliance and end friction.
//
// Method (ISRM 1979 practice, PHYSICS.md 3.5 and 5.3). With u the displacement from the reference
// position X and <> the mean over a set of particles,
//     axial   = -(<u_a>_top - <u_a>_bottom) / (<X_a>_top - <X_a>_bottom)      compression positive
//     lateral =  (<u_l>_right - <u_l>_left) / (<X_l>_right - <X_l>_left)      expansion positive
// for layers at two fractions of the height and for strips along the two flanks between the layers.
// In 3D instead of strips the outer shell between the layers: with e the unit vector from the axis
// of the shell to X, at a distance r,
//     lateral =  sum (u - <u>).e / sum r.
// The axis is at the mean position of the shell's particles and the mean displacement is taken off,
// so that a specimen that moves sideways as a whole is not strained. Every particle stays in the
// set of its reference position. Exact for a homogeneous strain, whatever the particles' places.
//
// Sums are exact (exact_sum.h): the same bits on any number of ranks.
// Units: m, 1. Failure: an empty set gives NaN. Limits: small strain: first order in rotation.
#ifndef BONDLAB_GAUGE_STRAIN_H
#define BONDLAB_GAUGE_STRAIN_H

#include <cmath>
#include <limits>

#include "exact_sum.h"

namespace bondlab {

struct GaugeSettings {
  enum Lateral { none, strips, shell };
  int axial = 1;                   // axis, 0 1 2
  double low = 0.25, high = 0.75;  // layers, fractions of the height
  double thickness = 0.0;          // of a layer, m
  Lateral lateral = none;
  int across = 0;      // axis of the strips; of a shell: the two that are not axial
  double strip = 0.0;  // depth of a strip or shell from the surface, m
};

// Where the specimen is; found once from the reference positions and kept.
struct GaugeFrame {
  double lo = 0.0, hi = 0.0;        // of the axial axis, m
  double left = 0.0, right = 0.0;   // surfaces of the flanks in the section, m
  double centre[2] = {0, 0};        // of the section, across, m (to find the shell)
  double radius = 0.0;              // of the section, m
  double shell_centre[2] = {0, 0};  // mean position of the shell's particles, m
};

struct Extent {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
  void add(double x, double radius) {
    if (x - radius < lo) lo = x - radius;
    if (x + radius > hi) hi = x + radius;
  }
};

struct GaugeStrain {
  double axial, lateral;      // 1; lateral NaN if not asked for
  double top, bottom, flank;  // particles
};

class Gauge {
 public:
  Gauge() = default;
  Gauge(const GaugeSettings &settings, const GaugeFrame &frame) : s_(settings), f_(frame) {}

  int first_across() const { return s_.axial == 0 ? 1 : 0; }
  int second_across() const { return s_.axial == 2 ? 1 : 2; }

  double height(double fraction) const { return f_.lo + fraction * (f_.hi - f_.lo); }
  bool in_layer(const double *X, double fraction) const {
    return std::fabs(X[s_.axial] - height(fraction)) <= 0.5 * s_.thickness;
  }
  bool in_section(const double *X) const {
    return X[s_.axial] >= height(s_.low) && X[s_.axial] <= height(s_.high);
  }
  bool in_left(const double *X) const {
    return in_section(X) && X[s_.across] - f_.left <= s_.strip;
  }
  bool in_right(const double *X) const {
    return in_section(X) && f_.right - X[s_.across] <= s_.strip;
  }
  bool in_shell(const double *X) const {
    return in_section(X) && std::hypot(X[first_across()] - f_.centre[0],
                                       X[second_across()] - f_.centre[1]) >= f_.radius - s_.strip;
  }

  void add(const double *X, const double *u) {
    if (in_layer(X, s_.high)) add_to(top, X[s_.axial], u[s_.axial]);
    if (in_layer(X, s_.low)) add_to(bottom, X[s_.axial], u[s_.axial]);
    if (s_.lateral == GaugeSettings::strips) {
      if (in_right(X)) add_to(right, X[s_.across], u[s_.across]);
      if (in_left(X)) add_to(left, X[s_.across], u[s_.across]);
    } else if (s_.lateral == GaugeSettings::shell && in_shell(X)) {
      const int a = first_across(), b = second_across();
      const double x = X[a] - f_.shell_centre[0], y = X[b] - f_.shell_centre[1];
      const double r = std::hypot(x, y);
      const double ex = r > 0.0 ? x / r : 0.0, ey = r > 0.0 ? y / r : 0.0;
      const double values[] = {1.0, u[a], u[b], ex, ey, u[a] * ex + u[b] * ey, r};
      for (int k = 0; k < 7; ++k) sums_.add(flank + k, values[k]);
    }
  }

  static constexpr std::size_t number_of_sums = 13;
  ExactSums<number_of_sums> &sums() { return sums_; }

  GaugeStrain strain() const {
    const auto v = [this](int k) { return sums_.value(k); };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    GaugeStrain g{nan, nan, v(top), v(bottom), 0.0};
    g.axial = -slope(top, bottom);
    if (s_.lateral == GaugeSettings::strips) {
      g.lateral = slope(right, left);
      g.flank = v(right) + v(left);
    } else if (s_.lateral == GaugeSettings::shell) {
      g.flank = v(flank);
      const double drift = (v(flank + 1) * v(flank + 3) + v(flank + 2) * v(flank + 4)) / g.flank;
      g.lateral = (v(flank + 5) - drift) / v(flank + 6);
    }
    return g;
  }

 private:
  // places of the sums: count, position, displacement
  enum { top = 0, bottom = 3, right = 6, left = 9, flank = 6 };

  void add_to(int set, double position, double displacement) {
    sums_.add(set, 1.0);
    sums_.add(set + 1, position);
    sums_.add(set + 2, displacement);
  }
  double slope(int a, int b) const {
    const double na = sums_.value(a), nb = sums_.value(b);
    const double distance = sums_.value(a + 1) / na - sums_.value(b + 1) / nb;
    return (sums_.value(a + 2) / na - sums_.value(b + 2) / nb) / distance;  // 0/0 if one is empty
  }

  GaugeSettings s_;
  GaugeFrame f_;
  ExactSums<number_of_sums> sums_;
};

}  // namespace bondlab

#endif
