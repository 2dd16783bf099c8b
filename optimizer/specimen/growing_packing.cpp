// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/growing_packing.h"

#include <limits>

namespace bondlab {

namespace {

double distance(const Particle &a, const Particle &b) {
  const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

}  // namespace

GrowingPacking::GrowingPacking(const Container &container, double r_max)
    : container_(container), edge_(2 * r_max) {
  container.bounds(lo_, hi_);
  for (int k = 0; k < 3; ++k)
    cells_[k] = std::max<long>(1, static_cast<long>(std::ceil((hi_[k] - lo_[k]) / edge_)));
  inside_.resize(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]));
  changed_.resize(inside_.size(), 0);
}

void GrowingPacking::cell_of(const Particle &p, long c[3]) const {
  const double at[3] = {p.x, p.y, p.z};
  for (int k = 0; k < 3; ++k)
    c[k] =
        std::clamp<long>(static_cast<long>(std::floor((at[k] - lo_[k]) / edge_)), 0, cells_[k] - 1);
}

void GrowingPacking::add(const Particle &p) {
  long c[3];
  cell_of(p, c);
  inside_[index(c[0], c[1], c[2])].push_back(particles.size());
  particles.push_back(p);
  for (long z = std::max(0L, c[2] - 1); z <= std::min(cells_[2] - 1, c[2] + 1); ++z)
    for (long y = std::max(0L, c[1] - 1); y <= std::min(cells_[1] - 1, c[1] + 1); ++y)
      for (long x = std::max(0L, c[0] - 1); x <= std::min(cells_[0] - 1, c[0] + 1); ++x)
        changed_[index(x, y, z)] = particles.size();
}

std::size_t GrowingPacking::last_change(const Particle &at) const {
  long c[3];
  cell_of(at, c);
  return changed_[index(c[0], c[1], c[2])];
}

double GrowingPacking::clearance(const Particle &at) const {
  double nearest = std::min(edge_, container_.depth(at.x, at.y, at.z));
  around(at, [&](std::size_t i) {
    nearest = std::min(nearest, distance(at, particles[i]) - particles[i].r);
  });
  return nearest;
}

int GrowingPacking::nearest_surfaces(const Particle &at, int count, Surface *found) const {
  surfaces_.clear();
  around(at, [&](std::size_t i) {
    const Particle &p = particles[i];
    const double d = distance(at, p);
    if (d > 0 && d - p.r < edge_)
      surfaces_.push_back(
          {d - p.r, {(at.x - p.x) / d, (at.y - p.y) / d, (at.z - p.z) / d}, static_cast<long>(i)});
  });
  container_.walls_within(at.x, at.y, at.z, edge_,
                          [&](double d, double nx, double ny, double nz, int wall) {
                            surfaces_.push_back({d, {nx, ny, nz}, -1 - wall});
                          });
  count = std::min(count, static_cast<int>(surfaces_.size()));
  std::partial_sort(surfaces_.begin(), surfaces_.begin() + count, surfaces_.end(),
                    [](const Surface &a, const Surface &b) { return a.distance < b.distance; });
  std::copy(surfaces_.begin(), surfaces_.begin() + count, found);
  return count;
}

bool GrowingPacking::surface(const Particle &at, long id, Surface &seen) const {
  if (id >= 0) {
    const Particle &p = particles[static_cast<std::size_t>(id)];
    const double d = distance(at, p);
    if (!(d > 0)) return false;
    seen = {d - p.r, {(at.x - p.x) / d, (at.y - p.y) / d, (at.z - p.z) / d}, id};
    return true;
  }
  bool found = false;
  container_.walls_within(at.x, at.y, at.z, std::numeric_limits<double>::infinity(),
                          [&](double d, double nx, double ny, double nz, int wall) {
                            if (-1 - wall != id) return;
                            seen = {d, {nx, ny, nz}, id};
                            found = true;
                          });
  return found;
}

}  // namespace bondlab
