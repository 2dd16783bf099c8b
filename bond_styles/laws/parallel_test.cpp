// SPDX-License-Identifier: GPL-2.0-or-later
//
// When a parallel bond breaks: critical loads, the two criteria and their order (PHYSICS.md 2.5,
// item 9; pitfalls of 3.1). What is left after a break is in bond_break_test.cpp.
#include "parallel.h"

#include <gtest/gtest.h>

#include "chain_testbench.h"
#include "reference_table.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

const ReferenceTable &reference() {
  static const ReferenceTable table;
  return table;
}

const std::string kCritical = "; E=1e9 nu=.3 R_b=R=1mm l=2mm rho=2500; sigma_c=10 MPa tau_c=8 MPa beta=1";

// The table's bond and strengths, but 1e5 times stiffer: loads at the break don't depend on
// stiffness, and displacements are so small that the closed forms, which are linear, hold to 1e-8.
constexpr double kE = 1e14;
constexpr double kUnit = 10e6 * 2e-3 / kE;  // stretch of the bond at 10 MPa, m

Bench reference_bond(double beta = 1.0, double friction_degrees = 0.0) {
  Bench b;
  b.add({0, 0, 0}, 1e-3, 2500, true);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  ParallelParameters p;
  p.modulus = kE;
  p.ratio = 2.6;
  p.beta = beta;
  p.tan_phi = std::tan(friction_degrees * kPi / 180.0);
  PairRow &row = b.bond(0, 1, p);
  row.sigma_c = 10e6;
  row.tau_c = 8e6;
  return b;
}

// Grain 1 moves and turns by `size` times the given rates in one step.
PairRow after(Bench b, double size, Vec3 move, Vec3 turn) {
  Grain &g = b.grains[1];
  g.v = size * move;
  g.x = g.x + g.v;
  g.w = size * turn;
  b.load(1.0);
  return b.pairs[0];
}

// Smallest size at which the bond breaks, by bisection to rounding.
double critical_size(const Bench &b, double guess, Vec3 move, Vec3 turn) {
  double holds = 0.0, breaks = 2.0 * guess;
  EXPECT_EQ(after(b, breaks, move, turn).alive, 0.0);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (holds + breaks);
    (after(b, middle, move, turn).alive == 0.0 ? breaks : holds) = middle;
  }
  return breaks;
}

const double kArea = kPi * 1e-6, kKn = kE * kArea / 2e-3, kKs = kKn / 2.6;
const double kKb = kE * 0.25 * kArea * 1e-6 / 2e-3, kKt = kE / 2.6 * 0.5 * kArea * 1e-6 / 2e-3;

}  // namespace

TEST(Strength, tension) {
  const double u = critical_size(reference_bond(), kUnit, {1, 0, 0}, {0, 0, 0});
  EXPECT_NEAR(u * kKn / reference()("bond_critical", "tension" + kCritical, "F"), 1.0, 1e-8);
  EXPECT_EQ(after(reference_bond(), 1.01 * u, {1, 0, 0}, {0, 0, 0}).fate, BondFate::broken_in_tension);
}

// Centres move apart across the bond without turning: pure shear, nothing bends.
TEST(Strength, shear) {
  const double u = critical_size(reference_bond(), 2 * kUnit, {0, 1, 0}, {0, 0, 0});
  EXPECT_NEAR(u * kKs / reference()("bond_critical", "shear (no bending moment at mid-section)" + kCritical, "F"), 1.0, 1e-8);
  EXPECT_EQ(after(reference_bond(), 1.01 * u, {0, 1, 0}, {0, 0, 0}).fate, BondFate::broken_in_shear);
}

TEST(Strength, pure_bending) {
  const Bench b = reference_bond();
  // half each way, so that nothing shears
  const auto bent = [&](double angle) {
    Bench c = b;
    c.grains[0].w = {0, 0, -0.5 * angle};
    c.grains[1].w = {0, 0, 0.5 * angle};
    c.load(1.0);
    return c.pairs[0];
  };
  const double critical = reference()("bond_critical", "pure bending" + kCritical, "M") / kKb;
  EXPECT_EQ(bent(critical * (1 - 1e-8)).alive, 1.0);
  EXPECT_EQ(bent(critical * (1 + 1e-8)).fate, BondFate::broken_in_tension);
  EXPECT_EQ(bent(-critical * (1 + 1e-8)).fate, BondFate::broken_in_tension);
}

TEST(Strength, pure_torsion) {
  const double psi = critical_size(reference_bond(), 2e3 * kUnit, {0, 0, 0}, {1, 0, 0});
  EXPECT_NEAR(psi * kKt / reference()("bond_critical", "pure torsion" + kCritical, "T"), 1.0, 1e-8);
  EXPECT_EQ(after(reference_bond(), 1.01 * psi, {0, 0, 0}, {1, 0, 0}).fate, BondFate::broken_in_shear);
}

// The transverse force a bond carries as a cantilever: bending at mid-section breaks it first.
TEST(Strength, transverse_force_on_a_cantilever_of_one_bond) {
  const double F = reference()("bond_critical",
                               "transverse force on a 1-bond cantilever, moment evaluated at mid-section (parallel bond carries the relative-rotation moment only)" + kCritical,
                               "F");
  for (const double factor : {1 - 1e-4, 1 + 1e-4}) {
    Bench b = reference_bond();
    const double dt = 5e-9, omega = 4.4e7;  // of the slower of the two modes
    b.viscous = 2.0 * omega;
    b.load(0.0, false);
    const int steps = 2000;  // the pull grows over the first three quarters, slowly: 300/omega
    for (int k = 0; k < steps; ++k) {
      b.grains[1].pull.y = factor * F * std::min(1.0, k / (0.75 * steps));
      b.step(dt);
    }
    EXPECT_EQ(b.pairs[0].alive, factor < 1 ? 1.0 : 0.0) << factor;
    if (factor < 1) {
      EXPECT_NEAR(b.pairs[0].sigma / 10e6, factor, 1e-7);
    }
  }
}

// Named after the flaw: |F_n| in the criterion breaks bonds in compression.
TEST(Strength, breaks_in_compression_richti83) {
  const PairRow row = after(reference_bond(), 5 * kUnit, {-1, 0, 0}, {0, 0, 0});  // five times sigma_c
  EXPECT_EQ(row.alive, 1.0);
  EXPECT_LT(row.sigma, -40e6);
  Bench flat(true, 1e-2);
  flat.add({0, 0, 0}, 1e-3, 2500);
  flat.add({2e-3, 0, 0}, 1e-3, 2500);
  ParallelParameters p;
  p.modulus = 1e9;
  PairRow &bond = flat.bond(0, 1, p);
  bond.sigma_c = 10e6;
  bond.tau_c = 8e6;
  EXPECT_EQ(after(flat, 1e-4, {-1, 0, 0}, {0, 0, 0}).alive, 1.0);
}

// Bending under compression: the rim on the far side is in tension only beyond the compression.
TEST(Strength, compression_relieves_bending) {
  Bench b = reference_bond();
  const double critical = 10e6 * 0.25 * kArea * 1e-3 / kKb;
  b.pairs[0].rest += 0.5 * kUnit;  // 5 MPa of compression
  Bench c = b;
  c.grains[0].w.z = -0.5 * 1.49 * critical, c.grains[1].w.z = 0.5 * 1.49 * critical;
  c.load(1.0);
  EXPECT_EQ(c.pairs[0].alive, 1.0);
  b.grains[0].w.z = -0.5 * 1.51 * critical, b.grains[1].w.z = 0.5 * 1.51 * critical;
  b.load(1.0);
  EXPECT_EQ(b.pairs[0].alive, 0.0);
}

// tau_c - sigma_n tan(phi): c + p tan(phi) under compression p, and sigma_n has no moment part.
TEST(Strength, friction_form_uses_the_mean_normal_stress_only) {
  for (const double degrees : {30.0, 45.0}) {
    const Bench plain = reference_bond(1.0, degrees);
    Bench pressed = plain;
    pressed.pairs[0].rest += 0.5 * kUnit;  // 5 MPa
    const double u = critical_size(pressed, 2.5 * kUnit, {0, 1, 0}, {0, 0, 0});
    const std::string row = "shear under 5 MPa compression c=8 MPa phi=" + std::to_string(static_cast<int>(degrees)) + " deg";
    EXPECT_NEAR(u * kKs / reference()("bond_critical_MC", row, "Fs"), 1.0, 1e-6);  // the shear stretches the bond by u^2/(2 l)
    // bent as well: the shear strength doesn't change
    pressed.pairs[0].mb = {0, 0.9 * 15e6 * 0.25 * kArea * 1e-3, 0};
    const double bent = critical_size(pressed, 2.5 * kUnit, {0, 1, 0}, {0, 0, 0});
    EXPECT_NEAR(bent / u, 1.0, 1e-12);
  }
}

// With friction, tension alone reaches c/tan(phi) (not c tan(phi)).
TEST(Strength, friction_form_in_tension_is_c_over_tan_phi) {
  for (const double degrees : {30.0, 60.0}) {
    Bench b = reference_bond(1.0, degrees);
    b.pairs[0].sigma_c = 1e12;
    const double critical = 8e6 / std::tan(degrees * kPi / 180.0) * kArea;
    const double u = critical_size(b, critical / kKn, {1, 0, 0}, {0, 0, 0});
    EXPECT_NEAR(u * kKn / critical, 1.0, 1e-8);
    EXPECT_EQ(after(b, 1.01 * u, {1, 0, 0}, {0, 0, 0}).fate, BondFate::broken_in_shear);
  }
}

// Both criteria met in the same step: the tensile one is named.
TEST(Strength, tension_is_looked_at_first) {
  EXPECT_EQ(after(reference_bond(), 5 * kUnit, {1, 1, 0}, {1, 0, 0}).fate, BondFate::broken_in_tension);
}

// beta scales the part of both moments: sigma = F/A + beta M R/I, tau = F/A + beta T R/J.
TEST(Strength, moment_contribution_factor) {
  const double T = 8e6 * 0.5 * kArea * 1e-3;
  for (const double beta : {0.25, 0.5, 1.0}) {
    const double psi = critical_size(reference_bond(beta), T / kKt / beta, {0, 0, 0}, {1, 0, 0});
    EXPECT_NEAR(psi * kKt / T, 1.0 / beta, 1e-8);
    Bench b = reference_bond(beta);
    b.pairs[0].mb = {0, 0.999999 * 10e6 / beta * 0.25 * kArea * 1e-3, 0};
    b.load(1.0);
    EXPECT_EQ(b.pairs[0].alive, 1.0);
    EXPECT_NEAR(b.pairs[0].sigma, 0.999999 * 10e6, 1.0);
    b.pairs[0].mb.y *= 1.000002;
    b.load(1.0);
    EXPECT_EQ(b.pairs[0].fate, BondFate::broken_in_tension);
  }
  // beta = 0: no moment breaks it
  EXPECT_EQ(after(reference_bond(0.0), 0.5, {0, 0, 0}, {1, 0, 0}).alive, 1.0);
}

TEST(Strength, combined_stresses_add_up) {
  Bench b = reference_bond();
  b.pairs[0].fs = {0, 3.0, 4.0};
  b.pairs[0].mb = {0, 1e-3, 0};
  b.pairs[0].mt = -2e-3;
  b.pairs[0].rest -= 0.1 * kUnit;  // 1 MPa of tension
  b.load(1.0);
  EXPECT_NEAR(b.pairs[0].sigma, 1e6 + 1e-3 * 4.0 / (kArea * 1e-3), 0.1);
  EXPECT_NEAR(b.pairs[0].tau, 5.0 / kArea + 2e-3 * 2.0 / (kArea * 1e-3), 1e-3);
}

// In the plane: A = 2 R t, I = 2 R^3 t/3.
TEST(Strength, plane_critical_loads) {
  const double t = 7e-3, A = 2e-3 * t, I = 2.0 / 3.0 * 1e-9 * t, E = kE;
  Bench b(true, t);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  ParallelParameters p;
  p.modulus = E;
  p.ratio = 2.6;
  PairRow &row = b.bond(0, 1, p);
  row.sigma_c = 10e6;
  row.tau_c = 8e6;
  const double kn = E * A / 2e-3, kb = E * I / 2e-3;
  EXPECT_NEAR(critical_size(b, kUnit, {1, 0, 0}, {0, 0, 0}) * kn / (10e6 * A), 1.0, 1e-8);
  EXPECT_NEAR(critical_size(b, 2 * kUnit, {0, 1, 0}, {0, 0, 0}) * kn / 2.6 / (8e6 * A), 1.0, 1e-8);
  const double M = 10e6 * I / 1e-3;
  for (const double factor : {1 - 1e-8, 1 + 1e-8}) {
    Bench c = b;
    c.grains[0].w.z = -0.5 * factor * M / kb;
    c.grains[1].w.z = 0.5 * factor * M / kb;
    c.load(1.0);
    EXPECT_EQ(c.pairs[0].alive, factor < 1 ? 1.0 : 0.0);
  }
}

// R_b = lambda min(R1, R2), stiffness E/(R1 + R2): PFC's definitions, as the law's page says.
TEST(Strength, radius_multiplier_and_the_smaller_grain) {
  Bench b;
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({1.6e-3, 0, 0}, 0.6e-3, 2500);
  ParallelParameters p;
  p.modulus = 1e9;
  p.lambda = 0.5;
  b.bond(0, 1, p);
  const double u = 1e-7;
  const PairRow row = after(b, u, {1, 0, 0}, {0, 0, 0});
  EXPECT_NEAR(row.force.x / (u * 1e9 / 1.6e-3 * kPi * 0.09e-6), 1.0, 1e-8);
}
