// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/statistics.h"

#include <algorithm>

#include "specimen/floaters.h"
#include "specimen/neighbours.h"
#include "specimen/relax.h"

namespace bondlab {

namespace {

constexpr double pi = 3.14159265358979323846;

double solid(const Particle &p, int dimension) {
  return dimension == 2 ? pi * p.r * p.r : 4 * pi / 3 * p.r * p.r * p.r;
}

struct Tensor {
  double at[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  void add(double weight, const double n[3]) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) at[i][j] += weight * n[i] * n[j];
  }
};

// Largest over smallest eigenvalue of the leading block by Jacobi's rotations.
double eigenvalue_ratio(Tensor tensor, int dimension) {
  auto &a = tensor.at;
  for (int sweep = 0; sweep < 30; ++sweep) {
    for (int p = 0; p < dimension; ++p) {
      for (int q = p + 1; q < dimension; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
        a[p][q] = a[q][p] = 0;
      }
    }
  }
  double smallest = a[0][0], largest = a[0][0];
  for (int k = 1; k < dimension; ++k) {
    smallest = std::min(smallest, a[k][k]);
    largest = std::max(largest, a[k][k]);
  }
  return smallest > 0 ? largest / smallest : 0;
}

// Fraction of grid points in the inner part that lie in no particle.
double inner_porosity(const Container &container, const std::vector<Particle> &particles,
                      double inset, double r_mean) {
  const int dimension = container.dimension();
  double spacing = (dimension == 2 ? 0.05 : 0.2) * r_mean;
  double lo[3], hi[3];
  container.bounds(lo, hi);
  // A container that is nearly empty (a file gone wrong) must not ask for more points than its
  // particles deserve.
  const double allowed = 1e6 + 2000 * static_cast<double>(particles.size());
  double points = 1;
  for (int k = 0; k < dimension; ++k) points *= (hi[k] - lo[k]) / spacing;
  if (points > allowed) spacing *= std::pow(points / allowed, 1.0 / dimension);
  long n[3] = {1, 1, 1};
  double step[3] = {0, 0, 0};
  for (int k = 0; k < dimension; ++k) {
    const double side = hi[k] - lo[k] - 2 * inset;
    if (side <= 0) return 0;
    n[k] = static_cast<long>(std::ceil(side / spacing));
    step[k] = side / static_cast<double>(n[k]);
    lo[k] += inset;
  }
  const auto at = [&](int k, long i) {
    return lo[k] + (static_cast<double>(i) + 0.5) * step[k];  // z is 0 in 2D
  };
  // 2 outside the inner part, 0 pore, 1 solid
  std::vector<unsigned char> mark(static_cast<std::size_t>(n[0] * n[1] * n[2]));
  std::size_t total = 0, filled = 0, cell = 0;
  for (long z = 0; z < n[2]; ++z)
    for (long y = 0; y < n[1]; ++y)
      for (long x = 0; x < n[0]; ++x, ++cell) {
        const bool inside = container.depth(at(0, x), at(1, y), at(2, z)) >= inset;
        mark[cell] = inside ? 0 : 2;
        total += inside;
      }
  for (const Particle &p : particles) {
    const double centre[3] = {p.x, p.y, p.z};
    long first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
    for (int k = 0; k < dimension; ++k) {
      const double end = static_cast<double>(n[k]);  // clamped before the cast: places may be wild
      first[k] = static_cast<long>(std::clamp((centre[k] - p.r - lo[k]) / step[k], 0.0, end));
      last[k] = static_cast<long>(std::clamp((centre[k] + p.r - lo[k]) / step[k], -1.0, end - 1));
    }
    for (long z = first[2]; z <= last[2]; ++z)
      for (long y = first[1]; y <= last[1]; ++y)
        for (long x = first[0]; x <= last[0]; ++x) {
          const double dx = at(0, x) - p.x, dy = at(1, y) - p.y, dz = at(2, z) - p.z;
          unsigned char &m = mark[static_cast<std::size_t>((z * n[1] + y) * n[0] + x)];
          if (m != 0 || dx * dx + dy * dy + dz * dz >= p.r * p.r) continue;
          m = 1;
          ++filled;
        }
  }
  return total > 0 ? 1 - static_cast<double>(filled) / static_cast<double>(total) : 0;
}

// Contact forces over E_c (and over the thickness in 2D), summed to a stress.
void measure_contacts(const Container &container, const std::vector<Particle> &particles,
                      const PairList &near, double inset, double bond_reach,
                      SpecimenStatistics &s) {
  const int dimension = container.dimension();
  Tensor fabric, stress;
  const auto stiffness = [&](double radius) { return dimension == 2 ? 2.0 : 4 * radius; };
  double overlap_sum = 0;
  std::size_t touching = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle &a = particles[i];
    for (std::size_t k = near.start[i]; k < near.start[i + 1]; ++k) {
      const Particle &b = particles[near.other[k]];
      const double gap = gap_between(a, b);
      const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
      const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
      if (length == 0) continue;
      const double n[3] = {dx / length, dy / length, dz / length};
      if (gap < bond_reach &&
          container.depth(a.x + 0.5 * dx, a.y + 0.5 * dy, a.z + 0.5 * dz) > inset)
        fabric.add(1, n);
      if (gap >= 0) continue;
      const double relative = -gap / std::min(a.r, b.r);
      overlap_sum += relative;
      ++touching;
      s.max_overlap = std::max(s.max_overlap, relative);
      stress.add(stiffness(0.5 * (a.r + b.r)) * -gap * length, n);
    }
    container.walls_within(
        a.x, a.y, a.z, a.r, [&](double distance, double nx, double ny, double nz, int) {
          const double n[3] = {nx, ny, nz};
          s.stick_out = std::max(s.stick_out, (a.r - distance) / a.r);
          stress.add(wall_contact_stiffness * stiffness(a.r) * (a.r - distance) * distance, n);
        });
  }
  s.mean_overlap = touching > 0 ? overlap_sum / static_cast<double>(touching) : 0;
  const double trace = stress.at[0][0] + stress.at[1][1] + stress.at[2][2];
  s.stress_over_modulus = trace / (dimension * container.measure());
  s.stress_ratio = eigenvalue_ratio(stress, dimension);
  s.fabric_ratio = eigenvalue_ratio(fabric, dimension);
}

}  // namespace

SpecimenStatistics measure_packing(const Container &container,
                                   const std::vector<Particle> &particles) {
  SpecimenStatistics s;
  s.count = particles.size();
  if (particles.empty()) return s;
  const int dimension = container.dimension();
  const double n = static_cast<double>(particles.size());
  double area = 0;
  s.r_min = s.r_max = particles[0].r;
  for (const Particle &p : particles) {
    s.r_min = std::min(s.r_min, p.r);
    s.r_max = std::max(s.r_max, p.r);
    s.r_mean += p.r / n;
    area += solid(p, dimension);
  }
  const double inset = 2 * s.r_max;
  s.porosity = 1 - area / container.measure();
  s.porosity_inner = inner_porosity(container, particles, inset, s.r_mean);

  const PairList near = find_pairs(particles, coordination_gaps.back() * s.r_mean);
  std::array<std::size_t, coordination_gaps.size()> bonds{};
  std::vector<int> bonds_of(particles.size(), 0);
  PairList bonded;
  bonded.start.assign(particles.size() + 1, 0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (std::size_t k = near.start[i]; k < near.start[i + 1]; ++k) {
      const int j = near.other[k];
      const double gap = gap_between(particles[i], particles[j]) / s.r_mean;
      for (std::size_t g = 0; g < coordination_gaps.size(); ++g)
        bonds[g] += gap < coordination_gaps[g];
      if (gap >= bond_gap) continue;
      bonded.other.push_back(j);
      ++bonds_of[i];
      ++bonds_of[j];
    }
    bonded.start[i + 1] = bonded.other.size();
  }
  for (std::size_t g = 0; g < bonds.size(); ++g)
    s.coordination[g] = 2 * static_cast<double>(bonds[g]) / n;
  s.fewest_bonds = *std::min_element(bonds_of.begin(), bonds_of.end());
  s.clusters = connected_clusters(bonded).count;

  measure_contacts(container, particles, near, inset, bond_gap * s.r_mean, s);

  const double touch = coordination_gaps[0] * s.r_mean;
  for (const bool floats : find_floaters(container, particles, touch)) s.floaters += floats;
  for (const Particle &p : particles) {
    container.walls_within(p.x, p.y, p.z, p.r + touch,
                           [&](double, double, double, double, int wall) {
                             s.on_bottom += wall == 0;
                             s.on_top += wall == 1;
                           });
  }
  return s;
}

}  // namespace bondlab
