// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/neighbours.h"

#include <algorithm>
#include <cstdint>

namespace bondlab {

namespace {

// Particles sorted into cells: those of cell c are members[first[c]] .. members[first[c + 1] - 1],
// in increasing order.
struct CellGrid {
  double lo[3] = {0, 0, 0}, size = 1;
  long n[3] = {1, 1, 1};
  std::vector<std::size_t> first;
  std::vector<int> members;

  long along(double x, int k) const {
    return std::clamp(static_cast<long>((x - lo[k]) / size), 0L, n[k] - 1);
  }
  long cell(const Particle &p) const {
    return (along(p.z, 2) * n[1] + along(p.y, 1)) * n[0] + along(p.x, 0);
  }
};

CellGrid sort_into_cells(const std::vector<Particle> &particles, double cell_size) {
  CellGrid grid;
  if (particles.empty()) return grid;
  double hi[3] = {particles[0].x, particles[0].y, particles[0].z};
  for (int k = 0; k < 3; ++k) grid.lo[k] = hi[k];
  for (const Particle &p : particles) {
    const double x[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; ++k) {
      grid.lo[k] = std::min(grid.lo[k], x[k]);
      hi[k] = std::max(hi[k], x[k]);
    }
  }
  // A file with one far-off particle must not ask for more memory than its particles deserve:
  // coarser cells are slower but just as right.
  grid.size = cell_size;
  const double allowed = 64.0 * static_cast<double>(particles.size()) + 1024.0;
  for (;;) {
    double cells = 1;
    for (int k = 0; k < 3; ++k) cells *= std::floor((hi[k] - grid.lo[k]) / grid.size) + 1;
    if (cells <= allowed) break;
    grid.size *= 2;
  }
  for (int k = 0; k < 3; ++k) grid.n[k] = static_cast<long>((hi[k] - grid.lo[k]) / grid.size) + 1;
  grid.first.assign(static_cast<std::size_t>(grid.n[0] * grid.n[1] * grid.n[2]) + 1, 0);
  std::vector<long> cell_of(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    cell_of[i] = grid.cell(particles[i]);
    ++grid.first[cell_of[i] + 1];
  }
  for (std::size_t c = 1; c < grid.first.size(); ++c) grid.first[c] += grid.first[c - 1];
  std::vector<std::size_t> next(grid.first.begin(), grid.first.end() - 1);
  grid.members.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
    grid.members[next[cell_of[i]]++] = static_cast<int>(i);
  return grid;
}

int root_of(std::vector<int> &parent, int i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

}  // namespace

PairList find_pairs(const std::vector<Particle> &particles, double gap) {
  PairList pairs;
  pairs.start.assign(particles.size() + 1, 0);
  double r_max = 0;
  for (const Particle &p : particles) r_max = std::max(r_max, p.r);
  if (particles.empty() || 2 * r_max + gap <= 0) return pairs;
  const CellGrid grid = sort_into_cells(particles, 2 * r_max + gap);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle &a = particles[i];
    const std::size_t row = pairs.other.size();
    const long cx = grid.along(a.x, 0), cy = grid.along(a.y, 1), cz = grid.along(a.z, 2);
    const long x_first = std::max(cx - 1, 0L), x_last = std::min(cx + 1, grid.n[0] - 1);
    for (long z = std::max(cz - 1, 0L); z <= std::min(cz + 1, grid.n[2] - 1); ++z) {
      for (long y = std::max(cy - 1, 0L); y <= std::min(cy + 1, grid.n[1] - 1); ++y) {
        // The cells of one row are adjacent in memory: one range for the three of them.
        const long line = (z * grid.n[1] + y) * grid.n[0];
        for (std::size_t m = grid.first[line + x_first]; m < grid.first[line + x_last + 1]; ++m) {
          const int j = grid.members[m];
          if (static_cast<std::size_t>(j) <= i) continue;
          const Particle &b = particles[j];
          const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, reach = a.r + b.r + gap;
          if (reach > 0 && dx * dx + dy * dy + dz * dz < reach * reach) pairs.other.push_back(j);
        }
      }
    }
    std::sort(pairs.other.begin() + static_cast<std::ptrdiff_t>(row), pairs.other.end());
    pairs.start[i + 1] = pairs.other.size();
  }
  return pairs;
}

PairList both_ways(const PairList &pairs) {
  const std::size_t n = pairs.start.size() - 1;
  PairList full;
  full.start.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    full.start[i + 1] += pairs.start[i + 1] - pairs.start[i];
    for (std::size_t k = pairs.start[i]; k < pairs.start[i + 1]; ++k)
      ++full.start[pairs.other[k] + 1];
  }
  for (std::size_t i = 0; i < n; ++i) full.start[i + 1] += full.start[i];
  full.other.resize(2 * pairs.size());
  std::vector<std::size_t> next(full.start.begin(), full.start.end() - 1);
  // Partners smaller than a row's own index come while the rows before it are read, those larger
  // when its own row is: every row fills in increasing order.
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = pairs.start[i]; k < pairs.start[i + 1]; ++k) {
      full.other[next[i]++] = pairs.other[k];
      full.other[next[pairs.other[k]]++] = static_cast<int>(i);
    }
  }
  return full;
}

Clusters connected_clusters(const PairList &pairs) {
  const std::size_t n = pairs.start.size() - 1;
  std::vector<int> parent(n);
  for (std::size_t i = 0; i < n; ++i) parent[i] = static_cast<int>(i);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = pairs.start[i]; k < pairs.start[i + 1]; ++k) {
      const int a = root_of(parent, static_cast<int>(i)), b = root_of(parent, pairs.other[k]);
      if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }
  }
  Clusters clusters;
  clusters.label.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int root = root_of(parent, static_cast<int>(i));
    clusters.label[i] = root == static_cast<int>(i) ? clusters.count++ : clusters.label[root];
  }
  return clusters;
}

}  // namespace bondlab
