// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/fill.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "specimen/growing_packing.h"
#include "specimen/small_system.h"

namespace bondlab {

namespace {

constexpr double grid_over_smallest = 0.7;  // spacing of the starting points, in smallest radii
constexpr int most_passes = 60;             // over the points, of each of the two parts
constexpr double singular = 1e-6;           // pivot of touching surfaces
constexpr int most_choices = 6;             // of touching surfaces from one starting point

// Moves `p` until it touches its nearest surfaces: as many as there are unknowns, which are the
// place and, when `any_radius`, the radius. Near a round wall there may be fewer at first, and it
// touches those by the shortest way. False when that comes to nothing within `reach` of the start.
bool touch(const GrowingPacking &filling, Particle &p, int dimension, bool any_radius,
           double reach) {
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
    if (!solve_small(a, count, singular)) return false;
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
  GrowingPacking filling(container, r_max);
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
