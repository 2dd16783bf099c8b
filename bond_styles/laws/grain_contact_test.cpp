// SPDX-License-Identifier: GPL-2.0-or-later
//
// The contact of grains: stiffness from a modulus, Coulomb's cap, and the stress-free reference of
// pairs that were bonded (PHYSICS.md 3.1).
#include "grain_contact.h"

#include <gtest/gtest.h>

#include <random>

#include "chain_testbench.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

Bench touching(double overlap, const ContactSpec &c, bool flat = false, double thickness = 1.0,
               double r2 = 1e-3) {
  Bench b(flat, thickness);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({1e-3 + r2 - overlap, 0, 0}, r2, 2500);
  b.contact(0, 1, c);
  return b;
}

void slide(Bench &b, Vec3 move, Vec3 turn = {0, 0, 0}) {
  Grain &g = b.grains[1];
  g.v = move;
  g.x = g.x + move;
  g.w = turn;
  b.load(1.0);
}

}  // namespace

// k = 4 R E_c a grain (2 t E_c a disc), two in series.
TEST(GrainContact, series_stiffness) {
  EXPECT_DOUBLE_EQ(grain_stiffness_3d(1e-3, 5e9), 2e7);
  EXPECT_DOUBLE_EQ(grain_stiffness_2d(0.02, 5e9), 2e8);
  EXPECT_DOUBLE_EQ(in_series(2e7, 2e7), 1e7);
  EXPECT_DOUBLE_EQ(in_series(2e7, 1e7), 2e7 / 3.0);
  EXPECT_EQ(in_series(0.0, 1e7), 0.0);
  Bench b = touching(1e-6, {5e9, 2.0, 0.5}, false, 1.0, 0.5e-3);
  b.load(0.0, false);
  EXPECT_NEAR(b.grains[1].f.x / (1e-6 * in_series(2e7, 1e7)), 1.0, 1e-9);
  Bench flat = touching(1e-6, {5e9, 2.0, 0.5}, true, 0.02, 0.5e-3);
  flat.load(0.0, false);
  EXPECT_NEAR(flat.grains[1].f.x / (1e-6 * 1e8), 1.0, 1e-9);  // discs: whatever the radii
}

TEST(GrainContact, pushes_and_never_pulls) {
  for (const bool flat : {false, true}) {
    for (const double overlap : {1e-6, -1e-6}) {
      Bench b = touching(overlap, {5e9, 2.0, 0.5}, flat, 0.01);
      b.load(0.0, false);
      if (overlap > 0.0) {
        EXPECT_GT(b.grains[1].f.x, 0.0);
      } else {
        EXPECT_EQ(length(b.grains[1].f), 0.0);
      }
      EXPECT_EQ(b.grains[0].f.x, -b.grains[1].f.x);
    }
  }
}

TEST(GrainContact, shear_springs_then_slips_at_the_cap) {
  for (const bool flat : {false, true}) {
    const ContactSpec c{5e9, 2.5, 0.4};
    Bench b = touching(1e-6, c, flat, 0.01);
    b.load(0.0, false);
    const PairRow &row = b.pairs[0];
    const double cap = 0.4 * b.grains[1].f.x, slip = cap / row.ks;
    EXPECT_NEAR(row.kn / row.ks, 2.5, 1e-12);
    const auto shear = [&] { return flat ? row.cs.x : std::copysign(length(row.cs), row.cs.y); };
    slide(b, {0, 0.5 * slip, 0});
    EXPECT_NEAR(shear() / (0.5 * cap), 1.0, 1e-6);
    // sliding by 6e-6 m lengthens the distance by 1e-8, so that the normal force falls by 1 %
    slide(b, {0, 5.0 * slip, 0});
    const auto normal = [&] { return row.kn * (row.reference - b.distance(0, 1)); };
    EXPECT_NEAR(shear() / (0.4 * normal()), 1.0, 1e-12);
    // back: the spring unloads from the cap at once
    const double held = shear();
    slide(b, {0, -0.5 * slip, 0});
    EXPECT_NEAR((held - shear()) / (0.5 * cap), 1.0, 1e-5);
    slide(b, {0, -5.0 * slip, 0});
    EXPECT_NEAR(shear() / (-0.4 * normal()), 1.0, 1e-12);
  }
}

// The cap acts on the vector, not on its components: sliding along any direction, |F_s| = mu F_n.
TEST(GrainContact, cap_is_round) {
  for (int k = 0; k < 12; ++k) {
    Bench b = touching(1e-6, {5e9, 2.0, 0.3});
    const double a = k * kPi / 6;
    slide(b, 1e-6 * Vec3{0, std::cos(a), std::sin(a)});
    const double normal = dot(b.grains[1].f, unit(b.grains[1].x));
    const Vec3 shear = b.grains[1].f - normal * unit(b.grains[1].x);
    EXPECT_NEAR(length(shear) / (0.3 * normal), 1.0, 1e-12);
    EXPECT_NEAR(dot(unit(shear), Vec3{0, std::cos(a), std::sin(a)}), -1.0, 1e-6);
  }
}

TEST(GrainContact, rolling_does_not_shear) {
  for (const bool flat : {false, true}) {
    Bench b = touching(1e-6, {5e9, 2.0, 0.5}, flat, 0.01);
    b.grains[0].w = {0, 0, 1e-6};
    slide(b, {0, 0, 0}, {0, 0, -1e-6});
    EXPECT_LT(length(b.pairs[0].cs), 1e-15);
    b.grains[0].w = {0, 0, 1e-6};
    slide(b, {0, 0, 0}, {0, 0, 1e-6});  // counter-rotating surfaces slide by R (w1 + w2)
    EXPECT_NEAR(b.grains[1].f.y / ((2e-3 - 1e-6) * 1e-6 * b.pairs[0].ks), 1.0, 1e-9);
  }
}

TEST(GrainContact, separation_wipes_the_history) {
  for (const bool flat : {false, true}) {
    Bench b = touching(1e-6, {5e9, 2.0, 0.5}, flat, 0.01);
    slide(b, {0, 1e-7, 0});
    EXPECT_GT(length(b.pairs[0].cs), 0.0);
    slide(b, {1e-5, 0, 0});
    EXPECT_EQ(length(b.pairs[0].cs), 0.0);
    EXPECT_EQ(length(b.grains[1].f), 0.0);
    slide(b, {-1e-5, 0, 0});
    EXPECT_LT(length(b.pairs[0].cs), 1e-3 * b.grains[1].f.x);  // no memory of the slide before
  }
}

TEST(GrainContact, modulus_zero_is_no_contact) {
  Bench b = touching(1e-5, {0.0, 2.0, 0.5});
  slide(b, {0, 1e-6, 0});
  EXPECT_EQ(length(b.grains[1].f), 0.0);
}

// Named after the flaw: a packing with overlaps or gaps would be loaded by the act of bonding.
TEST(GrainContact, stress_free_at_bonding_distance_cement_precompression) {
  for (const double distance : {1.9e-3, 2e-3, 2.1e-3}) {
    Bench b;
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({distance, 0, 0}, 1e-3, 2500);
    ParallelParameters p;
    p.modulus = 1e9;
    b.bond(0, 1, p, {5e9, 2.0, 0.5});
    b.load(1e-7);
    EXPECT_EQ(length(b.grains[0].f) + length(b.grains[0].t), 0.0);
    // pressed, both act; pulled, the bond alone
    const double bond = 1e9 * kPi * 1e-6 / 2e-3, contact = 1e7;
    slide(b, {-1e-7, 0, 0});
    EXPECT_NEAR(b.grains[1].f.x / (1e-7 * (bond + contact)), 1.0, 1e-8);
    slide(b, {2e-7, 0, 0});
    EXPECT_NEAR(b.grains[1].f.x / (-1e-7 * bond), 1.0, 1e-8);
  }
}

// The reference goes from the bonding distance to R_i + R_j at a distance beyond both, where neither
// loads the contact: whichever is larger, no force jumps.
TEST(GrainContact, reference_switches_where_nothing_is_loaded) {
  for (const double bonded_at : {1.99e-3, 2.01e-3}) {
    Bench b;
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({bonded_at, 0, 0}, 1e-3, 2500);
    b.contact(0, 1, {5e9, 2.0, 0.5});
    b.pairs[0].reference = bonded_at;
    b.grains[1].x.x = std::max(bonded_at, 2e-3);
    b.load(1e-7);
    const Vec3 before = b.grains[1].f;
    b.pairs[0].reference = 2e-3;
    b.load(1e-7);
    EXPECT_EQ(length(before), 0.0);
    EXPECT_EQ(length(b.grains[1].f), 0.0);
  }
}

TEST(GrainContact, energy_is_that_of_two_springs) {
  EXPECT_DOUBLE_EQ(contact_energy(3.0, 4.0, 2.0, 8.0), 9.0 / 4.0 + 16.0 / 16.0);
  EXPECT_EQ(contact_energy(0.0, 0.0, 0.0, 0.0), 0.0);
}

// Sliding takes energy, never gives it: closed loops of random slides.
TEST(GrainContact, friction_only_dissipates) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const bool flat = trial % 2;
    Bench b = touching(1e-6, {5e9, 2.0, 0.4}, flat, 0.01);
    b.load(0.0, false);
    const Vec3 home = b.grains[1].x;
    double work = 0.0;
    const double start = b.potential_energy();
    for (int k = 0; k < 100; ++k) {
      const Grain before = b.grains[1];
      const Vec3 next = k == 99 ? home : home + 1e-7 * Vec3{u(random), 50 * u(random), flat ? 0.0 : 50 * u(random)};
      const int parts = 40;
      const Vec3 move = (1.0 / parts) * (next - before.x);
      for (int m = 0; m < parts; ++m) {
        const Grain now = b.grains[1];
        slide(b, move);
        work -= 0.5 * dot(now.f + b.grains[1].f, move);
      }
    }
    EXPECT_GT(work, b.potential_energy() - start);
    EXPECT_GT(work, 1e-4);  // 100 slides of 5e-6 m under 4 N or less
  }
}
