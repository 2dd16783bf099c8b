// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the particles of a packing that grows one by one, and the surfaces (of particles and walls)
//   near a point of it: what fill.h and insertion.h place new particles by.
// Method: particles in cells of twice the largest radius, so that all that a particle can touch are
//   in the cells around its own; walls from the container's closed forms.
// Units: any one length unit. Failure: none.
// Limits: surfaces farther than a cell's edge are not seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "specimen/container.h"

namespace bondlab {

struct Surface {
  double distance;  // of a point from it, negative within a particle or outside the walls
  double n[3];      // away from it
  long id;          // the particle's index, or -1 - wall (container.h)
};

class GrowingPacking {
 public:
  GrowingPacking(const Container &container, double r_max);

  void add(const Particle &p);

  // How many particles there were when the last one was added near this point.
  std::size_t last_change(const Particle &at) const;

  // Distance from a point to the nearest surface, negative within one; at most a cell's edge.
  double clearance(const Particle &at) const;

  // The `count` nearest surfaces, or as many as there are within a cell's edge; how many that is.
  int nearest_surfaces(const Particle &at, int count, Surface *found) const;

  // The surface `id` as seen from another point; false where it has no normal (a particle's middle,
  // the axis of a round wall).
  bool surface(const Particle &at, long id, Surface &seen) const;

  std::vector<Particle> particles;  // grows by add() only

 private:
  void cell_of(const Particle &p, long c[3]) const;
  std::size_t index(long x, long y, long z) const {
    return static_cast<std::size_t>((z * cells_[1] + y) * cells_[0] + x);
  }
  template <class Visit>
  void around(const Particle &at, Visit &&visit) const {
    long c[3];
    cell_of(at, c);
    for (long z = std::max(0L, c[2] - 1); z <= std::min(cells_[2] - 1, c[2] + 1); ++z)
      for (long y = std::max(0L, c[1] - 1); y <= std::min(cells_[1] - 1, c[1] + 1); ++y)
        for (long x = std::max(0L, c[0] - 1); x <= std::min(cells_[0] - 1, c[0] + 1); ++x)
          for (const std::size_t i : inside_[index(x, y, z)]) visit(i);
  }

  const Container &container_;
  const double edge_;
  double lo_[3], hi_[3];
  long cells_[3];
  std::vector<std::vector<std::size_t>> inside_;
  std::vector<std::size_t> changed_;
  mutable std::vector<Surface> surfaces_;
};

}  // namespace bondlab
