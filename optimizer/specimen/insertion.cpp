// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/insertion.h"

#include <algorithm>
#include <cmath>

#include "specimen/growing_packing.h"
#include "specimen/small_system.h"

namespace bondlab {

namespace {

constexpr int most_steps = 50;             // of Newton's rule; it takes 4 to 8 where it converges
constexpr double singular = 1e-6;          // pivot of touching surfaces
constexpr double allowed_error = 1e-13;    // of the distances it ends at, over r_max
constexpr double allowed_overlap = 1e-10;  // over r_max; taken off the radius then

// Evenly on the unit circle or sphere, without functions that are rounded differently elsewhere.
void random_direction(int dimension, RandomStream &random, double n[3]) {
  for (;;) {
    double length2 = 0;
    for (int k = 0; k < 3; ++k) {
      n[k] = k < dimension ? random.uniform(-1, 1) : 0;
      length2 += n[k] * n[k];
    }
    if (length2 > 1 || length2 < 1e-4) continue;
    const double length = std::sqrt(length2);
    for (int k = 0; k < 3; ++k) n[k] /= length;
    return;
  }
}

Particle random_point(const Container &container, const double lo[3], const double hi[3],
                      RandomStream &random) {
  const ContainerShape shape = container.shape();
  for (;;) {
    double at[3] = {0, 0, 0};
    if (shape == ContainerShape::rectangle || shape == ContainerShape::prism) {
      for (int k = 0; k < container.dimension(); ++k) at[k] = random.uniform(lo[k], hi[k]);
    } else {
      double n[3];
      random_direction(shape == ContainerShape::sphere ? 3 : 2, random, n);
      const double out = 0.5 * container.size().diameter * random.uniform();
      for (int k = 0; k < 3; ++k) at[k] = out * n[k];
      if (shape == ContainerShape::cylinder) at[2] = random.uniform(lo[2], hi[2]);
    }
    if (container.depth(at[0], at[1], at[2]) > 0) return {at[0], at[1], at[2], 0};
  }
}

// The particle that touches the surfaces nearest to the point `p`, as many as a place and a radius
// need. False when there are too few or Newton's rule comes to nothing.
bool fit_between(const GrowingPacking &packing, int dimension, double r_max, Particle &p) {
  const int unknowns = dimension + 1;
  Surface near[4];
  if (packing.nearest_surfaces(p, unknowns, near) < unknowns) return false;
  p.r = 0;
  for (int i = 0; i < unknowns; ++i) p.r += near[i].distance / unknowns;
  for (int step = 0; step < most_steps; ++step) {
    // n_i . h - s = r - d_i in the move h and the growth s.
    double a[4][5], worst = 0;
    for (int i = 0; i < unknowns; ++i) {
      if (!packing.surface(p, near[i].id, near[i])) return false;
      for (int k = 0; k < dimension; ++k) a[i][k] = near[i].n[k];
      a[i][dimension] = -1;
      a[i][unknowns] = p.r - near[i].distance;
      worst = std::max(worst, std::fabs(a[i][unknowns]));
    }
    if (worst <= allowed_error * r_max) return true;
    if (!solve_small(a, unknowns, singular)) return false;
    double length = 0;
    for (int k = 0; k < dimension; ++k) length = std::max(length, std::fabs(a[k][unknowns]));
    const double share = length > r_max ? r_max / length : 1;
    p.x += share * a[0][unknowns];
    p.y += share * a[1][unknowns];
    if (dimension == 3) p.z += share * a[2][unknowns];
    p.r += share * a[dimension][unknowns];
  }
  return false;
}

void add_seeds(GrowingPacking &packing, const Container &container, const SizeDistribution &sizes,
               const double lo[3], const double hi[3], RandomStream &random) {
  const int dimension = container.dimension();
  const double r_min = sizes.smallest(), r_max = sizes.largest();
  const double spacing[3] = {2 * r_max, std::sqrt(3.0) * r_max, std::sqrt(8.0 / 3.0) * r_max};
  long n[3] = {1, 1, 1};
  for (int k = 0; k < dimension; ++k)
    n[k] = static_cast<long>(std::ceil((hi[k] - lo[k]) / spacing[k])) + 1;
  for (long layer = 0; layer < n[2]; ++layer)
    for (long row = 0; row < n[1]; ++row)
      for (long place = 0; place < n[0]; ++place) {
        // Rows lie in the gaps of the row before, layers in those of the layer before.
        const double shift[3] = {0.5 * static_cast<double>(row % 2 + layer % 2),
                                 static_cast<double>(layer % 2) / 3, 0};
        const long number[3] = {place, row, layer};
        double at[3] = {0, 0, 0}, edge = r_max;
        for (int k = 0; k < dimension; ++k) {
          at[k] = lo[k] + r_max + (static_cast<double>(number[k]) + shift[k]) * spacing[k];
          edge = std::min({edge, at[k] - lo[k], hi[k] - at[k]});
        }
        if (edge <= r_min) continue;
        Particle p;
        p.r = r_min +
              (sizes.quantile(0.5 * random.uniform()) - r_min) * (edge - r_min) / (r_max - r_min);
        for (int k = 0; k < dimension; ++k) at[k] += (edge - p.r) * random.uniform(-1, 1);
        p.x = at[0], p.y = at[1], p.z = at[2];
        if (packing.clearance(p) >= p.r) packing.add(p);
      }
}

}  // namespace

InsertedParticles insert_particles(const Container &container, const SizeDistribution &sizes,
                                   long tries, RandomStream &random) {
  const double r_min = sizes.smallest(), r_max = sizes.largest();
  double lo[3], hi[3];
  container.bounds(lo, hi);
  GrowingPacking packing(container, r_max);
  add_seeds(packing, container, sizes, lo, hi, random);
  InsertedParticles result;
  result.seeds = packing.particles.size();
  for (long failures = 0; failures < tries;) {
    Particle p = random_point(container, lo, hi, random);
    ++failures;
    if (!fit_between(packing, container.dimension(), r_max, p)) continue;
    const double room = packing.clearance(p);
    if (room < p.r - allowed_overlap * r_max) continue;
    p.r = std::min(p.r, room);  // the last bits of Newton's rule
    if (p.r < r_min || p.r > r_max) continue;
    packing.add(p);
    failures = 0;
  }
  result.particles = packing.particles;
  return result;
}

}  // namespace bondlab
