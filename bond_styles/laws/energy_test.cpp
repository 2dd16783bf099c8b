// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bonds and contacts as springs: what goes in comes out (PHYSICS.md 2.5, item 5); a break never
// makes energy.
#include <gtest/gtest.h>

#include <random>

#include "chain_testbench.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

ParallelParameters law() {
  ParallelParameters p;
  p.modulus = 1e9;
  p.ratio = 2.6;
  return p;
}

struct Cycle {
  double peak_energy = 0, peak_work = 0, left_energy = 0, left_work = 0, left_force = 0;
};

// Grain 1 goes out and back along `move` (m) and `turn` (rad), in the first half of the steps out.
// Work of the end forces by the mean of the loads before and after a step.
Cycle cycle(Bench b, Vec3 move, Vec3 turn, int steps) {
  const Vec3 x0 = b.grains[1].x;
  b.load(0.0, false);
  const double start = b.potential_energy();
  double work = 0.0;
  Cycle result;
  for (int k = 1; k <= steps; ++k) {
    const auto part = [&](int n) {
      const double s = static_cast<double>(n) / steps;
      return std::pow(std::sin(kPi * s), 2);
    };
    const Grain before = b.grains[1];
    const double now = part(k), gone = part(k - 1);
    b.prescribe(1e-7, [&](int g) { return g ? x0 + now * move : b.grains[0].x; },
                [&](int g) { return g ? (now - gone) * turn : Vec3{0, 0, 0}; });
    const Grain &after = b.grains[1];
    work -= 0.5 * dot(before.f + after.f, after.x - before.x) +
            0.5 * dot(before.t + after.t, (now - gone) * turn);
    if (2 * k == steps) result.peak_energy = b.potential_energy() - start, result.peak_work = work;
  }
  result.left_energy = b.potential_energy() - start;
  result.left_work = work;
  result.left_force = length(b.grains[1].f);
  return result;
}

Bench pair_of(double distance = 2e-3, bool flat = false) {
  Bench b(flat, 5e-3);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({distance, 0, 0}, 1e-3, 2500);
  b.bond(0, 1, law());
  return b;
}

}  // namespace

// One kind of deformation at a time: work = stored energy at the peak and nothing is left. Shear and
// bend turn the bond or strain it a little: second order in the size of the motion, (5e-5)^2.
TEST(Energy, closed_cycles_of_one_bond) {
  const double u = 1e-7, phi = 1e-4;
  const struct {
    const char *name;
    Vec3 move, turn;
    double energy;
  } cases[] = {
      {"tension", {u, 0, 0}, {0, 0, 0}, 0.5 * u * u * 1e9 * kPi * 1e-6 / 2e-3},
      {"compression", {-u, 0, 0}, {0, 0, 0}, 0.5 * u * u * 1e9 * kPi * 1e-6 / 2e-3},
      {"shear", {0, u, 0}, {0, 0, 0}, 0.5 * u * u * 1e9 * kPi * 1e-6 / 2e-3 / 2.6},
      {"twist", {0, 0, 0}, {phi, 0, 0}, 0.5 * phi * phi * 1e9 * kPi / 2 * 1e-12 / 2e-3 / 2.6},
      // turning one end bends by phi and shears by R phi
      {"bend", {0, 0, 0}, {0, 0, phi},
       0.5 * phi * phi * 1e9 * kPi * (0.25e-12 + 1e-12 / 2.6) / 2e-3},
      {"combined", {u, -u, 2 * u}, {phi, phi, -phi}, 0.0},
  };
  for (const auto &c : cases) {
    const Cycle r = cycle(pair_of(), c.move, c.turn, 400);
    EXPECT_GT(r.peak_energy, 0.0) << c.name;
    if (c.energy > 0.0) {
      EXPECT_NEAR(r.peak_energy / c.energy, 1.0, 2e-9) << c.name;
    }
    EXPECT_NEAR(r.peak_work / r.peak_energy, 1.0, 2e-9) << c.name;
    EXPECT_LT(std::fabs(r.left_work), 1e-13 * r.peak_energy) << c.name;
    EXPECT_LT(std::fabs(r.left_energy), 1e-13 * r.peak_energy) << c.name;
  }
}

// In the plane the law is exact for a large excursion too: what is left falls with the step.
TEST(Energy, plane_cycle_returns_to_nothing) {
  const Cycle r = cycle(pair_of(2e-3, true), {2e-6, 5e-6, 0}, {0, 0, 2e-3}, 2000);
  EXPECT_GT(r.peak_energy, 0.0);
  EXPECT_LT(std::fabs(r.left_work), 1e-6 * r.peak_energy);
  EXPECT_LT(std::fabs(r.left_energy), 1e-6 * r.peak_energy);
}

// Energy of a closed large-strain path falls with the square of the step.
TEST(Energy, work_is_second_order_in_the_step) {
  const auto left = [](int steps) {
    Bench b = pair_of();
    const Vec3 x0 = b.grains[1].x;
    b.load(0.0, false);
    double work = 0.0, peak = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const auto at = [&](double s) {
        const double a = 2 * kPi * s;
        return x0 + 2e-5 * Vec3{std::sin(a), 1 - std::cos(a), 0.5 * std::sin(2 * a)};
      };
      const Grain before = b.grains[1];
      b.prescribe(1e-7, [&](int g) { return g ? at(static_cast<double>(k) / steps) : Vec3{0, 0, 0}; },
                  [&](int) { return Vec3{0, 0, 0}; });
      work -= 0.5 * dot(before.f + b.grains[1].f, b.grains[1].x - before.x);
      peak = std::max(peak, b.potential_energy());
    }
    return (work - b.potential_energy()) / peak;
  };
  const double coarse = left(200), fine = left(400), finest = left(800);
  EXPECT_NEAR(std::log2((coarse - fine) / (fine - finest)), 2.0, 0.1);
}

// Free vibration of a chain of three bonds, tumbling as well, for a million steps at a tenth of the
// limit of the step. What the mean over 20,000 steps sees of the swing is 1e-6; there is no drift.
TEST(Energy, free_chain_keeps_its_energy_for_a_million_steps) {
  Bench b;
  for (int k = 0; k < 4; ++k) b.add({2e-3 * k, 0, 0}, 1e-3, 2500);
  for (int k = 0; k < 3; ++k) b.bond(k, k + 1, law());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  for (Grain &g : b.grains) {
    g.v = 0.02 * Vec3{u(random), u(random), u(random)};
    g.w = 20.0 * Vec3{u(random), u(random), u(random)};
  }
  const double dt = 0.1 * 2.5819889e-6;
  b.load(0.0, false);
  // mean over many periods: the energy of Verlet swings with (w dt)^2 about its mean
  const auto mean = [&](int steps) {
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
      b.step(dt);
      sum += b.kinetic_energy() + b.potential_energy();
    }
    return sum / steps;
  };
  const double first = mean(20000);
  mean(480000);
  const double middle = mean(20000);
  mean(460000);
  const double last = mean(20000);
  EXPECT_NEAR(middle / first, 1.0, 1e-6);
  EXPECT_NEAR(last / first, 1.0, 1e-6);
}

// A bond that breaks takes its energy with it: the sum never rises beyond what Verlet swings.
TEST(Energy, breaking_bonds_never_make_energy) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> u(-1, 1);
  int broken = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const bool flat = trial % 2;
    Bench b(flat, 2e-3);
    for (int k = 0; k < 6; ++k)
      b.add({1.9e-3 * k, 2e-4 * u(random), flat ? 0.0 : 2e-4 * u(random)}, 1e-3 * (1 + 0.2 * u(random)), 2500);
    for (int k = 0; k < 5; ++k) {
      PairRow &row = b.bond(k, k + 1, law(), {2e9, 2.0, 0.5});
      row.sigma_c = 3e6 * (1.5 + u(random));
      row.tau_c = 3e6 * (1.5 + u(random));
      row.tan_phi = trial % 3 ? 0.0 : 0.7;
    }
    for (Grain &g : b.grains) {
      g.v = 4.0 * Vec3{u(random), u(random), flat ? 0.0 : u(random)};
      g.w = 2000.0 * Vec3{flat ? 0.0 : u(random), flat ? 0.0 : u(random), u(random)};
    }
    b.load(0.0, false);
    const double dt = 2e-8, start = b.kinetic_energy() + b.potential_energy();
    for (int k = 0; k < 3000; ++k) {
      const double before = b.kinetic_energy() + b.potential_energy();
      b.step(dt);
      const double after = b.kinetic_energy() + b.potential_energy();
      bool breaks = false;
      for (const PairRow &p : b.pairs) breaks = breaks || p.fate != BondFate::intact;
      ASSERT_TRUE(std::isfinite(after));
      if (breaks) {
        EXPECT_LT(after, before) << "trial " << trial << " step " << k;
      }
      ASSERT_LT(after, 1.01 * start);
    }
    for (const PairRow &p : b.pairs) broken += p.alive == 0.0;
  }
  EXPECT_GT(broken, 80);  // the fuzz does reach breaks
}
