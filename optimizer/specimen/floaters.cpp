// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/floaters.h"

#include <algorithm>
#include <array>
#include <limits>

#include "specimen/neighbours.h"
#include "specimen/small_system.h"

namespace bondlab {

namespace {

// normal . h - slack_weight * t >= -distance, in the unknowns h (move) and t (clearance after it).
constexpr double singular = 1e-9;  // pivot of constraints that meet in a vertex

struct Constraint {
  double normal[3];
  double slack_weight;  // 1 for a surface, 0 for a side of the trust box
  double distance;
};

struct Move {
  double h[3] = {0, 0, 0};
  double clearance = -std::numeric_limits<double>::infinity();
};

// Maximises t by trying every vertex: there are at most some twenty constraints, three or four of
// them active.
Move best_vertex(const std::vector<Constraint> &constraints, int dimension) {
  const int unknowns = dimension + 1, m = static_cast<int>(constraints.size());
  Move best;
  std::array<int, 4> pick{};
  const auto try_vertex = [&] {
    double a[4][5];
    bool has_surface = false;
    for (int i = 0; i < unknowns; ++i) {
      const Constraint &c = constraints[pick[i]];
      for (int k = 0; k < dimension; ++k) a[i][k] = c.normal[k];
      a[i][dimension] = -c.slack_weight;
      a[i][unknowns] = -c.distance;
      has_surface = has_surface || c.slack_weight > 0;
    }
    if (!has_surface || !solve_small(a, unknowns, singular)) return;
    const double t = a[dimension][unknowns];
    if (t <= best.clearance) return;
    for (const Constraint &c : constraints) {
      double left = -c.slack_weight * t;
      for (int k = 0; k < dimension; ++k) left += c.normal[k] * a[k][unknowns];
      if (left < -c.distance - 1e-12) return;
    }
    best.clearance = t;
    for (int k = 0; k < dimension; ++k) best.h[k] = a[k][unknowns];
  };
  for (pick[0] = 0; pick[0] < m; ++pick[0]) {
    for (pick[1] = pick[0] + 1; pick[1] < m; ++pick[1]) {
      for (pick[2] = pick[1] + 1; pick[2] < m; ++pick[2]) {
        if (unknowns == 3) {
          try_vertex();
          continue;
        }
        for (pick[3] = pick[2] + 1; pick[3] < m; ++pick[3]) try_vertex();
      }
    }
  }
  return best;
}

// Distances and directions to all surfaces around a point; returns the smallest distance.
double look_around(const Container &container, const std::vector<Particle> &particles,
                   const std::vector<int> &obstacles, const Particle &at,
                   std::vector<Constraint> *surfaces) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const int j : obstacles) {
    const Particle &b = particles[j];
    const double dx = at.x - b.x, dy = at.y - b.y, dz = at.z - b.z;
    const double d = std::sqrt(dx * dx + dy * dy + dz * dz);
    nearest = std::min(nearest, d - b.r);
    if (surfaces && d > 0) surfaces->push_back({{dx / d, dy / d, dz / d}, 1, d - b.r});
  }
  container.walls_within(at.x, at.y, at.z, std::numeric_limits<double>::infinity(),
                         [&](double distance, double nx, double ny, double nz, int) {
                           nearest = std::min(nearest, distance);
                           if (surfaces) surfaces->push_back({{nx, ny, nz}, 1, distance});
                         });
  return nearest;
}

}  // namespace

std::vector<bool> find_unloaded(const Container &container, const std::vector<Particle> &particles,
                                double load) {
  const PairList loaded = find_pairs(particles, -load);
  std::vector<bool> unloaded(particles.size(), true);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (std::size_t k = loaded.start[i]; k < loaded.start[i + 1]; ++k)
      unloaded[i] = unloaded[static_cast<std::size_t>(loaded.other[k])] = false;
    const Particle &p = particles[i];
    container.walls_within(p.x, p.y, p.z, p.r - load,
                           [&](double, double, double, double, int) { unloaded[i] = false; });
  }
  return unloaded;
}

std::vector<bool> find_floaters(const Container &container, const std::vector<Particle> &particles,
                                double gap) {
  const std::size_t n = particles.size();
  const int needed = container.dimension() + 1;
  const PairList full = both_ways(find_pairs(particles, gap));
  std::vector<bool> floats(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    const Particle &p = particles[i];
    int contacts = static_cast<int>(full.start[i + 1] - full.start[i]);
    container.walls_within(p.x, p.y, p.z, p.r + gap,
                           [&](double, double, double, double, int) { ++contacts; });
    floats[i] = contacts < needed;
  }
  return floats;
}

double climb_to_largest_hole(const Container &container, const std::vector<Particle> &particles,
                             const std::vector<int> &obstacles, Particle &floater) {
  const int dimension = container.dimension();
  double box = 0.2 * floater.r;
  const double smallest_box = 1e-10 * floater.r;
  std::vector<Constraint> surfaces, active;
  for (int round = 0; round < 100 && box > smallest_box; ++round) {
    surfaces.clear();
    const double now = look_around(container, particles, obstacles, floater, &surfaces);
    active.clear();
    for (const Constraint &c : surfaces)  // the others can't become the nearest within the box
      if (c.distance <= now + 2 * box * std::sqrt(static_cast<double>(dimension)))
        active.push_back(c);
    for (int k = 0; k < dimension; ++k) {
      for (const double sign : {1.0, -1.0}) {
        Constraint side{{0, 0, 0}, 0, box};
        side.normal[k] = sign;
        active.push_back(side);
      }
    }
    const Move move = best_vertex(active, dimension);
    if (!(move.clearance - now > 1e-12 * floater.r)) return now;
    Particle moved = floater;
    moved.x += move.h[0];
    moved.y += move.h[1];
    if (dimension == 3) moved.z += move.h[2];
    if (look_around(container, particles, obstacles, moved, nullptr) > now)
      floater = moved;
    else
      box *= 0.25;
  }
  return look_around(container, particles, obstacles, floater, nullptr);
}

int seat_floaters(const Container &container, std::vector<Particle> &particles,
                  const std::vector<bool> &floaters, double overlap, double largest) {
  // A hole's walls are at most one particle away from its floater.
  const PairList around = both_ways(find_pairs(particles, 2 * largest));
  int seated = 0;
  std::vector<int> obstacles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!floaters[i]) continue;
    obstacles.assign(around.other.begin() + static_cast<std::ptrdiff_t>(around.start[i]),
                     around.other.begin() + static_cast<std::ptrdiff_t>(around.start[i + 1]));
    const double hole = climb_to_largest_hole(container, particles, obstacles, particles[i]);
    particles[i].r = std::min(hole + overlap, largest);
    ++seated;
  }
  return seated;
}

}  // namespace bondlab
