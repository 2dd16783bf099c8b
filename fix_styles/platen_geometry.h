// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: where a sphere (or disc) stands relative to a platen: signed gap, normal, contact point; and
// how far the platen must move, or grow, to touch without pressing.
//
// Method: analytic surfaces, so that a platen is as smooth as a ground one and needs no mesh (the
// engine's mesh walls fail in 2D): plane; circular cylinder of endless length, loaded from outside
// or inside; sphere, likewise. The normal points from the platen to the particle; the gap is the
// distance from the surface less the particle's radius, negative when they overlap.
//
// Source: elementary geometry. Units: m. Failure: none; a particle centred on the axis of a
// cylinder (or in the centre of a sphere) gets an arbitrary normal. Limits: no edges: a plane has
// no end, so the part of a specimen beside the platen would be touched as well.
#ifndef BONDLAB_PLATEN_GEOMETRY_H
#define BONDLAB_PLATEN_GEOMETRY_H

#include <cmath>
#include <cstddef>
#include <limits>

#include "laws/pair_geometry.h"

namespace bondlab {

using laws::cross;
using laws::dot;
using laws::Vec3;

inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }

enum class Surface { plane, cylinder, sphere };

struct PlatenGeometry {
  Surface surface = Surface::plane;
  Vec3 point{0, 0, 0};      // of the plane, of the axis, or the centre, m
  Vec3 direction{0, 0, 1};  // unit: normal of the plane (to the particles) or axis of the cylinder
  double radius = 0.0;      // of cylinder and sphere, m
  bool inside = false;      // particles are inside the cylinder or sphere
};

struct PlatenTouch {
  double gap;   // m, negative: overlap
  Vec3 normal;  // unit, from the platen to the particle
  Vec3 point;   // on the platen's surface, nearest to the particle, m
};

// The part of x that the distance from an axis or a centre is made of.
inline Vec3 across(const PlatenGeometry &p, Vec3 x) {
  return p.surface == Surface::cylinder ? x - dot(x, p.direction) * p.direction : x;
}

inline PlatenTouch touch(const PlatenGeometry &p, Vec3 centre, double radius) {
  const Vec3 from_point = centre - p.point;
  if (p.surface == Surface::plane) {
    const double height = dot(from_point, p.direction);
    return {height - radius, p.direction, centre - height * p.direction};
  }
  const Vec3 r = across(p, from_point);
  const double distance = length(r);
  Vec3 outward;
  if (distance > 0.0) {
    outward = (1.0 / distance) * r;
  } else {  // any direction will do
    const Vec3 d = p.direction;
    const Vec3 other = std::fabs(d.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    outward = cross(d, other);
    outward = (1.0 / length(outward)) * outward;
  }
  const double to_surface = p.inside ? p.radius - distance : distance - p.radius;
  const Vec3 normal = p.inside ? -1.0 * outward : outward;
  return {to_surface - radius, normal, centre - to_surface * normal};
}

// How far the platen can be moved along the unit vector `along` until it touches this particle
// (negative: back). Infinite if it would never meet it. For a hollow surface, the wall behind.
inline double travel_to_touch(const PlatenGeometry &p, Vec3 along, Vec3 centre, double radius) {
  const double never = std::numeric_limits<double>::infinity();
  if (p.surface == Surface::plane) {
    const double approach = dot(along, p.direction);
    return approach > 0.0 ? touch(p, centre, radius).gap / approach : never;
  }
  // |r - s a| = distance of centres or axes at touch
  const Vec3 r = across(p, centre - p.point), a = across(p, along);
  const double reach = p.inside ? p.radius - radius : p.radius + radius;
  const double aa = dot(a, a), ar = dot(a, r), c = dot(r, r) - reach * reach;
  const double discriminant = ar * ar - aa * c;
  if (aa < 1e-24 || reach < 0.0 || discriminant < 0.0) return never;
  const double root = std::sqrt(discriminant);
  return p.inside ? (ar + root) / aa : (ar - root) / aa;
}

// Marks with 1 the particles that may touch, 0 the rest: a quick sweep over x[n][3], radius[n]. May
// mark a particle that is off by up to 1e-9 of its radius; never misses one (unless the radius is
// below 1e-7 of the distance from the origin, where rounding is larger than that).
inline void mark_near(const PlatenGeometry &p, const double *__restrict x,
                      const double *__restrict radius, std::size_t n,
                      unsigned char *__restrict near) {
  const double px = p.point.x, py = p.point.y, pz = p.point.z;
  const double dx = p.direction.x, dy = p.direction.y, dz = p.direction.z;
  constexpr double slack = 1.0 + 1e-9;
  if (p.surface == Surface::plane) {
    for (std::size_t i = 0; i < n; ++i) {
      const double height =
          (x[3 * i] - px) * dx + (x[3 * i + 1] - py) * dy + (x[3 * i + 2] - pz) * dz;
      near[i] = height < slack * radius[i];
    }
    return;
  }
  const double along = p.surface == Surface::cylinder ? 1.0 : 0.0;
  const double side = p.inside ? -1.0 : 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double rx = x[3 * i] - px, ry = x[3 * i + 1] - py, rz = x[3 * i + 2] - pz;
    const double height = along * (rx * dx + ry * dy + rz * dz);
    const double ax = rx - height * dx, ay = ry - height * dy, az = rz - height * dz;
    const double reach = p.radius + side * slack * radius[i];  // touching when nearer, or farther
    const double square = (ax * ax + ay * ay + az * az) - reach * std::fabs(reach);
    near[i] = side * square < 0.0;
  }
}

// Moves a plane along its normal, or changes the radius, so that a smallest gap becomes zero.
inline void close_gap(PlatenGeometry &p, double gap) {
  if (p.surface == Surface::plane)
    p.point = p.point + gap * p.direction;
  else
    p.radius += p.inside ? -gap : gap;
}

}  // namespace bondlab

#endif
