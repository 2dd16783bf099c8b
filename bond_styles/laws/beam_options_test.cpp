// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a beam can do besides its own formulas (bond_options.h): another modulus in tension,
// softening with a fracture energy, dashpots. Off, they change nothing.
#include <gtest/gtest.h>

#include <random>

#include "beam_testbench.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

Bench pair_of(bool flat = false, bool options = false) {
  Bench b = beam_bench(flat, 5e-3, options);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  BeamParameters p;
  p.modulus = 1e9;
  p.poisson = 0.3;
  beam(b, 0, 1, p);
  return b;
}

}  // namespace

TEST(BeamOptions, switched_off_they_change_no_bit) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const bool flat : {false, true}) {
    Bench off = pair_of(flat), on = pair_of(flat, true);
    for (Bench *b : {&off, &on}) b->pairs[0].own[kCohesion] = 2e7, b->pairs[0].own[kTanPhi] = 0.5;
    for (int k = 0; k < 300; ++k) {
      const Vec3 v{u(random), u(random), flat ? 0 : u(random)},
          w{flat ? 0 : u(random), flat ? 0 : u(random), u(random)};
      for (Bench *b : {&off, &on}) {
        b->grains[1].v = 0.5 * v, b->grains[1].w = 500.0 * w;
        b->drift(1e-7);
        b->load(1e-7);
      }
      const double size = length(off.grains[0].f);
      EXPECT_LE(length(off.grains[0].f - on.grains[0].f), 1e-15 * size);
      EXPECT_EQ(off.pairs[0].alive, on.pairs[0].alive);
    }
    EXPECT_EQ(on.pairs[0].own[kLost], 0.0);
  }
}

TEST(BeamOptions, tension_modulus) {
  for (const bool flat : {false, true})
    for (const double sign : {1.0, -1.0}) {
      Bench b = pair_of(flat, true);
      b.pairs[0].own[kTension] = 0.4;
      b.grains[1].x.x += sign * 1e-7;
      b.load(0.0, false);
      const double kn = BeamLaw::stiffness(b, b.pairs[0]).normal;
      EXPECT_NEAR(b.grains[0].f.x / (1e-7 * kn), sign > 0 ? 0.4 : -1.0, 1e-8);
    }
}

// Pulled until it is gone: the work is the fracture energy times the area; on the way back it
// unloads along the secant, and closed it carries in full. Energy in = stored + lost all the way.
TEST(BeamOptions, softening_dissipates_the_fracture_energy) {
  for (const bool flat : {false, true}) {
    const double strength = 5e6, Gf = 60.0;
    Bench b = pair_of(flat, true);
    PairRow &row = b.pairs[0];
    const BeamStiffness k = BeamLaw::stiffness(b, row);
    const double area = flat ? 2e-3 * b.thickness() : kPi * 1e-6, kn = k.normal / area;
    row.own[kCutoff] = strength;
    row.own[kFailure] = failure_factor(Gf, kn, strength);
    ASSERT_NEAR(row.own[kFailure], 2.0 * Gf * kn / (strength * strength),
                1e-12 * row.own[kFailure]);
    const double gone = row.own[kFailure] * strength / kn;
    b.load(0.0, false);
    double work = 0.0;
    const int steps = 20000;
    const auto move = [&](double by) {
      const double before = b.grains[1].f.x;
      b.grains[1].v = {by, 0, 0};
      b.drift(1.0);
      b.load(1.0);
      work -= 0.5 * (before + b.grains[1].f.x) * by;
    };
    double stretch = 0.0;
    for (int s = 0; s < steps / 2; ++s) move(gone / steps), stretch += gone / steps;
    const double factor = stretch * kn / strength,
                 w = (row.own[kFailure] / factor - 1) / (row.own[kFailure] - 1);
    EXPECT_NEAR(-b.grains[1].f.x / (w * k.normal * stretch), 1.0, 1e-3);
    EXPECT_NEAR((b.potential_energy() + row.own[kLost]) / work, 1.0, 1e-3);
    for (int s = 0; s < steps / 2; ++s) move(-gone / steps);  // back: along the secant to nothing
    EXPECT_LT(std::fabs(b.grains[1].f.x), 1e-9 * strength * area);
    EXPECT_NEAR(row.own[kLost] / work, 1.0, 1e-3);
    move(-1e-3 * gone);
    EXPECT_NEAR(b.grains[1].f.x / (k.normal * 1e-3 * gone), 1.0, 1e-6);
    move(1e-3 * gone);
    for (int s = 0; s < steps + 2 && row.alive != 0.0; ++s) move(gone / steps);
    EXPECT_EQ(row.fate, BondFate::broken_in_tension);
    EXPECT_NEAR(work / (Gf * area), 1.0, 2e-3);
    EXPECT_NEAR(row.own[kLost] / (Gf * area), 1.0, 2e-3);
  }
}

// A dashpot of damping ratio zeta on the axial vibration of two grains: exp(-zeta w t) of the
// amplitude, and `lost` has what the energy misses.
TEST(BeamOptions, damping_ratio_and_what_it_takes) {
  for (const bool flat : {false, true}) {
    const double zeta = 0.05;
    Bench b = pair_of(flat, true);
    PairRow &row = b.pairs[0];
    const double kn = BeamLaw::stiffness(b, row).normal, m = b.grains[0].mass;
    const double omega = std::sqrt(2.0 * kn / m), dt = 0.002 / omega;
    row.own[kViscous] = viscous_time(zeta, kn, m, m) / dt;
    b.grains[0].v = {-1e-3, 0, 0};
    b.grains[1].v = {1e-3, 0, 0};
    b.load(0.0, false);
    const double start = b.kinetic_energy();
    const int steps =
        static_cast<int>(std::lround(5 * 2 * kPi / (omega * std::sqrt(1 - zeta * zeta)) / dt));
    for (int k = 0; k < steps; ++k) b.step(dt);
    const double left = b.kinetic_energy() + b.potential_energy();
    EXPECT_NEAR(std::log(start / left) / (2 * zeta * omega * steps * dt), 1.0, 3e-3);
    EXPECT_NEAR((left + row.own[kLost]) / start, 1.0, 3e-3);
    // shear, bend and twist alike
    for (const Vec3 w : {Vec3{0, 0, 5}, Vec3{flat ? 0.0 : 5.0, 0, flat ? 5.0 : 0.0}}) {
      Bench c = pair_of(flat, true);
      c.pairs[0].own[kViscous] = row.own[kViscous];
      c.grains[1].w = w;
      c.load(0.0, false);
      const double before = c.kinetic_energy();
      for (int k = 0; k < 4000; ++k) c.step(dt);
      const double after = c.kinetic_energy() + c.potential_energy();
      EXPECT_GT(c.pairs[0].own[kLost], 0.1 * before);
      EXPECT_NEAR((after + c.pairs[0].own[kLost]) / before, 1.0, 3e-3);
    }
  }
}
