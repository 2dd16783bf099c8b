// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what the laws' tests do with a chain of grains: bring it to rest under a load, run its first
// mode, find the limit of its time step, send a wave through it. For tests only.
//
// In velocity Verlet a mode of frequency w appears at (2/dt) asin(w dt/2): 2nd order in dt, and no
// solution beyond dt = 2/w. Units: SI.
#ifndef BONDLAB_LAWS_CHAIN_RUNS_H
#define BONDLAB_LAWS_CHAIN_RUNS_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "chain_modes.h"

namespace bondlab::laws::testbench {

// Moves the chain to rest under its loads; omega: that of the slowest mode or up to 1.4 times more.
inline void settle(Bench &b, double dt, double omega) {
  b.viscous = 1.4 * omega;
  b.load(0.0, false);
  const long steps = std::lround(25.0 / (0.7 * omega * dt));
  for (long k = 0; k < steps; ++k) b.step(dt);
}

// First frequency of the slender beam of the same EI and mass, for the damping only.
inline double slow_frequency(double EI, double mass_per_length, double length) {
  return 1.8751041 * 1.8751041 * std::sqrt(EI / mass_per_length) / (length * length);
}

inline Modes bending_modes(const Bench &b, double *asymmetry = nullptr) {
  return modes(dynamic_matrix(b, freedoms_of(b, {1, 5}), asymmetry));
}

// Runs the first mode from a push and gives its angular frequency: the mode's amplitude q obeys
// q(k+s) + q(k-s) = 2 cos(w s dt) q(k) exactly, so w comes from a least-squares fit of that.
inline double simulated_frequency(Bench b, const std::vector<double> &shape, double estimate,
                                  double dt) {
  const std::vector<Freedom> freedoms = freedoms_of(b, {1, 5});
  for (std::size_t k = 0; k < freedoms.size(); ++k) {
    Grain &g = b.grains[freedoms[k].grain];
    const double amplitude = 1e-6 * estimate * 1e-3;  // m/s for a mass of one
    if (freedoms[k].axis == 1)
      g.v.y = amplitude * shape[k] / std::sqrt(g.mass) * std::sqrt(b.grains[1].mass);
    else
      g.w.z = amplitude * shape[k] / std::sqrt(g.inertia) * std::sqrt(b.grains[1].mass);
  }
  const int stride = std::max(1, static_cast<int>(1.0 / (estimate * dt)));
  std::vector<double> q;
  b.load(0.0, false);
  for (int k = 0; k <= 30 * stride; ++k) {
    if (k % stride == 0) {
      double sum = 0.0;
      for (std::size_t r = 0; r < freedoms.size(); ++r) {
        const Grain &g = b.grains[freedoms[r].grain];
        sum += shape[r] * (freedoms[r].axis == 1 ? std::sqrt(g.mass) * g.x.y
                                                 : std::sqrt(g.inertia) * g.turned.z);
      }
      q.push_back(sum);
    }
    b.step(dt);
  }
  double over = 0.0, under = 0.0;
  for (std::size_t k = 1; k + 1 < q.size(); ++k) {
    over += (q[k + 1] + q[k - 1]) * q[k];
    under += 2.0 * q[k] * q[k];
  }
  return std::acos(over / under) / (stride * dt);
}

// Does any free vibration grow without bounds at this step?
inline bool grows(Bench b, double dt, int steps) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (Grain &g : b.grains)
    if (!g.held) {
      g.v = {b.transverse_only ? 0.0 : 1e-9 * u(random), 1e-9 * u(random), 0};
      g.w = {0, 0, 1e-6 * u(random)};
    }
  b.load(0.0, false);
  const double start = b.kinetic_energy();
  for (int k = 0; k < steps; ++k) {
    b.step(dt);
    if (b.kinetic_energy() > 1e8 * start) return true;
  }
  return false;
}

inline double stability_limit(const Bench &b, double guess, int steps = 6000) {
  double stable = 0.9 * guess, unstable = 1.1 * guess;
  EXPECT_FALSE(grows(b, stable, steps));
  EXPECT_TRUE(grows(b, unstable, steps));
  while (unstable / stable > 1.0 + 2e-6) {
    const double middle = 0.5 * (stable + unstable);
    (grows(b, middle, steps) ? unstable : stable) = middle;
  }
  return stable;
}

struct DispersionPoint {
  double lower, upper;
};

// The wave of number k on the infinite chain, from the kernel: the middle grain of three (`b`)
// feels K0 u + K- u exp(-ikl) + K+ u exp(ikl).
inline DispersionPoint wave(const Bench &b, double kl, int axis_a, int axis_b) {
  const std::vector<int> axes =
      axis_b < 0 ? std::vector<int>{axis_a} : std::vector<int>{axis_a, axis_b};
  std::vector<Freedom> middle;
  for (const int a : axes) middle.push_back({1, a});
  const int n = static_cast<int>(axes.size());
  std::complex<double> D[2][2];
  for (int grain = 0; grain < 3; ++grain)
    for (int c = 0; c < n; ++c) {
      const std::vector<double> column = stiffness_column(b, middle, {grain, axes[c]});
      for (int r = 0; r < n; ++r) D[r][c] += column[r] * std::polar(1.0, kl * (grain - 1));
    }
  const Grain &g = b.grains[1];
  const auto inertia = [&](int axis) { return axis < 3 ? g.mass : g.inertia; };
  if (n == 1) {
    const double w = std::sqrt(D[0][0].real() / inertia(axis_a));
    return {w, w};
  }
  const double a = D[0][0].real() / inertia(axis_a), d = D[1][1].real() / inertia(axis_b);
  const double bc = (D[0][1] * D[1][0]).real() / (inertia(axis_a) * inertia(axis_b));
  const double half = 0.5 * (a + d), root = std::sqrt(0.25 * (a - d) * (a - d) + bc);
  return {std::sqrt(half - root), std::sqrt(half + root)};
}

}  // namespace bondlab::laws::testbench

#endif
