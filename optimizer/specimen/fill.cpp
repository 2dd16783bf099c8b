// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/fill.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bondlab {

namespace {

constexpr double grid_over_smallest = 0.7;  // spacing of the starting points, in smallest radii
constexpr int most_passes = 60;             // over the points, of each of the two parts
constexpr int most_choices = 6;             // of touching surfaces from one starting point

struct Surface {
  double distance;  // of a point from it
  double n[3];      // away from it
};

// Particles in cells of twice the largest radius: all that a particle can touch are in the cells
// around its own.
class Filling {
 public:
  Filling(const Container &container, double r_max)
      : container_(container), edge_(2 * r_max), dimension_(container.dimension()) {
    container.bounds(lo_, hi_);
    for (int k = 0; k < 3; ++k)
      cells_[k] = std::max<long>(1, static_cast<long>(std::ceil((hi_[k] - lo_[k]) / edge_)));
    inside_.resize(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]));
    changed_.resize(inside_.size(), 0);
  }

  void add(const Particle &p) {
    long c[3];
    cell_of(p, c);
    inside_[index(c[0], c[1], c[2])].push_back(particles.size());
    particles.push_back(p);
    for (long z = std::max(0L, c[2] - 1); z <= std::min(cells_[2] - 1, c[2] + 1); ++z)
      for (long y = std::max(0L, c[1] - 1); y <= std::min(cells_[1] - 1, c[1] + 1); ++y)
        for (long x = std::max(0L, c[0] - 1); x <= std::min(cells_[0] - 1, c[0] + 1); ++x)
          changed_[index(x, y, z)] = particles.size();
  }

  // How many particles there were when the last one was added near this point.
  std::size_t last_change(const Particle &at) const {
    long c[3];
    cell_of(at, c);
    return changed_[index(c[0], c[1], c[2])];
  }

  // Distance from a point to the nearest surface, negative within one; at most a cell's edge.
  double clearance(const Particle &at) const {
    double nearest = std::min(edge_, container_.depth(at.x, at.y, at.z));
    around(at, [&](const Particle &p) { nearest = std::min(nearest, distance(at, p) - p.r); });
    return nearest;
  }

  // The `count` nearest surfaces, or as many as there are within a cell's edge; how many that is.
  int nearest_surfaces(const Particle &at, int count, Surface *found) const {
    surfaces_.clear();
    around(at, [&](const Particle &p) {
      const double d = distance(at, p);
      if (d > 0 && d - p.r < edge_)
        surfaces_.push_back({d - p.r, {(at.x - p.x) / d, (at.y - p.y) / d, (at.z - p.z) / d}});
    });
    container_.walls_within(at.x, at.y, at.z, edge_,
                            [&](double d, double nx, double ny, double nz, int) {
                              surfaces_.push_back({d, {nx, ny, nz}});
                            });
    count = std::min(count, static_cast<int>(surfaces_.size()));
    std::partial_sort(surfaces_.begin(), surfaces_.begin() + count, surfaces_.end(),
                      [](const Surface &a, const Surface &b) { return a.distance < b.distance; });
    std::copy(surfaces_.begin(), surfaces_.begin() + count, found);
    return count;
  }

  std::vector<Particle> particles;

 private:
  static double distance(const Particle &a, const Particle &b) {
    const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
    return std::sqrt(dx * dx + dy * dy + dz * dz);
  }
  void cell_of(const Particle &p, long c[3]) const {
    const double at[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; ++k)
      c[k] = std::clamp<long>(static_cast<long>(std::floor((at[k] - lo_[k]) / edge_)), 0,
                              cells_[k] - 1);
  }
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
          for (const std::size_t i : inside_[index(x, y, z)]) visit(particles[i]);
  }

  const Container &container_;
  const double edge_;
  const int dimension_;
  double lo_[3], hi_[3];
  long cells_[3];
  std::vector<std::vector<std::size_t>> inside_;
  std::vector<std::size_t> changed_;
  mutable std::vector<Surface> surfaces_;
};

// a x = b with row exchange; false when (nearly) singular.
bool solve(double a[4][5], int n) {
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int i = k + 1; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[best][k])) best = i;
    if (std::fabs(a[best][k]) < 1e-6) return false;
    for (int j = 0; j <= n; ++j) std::swap(a[k][j], a[best][j]);
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  for (int k = 0; k < n; ++k) a[k][n] /= a[k][k];
  return true;
}

// Moves `p` until it touches its nearest surfaces: as many as there are unknowns, which are the
// place and, when `any_radius`, the radius. Near a round wall there may be fewer at first, and it
// touches those by the shortest way. False when that comes to nothing within `reach` of the start.
bool touch(const Filling &filling, Particle &p, int dimension, bool any_radius, double reach) {
  const int unknowns = dimension + (any_radius ? 1 : 0);
  const Particle start = p;
  Surface near[4];
  for (int step = 0; step < 12 * most_choices; ++step) {
    const int count = filling.nearest_surfaces(p, unknowns, near);
    if (count == 0 || (any_radius && count < unknowns)) return false;
    // Rows of the linearised conditions n . h - s = r - d in the move h and the growth s; the move
    // is sum_i lambda_i row_i, the shortest that fulfils them.
    double row[4][4] = {}, a[4][5], worst = 0;
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < dimension; ++k) row[i][k] = near[i].n[k];
      if (any_radius) row[i][dimension] = -1;
      a[i][count] = p.r - near[i].distance;
      worst = std::max(worst, std::fabs(a[i][count]));
    }
    if (worst < 1e-13 * reach) return true;
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) a[i][j] = std::inner_product(row[i], row[i] + 4, row[j], 0.0);
    if (!solve(a, count)) return false;
    double move[4] = {}, length = 0;
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < unknowns; ++k) move[k] += a[i][count] * row[i][k];
    // A long step would leave the surfaces it was made for.
    for (int k = 0; k < dimension; ++k) length = std::max(length, std::fabs(move[k]));
    const double share = length > 0.5 * reach ? 0.5 * reach / length : 1;
    p.x += share * move[0];
    p.y += share * move[1];
    if (dimension == 3) p.z += share * move[2];
    if (any_radius) p.r += share * move[dimension];
    const double dx = p.x - start.x, dy = p.y - start.y, dz = p.z - start.z;
    if (dx * dx + dy * dy + dz * dz > reach * reach) return false;
  }
  return false;
}

}  // namespace

std::vector<Particle> fill_container(const Container &container, const SizeDistribution &sizes,
                                     RandomStream &random) {
  const int dimension = container.dimension();
  const double r_min = sizes.smallest(), r_max = sizes.largest();
  Filling filling(container, r_max);
  double lo[3], hi[3];
  container.bounds(lo, hi);
  std::vector<Particle> points;
  {
    long n[3] = {1, 1, 1};
    double step[3] = {0, 0, 0};
    for (int k = 0; k < dimension; ++k) {
      n[k] = static_cast<long>(std::ceil((hi[k] - lo[k]) / (grid_over_smallest * r_min)));
      step[k] = (hi[k] - lo[k]) / static_cast<double>(n[k]);
    }
    for (long z = 0; z < n[2]; ++z)
      for (long y = 0; y < n[1]; ++y)
        for (long x = 0; x < n[0]; ++x) {
          const auto at = [&](int k, long i) {
            return lo[k] + (static_cast<double>(i) + 0.5) * step[k];
          };
          Particle p{at(0, x), at(1, y), dimension == 3 ? at(2, z) : 0, 0};
          if (container.depth(p.x, p.y, p.z) > 0) points.push_back(p);
        }
  }
  for (const bool any_radius : {false, true}) {
    for (int pass = 0; pass < most_passes; ++pass) {
      random.shuffle(points);
      std::size_t kept = 0, added = 0;
      for (const Particle point : points) {  // a copy: its place in the list is written over
        // The radius of a point holds how many particles there were when it was tried last: without
        // a new one near by it would come to the same hole again.
        if (any_radius && pass > 0 &&
            filling.last_change(point) <= static_cast<std::size_t>(point.r)) {
          points[kept++] = point;
          continue;
        }
        const double room = filling.clearance(point);
        if (room <= 0) continue;  // covered for good
        points[kept] = point;
        points[kept++].r = static_cast<double>(filling.particles.size());
        // Far from all surfaces: its turn comes when the filling has grown to it.
        if (!any_radius && room > 1.5 * r_max) continue;
        Particle p = point;
        p.r = any_radius ? std::max(room, r_min) : sizes.quantile(random.uniform());
        if (!touch(filling, p, dimension, any_radius, 3 * r_max)) continue;
        if (p.r < r_min || p.r > r_max) continue;
        p.r = std::min(p.r, filling.clearance(p));  // the last bits of Newton's rule
        filling.add(p);
        ++added;
      }
      points.resize(kept);
      // Drawn radii fit less and less often; the second part fills what they leave.
      if (added == 0 || (!any_radius && added * 200 < filling.particles.size())) break;
    }
  }
  return filling.particles;
}

}  // namespace bondlab
