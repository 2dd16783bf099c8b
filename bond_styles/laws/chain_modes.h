// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the linear picture of a bench of grains: its stiffness matrix, measured on the kernels by
// small displacements, and the eigenvalues that follow. For tests only.
//
// Method: one step that displaces (or turns) one grain by +-h, +-2h, five-point central difference
// of all forces and torques: error of order h^4. Eigenvalues by cyclic Jacobi rotations.
// Units: SI; a degree of freedom is (grain, axis), axis 0-2 along x, y, z, 3-5 about them.
#ifndef BONDLAB_LAWS_CHAIN_MODES_H
#define BONDLAB_LAWS_CHAIN_MODES_H

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "chain_testbench.h"

namespace bondlab::laws::testbench {

struct Freedom {
  int grain, axis;
};
using Matrix = std::vector<std::vector<double>>;

inline double &component(Vec3 &v, int d) { return d == 0 ? v.x : (d == 1 ? v.y : v.z); }

// -(force or torque on each freedom) per unit displacement of `moved`.
inline std::vector<double> stiffness_column(const Bench &bench, const std::vector<Freedom> &freedoms,
                                            Freedom moved) {
  const double h = (moved.axis < 3 ? bench.grains[moved.grain].radius : 1.0) * 2e-4;
  std::vector<double> column(freedoms.size(), 0.0);
  const std::pair<double, double> stencil[] = {{-2, 1.0 / 12}, {-1, -8.0 / 12}, {1, 8.0 / 12}, {2, -1.0 / 12}};
  for (const auto &[steps, weight] : stencil) {
    Bench b = bench;
    for (Grain &g : b.grains) g.v = g.w = {0, 0, 0};
    Grain &g = b.grains[moved.grain];
    (moved.axis < 3 ? component(g.v, moved.axis) : component(g.w, moved.axis - 3)) = steps * h;
    b.drift(1.0);
    b.load(1.0);
    for (std::size_t r = 0; r < freedoms.size(); ++r) {
      Grain &on = b.grains[freedoms[r].grain];
      const int a = freedoms[r].axis;
      column[r] -= weight / h * (a < 3 ? component(on.f, a) : component(on.t, a - 3));
    }
  }
  return column;
}

// M^-1/2 K M^-1/2, its measured asymmetry reported in `asymmetry` (relative to the largest entry).
inline Matrix dynamic_matrix(const Bench &bench, const std::vector<Freedom> &freedoms,
                             double *asymmetry = nullptr) {
  const int n = static_cast<int>(freedoms.size());
  std::vector<double> inverse_root(n);
  for (int k = 0; k < n; ++k) {
    const Grain &g = bench.grains[freedoms[k].grain];
    inverse_root[k] = 1.0 / std::sqrt(freedoms[k].axis < 3 ? g.mass : g.inertia);
  }
  Matrix a(n, std::vector<double>(n));
  for (int c = 0; c < n; ++c) {
    const std::vector<double> column = stiffness_column(bench, freedoms, freedoms[c]);
    for (int r = 0; r < n; ++r) a[r][c] = column[r] * inverse_root[r] * inverse_root[c];
  }
  double largest = 0.0, worst = 0.0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      largest = std::max(largest, std::fabs(a[r][c]));
      worst = std::max(worst, std::fabs(a[r][c] - a[c][r]));
    }
  if (asymmetry) *asymmetry = worst / largest;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < r; ++c) a[r][c] = a[c][r] = 0.5 * (a[r][c] + a[c][r]);
  return a;
}

struct Modes {
  std::vector<double> omega;  // rad/s, rising; negative eigenvalues of rounding size count as 0
  Matrix shape;               // shape[mode][freedom], mass-weighted, unit length
};

inline Modes modes(Matrix a) {
  const int n = static_cast<int>(a.size());
  Matrix v(n, std::vector<double>(n, 0.0));
  for (int k = 0; k < n; ++k) v[k][k] = 1.0;
  for (int sweep = 0; sweep < 60; ++sweep) {
    double off = 0.0, diagonal = 0.0;
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) (r == c ? diagonal : off) += a[r][c] * a[r][c];
    if (off <= 1e-34 * diagonal) break;
    for (int p = 0; p < n; ++p)
      for (int q = p + 1; q < n; ++q) {
        if (a[p][q] == 0.0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = (theta < 0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
        for (int k = 0; k < n; ++k) {
          const double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < n; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
        }
        for (int k = 0; k < n; ++k) {
          const double x = v[p][k], y = v[q][k];
          v[p][k] = c * x - s * y, v[q][k] = s * x + c * y;
        }
      }
  }
  std::vector<int> order(n);
  for (int k = 0; k < n; ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](int x, int y) { return a[x][x] < a[y][y]; });
  Modes m;
  for (const int k : order) {
    m.omega.push_back(std::sqrt(std::max(0.0, a[k][k])));
    m.shape.push_back(v[k]);
  }
  return m;
}

// All freedoms of grains that aren't held, for the axes named.
inline std::vector<Freedom> freedoms_of(const Bench &b, const std::vector<int> &axes) {
  std::vector<Freedom> all;
  for (int g = 0; g < static_cast<int>(b.grains.size()); ++g)
    if (!b.grains[g].held)
      for (const int a : axes) all.push_back({g, a});
  return all;
}

}  // namespace bondlab::laws::testbench

#endif
