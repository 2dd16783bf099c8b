// SPDX-License-Identifier: GPL-2.0-or-later
//
// A beam that only rotates keeps its loads exactly; an isolated one keeps both momenta; the names
// of the two particles don't matter (PHYSICS.md 2.5, items 4 and 6; pitfalls of 3.0-3.2).
#include <gtest/gtest.h>

#include <random>

#include "beam_testbench.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

BeamParameters law() {
  BeamParameters p;
  p.modulus = 1e9;
  p.poisson = 0.3;
  return p;
}

// A chain of three grains bent, sheared, twisted and stretched, then spun as a rigid body. Largest
// error of forces and torques in the body's frame, relative to the largest.
double spin_error(double r2, double gap, Vec3 axis, int steps_a_turn, int turns,
                  bool at_contact = false) {
  Bench b = beam_bench();
  const double r1 = 1e-3;
  std::vector<Vec3> x{{0, 0, 0}};
  x.push_back(x[0] + (r1 + r2 + gap) * unit({1, 0.2, -0.3}));
  x.push_back(x[1] + (r1 + r2 + gap) * unit({0.9, -0.4, 0.1}));
  b.add(x[0], r1, 2500), b.add(x[1], r2, 2500), b.add(x[2], r1, 2500);
  BeamParameters p = law();
  p.touching = true;  // prestrained where there is a gap
  p.at_contact = at_contact;
  beam(b, 0, 1, p), beam(b, 1, 2, p);
  // load it
  b.grains[1].q = turned_by(b.grains[1].q, {1e-3, -2e-3, 0.5e-3});
  b.grains[2].q = turned_by(b.grains[2].q, {-2e-3, 1e-3, 2e-3});
  x[1] = x[1] + Vec3{1e-6, 2e-6, -1e-6};
  b.grains[1].x = x[1];
  b.load(0.0, false);
  const std::vector<Grain> start = b.grains;
  double force = 0.0, moment = 0.0;
  for (const Grain &g : start)
    force = std::max(force, length(g.f)), moment = std::max(moment, length(g.t));
  const Vec3 spin = (2.0 * kPi / steps_a_turn) * unit(axis);
  double worst = 0.0;
  for (int k = 1; k <= turns * steps_a_turn; ++k) {
    b.prescribe(
        1e-7, [&](int g) { return rotated(x[g], static_cast<double>(k) * spin); },
        [&](int) { return spin; });
    if (k % 37 != 0 && k != turns * steps_a_turn) continue;
    for (int g = 0; g < 3; ++g) {
      const Vec3 f = rotated(b.grains[g].f, static_cast<double>(-k) * spin);
      const Vec3 t = rotated(b.grains[g].t, static_cast<double>(-k) * spin);
      worst = std::max(worst, length(f - start[g].f) / force);
      worst = std::max(worst, length(t - start[g].t) / moment);
    }
  }
  return worst;
}

const Vec3 kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}, {-1, 0.4, 0.2}};

}  // namespace

// 100 turns: what is left is the rounding of orientations over 1e5 steps (about 1e-13 rad against
// strains of 1e-3), for coarse steps as for fine ones.
TEST(BeamObjectivity, spun_chain_keeps_its_loads_for_100_turns) {
  for (const Vec3 axis : kAxes) {
    EXPECT_LT(spin_error(1e-3, 0.0, axis, 1000, 100), 1e-9);
    EXPECT_LT(spin_error(1e-3, 0.0, axis, 9, 100), 1e-10);
  }
}

TEST(BeamObjectivity, holds_for_unequal_radii_gaps_and_overlaps) {
  for (const double gap : {-5e-5, 0.0, 5e-5})
    for (const Vec3 axis : kAxes) {
      EXPECT_LT(spin_error(0.6e-3, gap, axis, 200, 100), 1e-9);
      EXPECT_LT(spin_error(0.6e-3, gap, axis, 200, 100, true), 1e-9);
    }
}

// A constant shear load that turns with the bond: the strain under it stays as it is.
TEST(BeamObjectivity, constant_shear_load_turning_with_the_bond) {
  Bench b = beam_bench();
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({1.6e-3, 0, 0}, 0.6e-3, 2500);
  PairRow &row = beam(b, 0, 1, law());
  const Vec3 tilt{0, 0, 1e-3};  // both ends alike against the bond: shear alone
  for (Grain &g : b.grains) g.q = turned_by(g.q, tilt);
  b.load(0.0, false);
  const BeamLoads before = BeamLaw::loads(b, row);
  EXPECT_NEAR(before.fs / (1e9 / 2.6 * kPi * 0.64e-6 * 1e-3), 1.0, 1e-12);
  EXPECT_LT(before.mb, 1e-12 * before.fs);
  const Vec3 spin = (2.0 * kPi / 500) * unit({1, 2, 3});
  for (int k = 1; k <= 500 * 100; ++k)
    b.prescribe(
        1e-7,
        [&](int g) {
          return rotated(Vec3{g * 1.6e-3, 0, 0}, static_cast<double>(k) * spin);
        },
        [&](int) { return spin; });
  EXPECT_NEAR(BeamLaw::loads(b, row).fs / before.fs, 1.0, 1e-9);
  EXPECT_NEAR(length(b.grains[0].f) / before.fs, 1.0, 1e-9);
}

// Named after the flaw: projecting a stored shear force on the new plane loses angle^2/2 a step, so
// that a bond that merely turns relaxes. Nothing is stored here: ten steps or ten thousand a turn,
// all alike.
TEST(BeamObjectivity, projection_without_renormalisation_relaxes) {
  for (const int steps : {3, 10, 10000}) {
    Bench b = beam_bench();
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({2e-3, 0, 0}, 1e-3, 2500);
    PairRow &row = beam(b, 0, 1, law());
    for (Grain &g : b.grains) g.q = turned_by(g.q, {0, 0, 1e-3});
    const double start = BeamLaw::loads(b, row).fs;
    for (int k = 1; k <= steps; ++k) {
      const Vec3 spin{0, 0, 2.0 * kPi / steps};
      b.prescribe(
          1e-7,
          [&](int g) {
            return rotated(Vec3{g * 2e-3, 0, 0}, static_cast<double>(k) * spin);
          },
          [&](int) { return spin; });
    }
    EXPECT_NEAR(BeamLaw::loads(b, row).fs / start, 1.0, 1e-10);
  }
}

// Where shear is measured and acts: turning i alone by a shears the bond by a/2, or by a R_i/(R_i +
// R_j) at the grains' contact, and the force's torque is shared alike. Named after the flaw:
// ESyS-Particle measures in the middle and applies at the contact, which has no energy if the radii
// differ.
TEST(BeamObjectivity, shear_acts_where_it_is_measured_esys) {
  for (const bool flat : {false, true})
    for (const bool at_contact : {false, true}) {
      const double share = at_contact ? 1.0 / 1.4 : 0.5, angle = 1e-6;
      Bench b = beam_bench(flat, 1e-3);
      b.add({0, 0, 0}, 1e-3, 2500);
      b.add({1.4e-3, 0, 0}, 0.4e-3, 2500);
      BeamParameters p = law();
      p.at_contact = at_contact;
      p.bend_factor = 1e-9;  // shear alone
      PairRow &row = beam(b, 0, 1, p);
      b.grains[0].q = turned_by(b.grains[0].q, {0, 0, angle});
      b.load(0.0, false);
      const double force = BeamLaw::stiffness(b, row).shear * 1.4e-3 * share * angle;
      EXPECT_NEAR(b.grains[1].f.y / force, 1.0, 1e-6);
      EXPECT_NEAR(b.grains[0].t.z / (-force * share * 1.4e-3), 1.0, 1e-6);
      EXPECT_NEAR(b.grains[1].t.z / (-force * (1 - share) * 1.4e-3), 1.0, 1e-6);
    }
}

// Named after the flaw: bend and twist from radius-weighted spins (r1 w1 - r2 w2)/r.
TEST(BeamObjectivity, bend_and_twist_are_plain_differences_of_rotation_richti83) {
  for (const double r2 : {1e-3, 0.5e-3}) {
    Bench b = beam_bench();
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({1e-3 + r2, 0, 0}, r2, 2500);
    PairRow &row = beam(b, 0, 1, law());
    const double angle = 1e-6;
    b.grains[1].q = turned_by(b.grains[1].q, {angle, 0, 0});
    EXPECT_NEAR(BeamLaw::loads(b, row).mt / (BeamLaw::stiffness(b, row).twist * angle), 1.0, 1e-9);
    b.grains[1].q = turned_by({1, 0, 0, 0}, {0, angle, 0});
    EXPECT_NEAR(BeamLaw::loads(b, row).mb / (BeamLaw::stiffness(b, row).bend * angle), 1.0, 1e-9);
  }
}

TEST(BeamObjectivity, isolated_bond_keeps_linear_and_angular_momentum) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 8; ++trial) {
    const bool dashpots = trial % 4 == 3;
    Bench b = beam_bench(false, 1.0, dashpots);
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({1.8e-3 + 2e-4 * u(random), 1e-4 * u(random), 0}, 0.6e-3, 2000);
    for (Grain &g : b.grains) {
      g.v = 0.5 * Vec3{u(random), u(random), u(random)};
      g.w = 300.0 * Vec3{u(random), u(random), u(random)};
    }
    BeamParameters p = law();
    p.touching = trial % 2;
    p.at_contact = trial > 3;
    PairRow &row = beam(b, 0, 1, p, trial % 3 ? ContactSpec{} : ContactSpec{1e9, 2.0, 0.5});
    row.own[kViscous] = 0.3;
    b.load(0.0, false);
    const Vec3 before = b.momentum(), spin_before = b.angular_momentum();
    double size = 0.0, spin_size = 0.0;
    for (const Grain &g : b.grains) {
      size += g.mass * length(g.v);
      spin_size += g.mass * length(cross(g.x, g.v)) + g.inertia * length(g.w);
    }
    for (int k = 0; k < 10000; ++k) b.step(2e-7);
    EXPECT_LT(length(b.momentum() - before), 1e-11 * size);
    EXPECT_LT(length(b.angular_momentum() - spin_before), 1e-11 * spin_size + 1e-12 * size * 2e-3);
  }
}

// Named after the flaw: arms R1 + R2 on a bond of another length make torques that don't balance.
TEST(BeamObjectivity, arms_sum_to_current_distance) {
  for (const double distance : {1.4e-3, 1.7e-3, 2.2e-3}) {
    Bench b = beam_bench();
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({distance, 0, 0}, 0.7e-3, 2500);
    BeamParameters p = law();
    p.touching = true;
    beam(b, 0, 1, p);
    b.grains[0].q = turned_by(b.grains[0].q, {1e-3, 2e-3, -1e-3});
    b.grains[1].q = turned_by(b.grains[1].q, {-1e-3, 1e-3, 3e-3});
    b.load(0.0, false);
    const Vec3 turn =
        b.grains[0].t + b.grains[1].t + distance * cross(Vec3{1, 0, 0}, b.grains[1].f);
    EXPECT_LT(length(turn), 1e-15 * (length(b.grains[0].t) + length(b.grains[1].t)));
  }
}

TEST(BeamObjectivity, swapping_the_particles_gives_the_same_forces) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  int broken = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const bool flat = trial % 3 == 0;
    Bench b = beam_bench(flat, 1e-3, trial % 2);
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add(1.6e-3 * unit({u(random), u(random), flat ? 0.0 : u(random)}), 0.7e-3, 2000);
    for (Grain &g : b.grains)
      g.q = turned_by(g.q, {flat ? 0 : u(random), flat ? 0 : u(random), u(random)});
    Bench c = b;
    BeamParameters p = law();
    p.cohesion = 3e6, p.tan_phi = 0.8, p.cutoff = 3e6, p.friction = 0.5;
    p.at_contact = trial % 4 > 1;
    PairRow &one = beam(b, 0, 1, p), &two = beam(c, 1, 0, p);
    for (PairRow *row : {&one, &two})
      row->own[kViscous] = 0.2, row->own[kTension] = 0.7, row->own[kFailure] = 2.0;
    for (int k = 0; k < 60; ++k) {
      for (int g = 0; g < 2; ++g) {
        c.grains[g].v = b.grains[g].v = 0.02 * Vec3{u(random), u(random), flat ? 0 : u(random)};
        c.grains[g].w = b.grains[g].w =
            600.0 * Vec3{flat ? 0 : u(random), flat ? 0 : u(random), u(random)};
      }
      b.drift(1e-6), c.drift(1e-6);
      b.load(1e-6), c.load(1e-6);
      // angles are rounded to some 1e-16 rad, times the stiffness k_n l (about 2500 N; in 2D 1700)
      for (int g = 0; g < 2; ++g) {
        EXPECT_LT(length(b.grains[g].f - c.grains[g].f),
                  4e-16 * 2500 + 1e-13 * length(b.grains[g].f));
        EXPECT_LT(length(b.grains[g].t - c.grains[g].t),
                  4e-16 * 2500 * 1.6e-3 + 1e-13 * length(b.grains[g].t));
      }
      EXPECT_EQ(one.alive, two.alive);
      EXPECT_EQ(one.fate, two.fate);
    }
    broken += one.alive == 0.0;
  }
  EXPECT_GT(broken, 20);
  EXPECT_LT(broken, 190);
}

TEST(BeamObjectivity, plane_bond_spun_100_turns) {
  for (const double distance : {1.5e-3, 1.7e-3, 1.9e-3}) {
    Bench b = beam_bench(true, 0.01);
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({distance, 0, 0}, 0.7e-3, 2500);
    BeamParameters p = law();
    p.touching = true;
    beam(b, 0, 1, p);
    b.grains[0].q = turned_by(b.grains[0].q, {0, 0, 2e-3});
    b.grains[1].q = turned_by(b.grains[1].q, {0, 0, -1e-3});
    b.load(0.0, false);
    const double force = length(b.grains[0].f), t0 = b.grains[0].t.z, t1 = b.grains[1].t.z;
    const int steps = 200;
    for (int k = 1; k <= 100 * steps; ++k) {
      const Vec3 turn{0, 0, 2.0 * kPi * k / steps};
      b.prescribe(
          1e-7,
          [&](int g) {
            return rotated(Vec3{g * distance, 0, 0}, turn);
          },
          [&](int) {
            return Vec3{0, 0, 2.0 * kPi / steps};
          });
    }
    EXPECT_NEAR(length(b.grains[0].f) / force, 1.0, 1e-9);
    EXPECT_NEAR(b.grains[0].t.z / t0, 1.0, 1e-9);
    EXPECT_NEAR(b.grains[1].t.z / t1, 1.0, 1e-9);
  }
}
