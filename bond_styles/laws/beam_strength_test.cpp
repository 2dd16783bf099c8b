// SPDX-License-Identifier: GPL-2.0-or-later
//
// When a beam bond breaks, the size of its stiffnesses, and what a break leaves (PHYSICS.md 2.5,
// item 9; 3.2 and the seed 004 line of 3.7).
#include <gtest/gtest.h>

#include "beam_testbench.h"
#include "reference_table.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

const ReferenceTable &reference() {
  static const ReferenceTable table;
  return table;
}

// 1e5 times stiffer than the table's bond, so that the closed forms, which are linear, hold to
// 1e-8.
constexpr double kE = 1e14;
constexpr double kUnit = 10e6 * 2e-3 / kE;  // stretch at 10 MPa, m
const double kArea = kPi * 1e-6, kKn = kE * kArea / 2e-3, kKs = kKn / 2.6;
const double kKb = 0.25e-6 * kKn, kKt = 0.5e-6 * kKn / 2.6;

BeamParameters law(double cohesion, double degrees) {
  BeamParameters p;
  p.modulus = kE;
  p.poisson = 0.3;
  p.cohesion = cohesion;
  p.tan_phi = std::tan(degrees * kPi / 180.0);
  return p;
}

Bench one_bond(const BeamParameters &p, bool flat = false, double thickness = 1.0) {
  Bench b = beam_bench(flat, thickness);
  b.add({0, 0, 0}, 1e-3, 2500, true);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  beam(b, 0, 1, p);
  return b;
}

// Grain 1 moves, and both ends turn, by `size` times the given rates in one step.
Bench after(Bench b, double size, Vec3 move, Vec3 turn_i, Vec3 turn_j) {
  b.grains[0].w = size * turn_i;
  b.grains[1].w = size * turn_j;
  b.grains[1].v = size * move;
  b.drift(1.0);
  b.load(1.0);
  return b;
}

// Smallest size at which the bond breaks, by bisection to rounding.
double critical(const Bench &b, double guess, Vec3 move, Vec3 turn_i = {0, 0, 0},
                Vec3 turn_j = {0, 0, 0}) {
  double holds = 0.0, breaks = 2.0 * guess;
  EXPECT_EQ(after(b, breaks, move, turn_i, turn_j).pairs[0].alive, 0.0);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (holds + breaks);
    (after(b, middle, move, turn_i, turn_j).pairs[0].alive == 0.0 ? breaks : holds) = middle;
  }
  return breaks;
}

const Vec3 kNone{0, 0, 0}, kAlong{1, 0, 0}, kAcross{0, 1, 0};

}  // namespace

// Named after the flaw: seed 004's branch c tan(phi) for the tensile strength; at 45 degrees, where
// it is usually tested, the two are the same.
TEST(BeamStrength, tension_is_c_over_tan_phi_not_c_tan_phi_seed004) {
  for (const int degrees : {30, 45}) {
    const Bench b = one_bond(law(8e6, degrees));
    const std::string row =
        "uniaxial tension, beam MC c=8 MPa phi=" + std::to_string(degrees) + " deg";
    const double u = critical(b, 2 * kUnit, kAlong);
    EXPECT_NEAR(u * kKn / reference()("bond_critical_MC", row, "F"), 1.0, 1e-8);
    EXPECT_EQ(after(b, 1.01 * u, kAlong, kNone, kNone).pairs[0].fate, BondFate::broken_in_tension);
  }
}

// The closed form is linear: turning the bond by the shear stretches it by u^2/(2 l).
TEST(BeamStrength, shear_under_compression_is_c_plus_p_tan_phi) {
  for (const int degrees : {30, 45}) {
    Bench b = one_bond(law(8e6, degrees));
    b.pairs[0].own[kRest] += 0.5 * kUnit;  // 5 MPa
    const std::string row =
        "shear under 5 MPa compression c=8 MPa phi=" + std::to_string(degrees) + " deg";
    const double u = critical(b, 2.5 * kUnit, kAcross);
    EXPECT_NEAR(u * kKs / reference()("bond_critical_MC", row, "Fs"), 1.0, 1e-6);
    EXPECT_EQ(after(b, 1.01 * u, kAcross, kNone, kNone).pairs[0].fate, BondFate::broken_in_shear);
  }
}

// With a cut-off at 10 MPa and no friction the table's rows of the parallel bond hold.
TEST(BeamStrength, critical_loads_with_a_tension_cutoff) {
  const std::string row =
      "; E=1e9 nu=.3 R_b=R=1mm l=2mm rho=2500; sigma_c=10 MPa tau_c=8 MPa beta=1";
  BeamParameters p = law(8e6, 0.0);
  p.cutoff = 10e6;
  const Bench b = one_bond(p);
  EXPECT_NEAR(critical(b, kUnit, kAlong) * kKn / reference()("bond_critical", "tension" + row, "F"),
              1.0, 1e-8);
  EXPECT_NEAR(
      critical(b, 2 * kUnit, kAcross) * kKs /
          reference()("bond_critical", "shear (no bending moment at mid-section)" + row, "F"),
      1.0, 1e-8);
  EXPECT_NEAR(critical(b, 2e3 * kUnit, kNone, kNone, kAlong) * kKt /
                  reference()("bond_critical", "pure torsion" + row, "T"),
              1.0, 1e-8);
  for (const double sign : {1.0, -1.0})
    EXPECT_NEAR(2.0 * critical(b, 2e3 * kUnit, kNone, {0, 0, -sign}, {0, 0, sign}) * kKb /
                    reference()("bond_critical", "pure bending" + row, "M"),
                1.0, 1e-8);
  EXPECT_EQ(after(b, 1.5 * kUnit, kAlong, kNone, kNone).pairs[0].fate, BondFate::broken_in_tension);
  EXPECT_EQ(after(b, 4e3 * kUnit, kNone, kNone, kAlong).pairs[0].fate, BondFate::broken_in_shear);
}

TEST(BeamStrength, transverse_force_on_a_cantilever_of_one_bond) {
  const double F =
      reference()("bond_critical",
                  "transverse force on a 1-bond cantilever, moment evaluated at mid-section "
                  "(parallel bond carries the relative-rotation moment only); E=1e9 nu=.3 "
                  "R_b=R=1mm l=2mm rho=2500; sigma_c=10 MPa tau_c=8 MPa beta=1",
                  "F");
  for (const double factor : {1 - 1e-4, 1 + 1e-4}) {
    BeamParameters p = law(8e6, 0.0);
    p.cutoff = 10e6;
    Bench b = one_bond(p);
    const double dt = 5e-9, omega = 4.4e7;  // of the slower of the two modes
    b.viscous = 2.0 * omega;
    b.load(0.0, false);
    const int steps = 2000;
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

// Named after the flaw: |F_n| in a criterion breaks bonds in compression.
TEST(BeamStrength, breaks_in_compression_richti83) {
  for (const bool flat : {false, true}) {
    BeamParameters p = law(8e6, 30.0);
    p.cutoff = 10e6;
    const Bench b = after(one_bond(p, flat, 1e-2), 50 * kUnit, {-1, 0, 0}, kNone, kNone);
    EXPECT_EQ(b.pairs[0].alive, 1.0);
    EXPECT_LT(b.pairs[0].sigma, -400e6);
  }
}

// The bending stress counts with its tensile side: bending weakens a bond also under compression.
TEST(BeamStrength, bending_weakens_even_in_compression) {
  Bench b = one_bond(law(8e6, 30.0));
  b.pairs[0].own[kRest] += 0.5 * kUnit;  // 5 MPa
  const double tan_phi = std::tan(kPi / 6), straight = critical(b, 3 * kUnit, kAcross);
  const double bend = 3e6 * 0.25 * kArea * 1e-3 / kKb;  // 3 MPa at the rim
  for (Grain &g : b.grains) g.w = kNone;
  b.grains[0].q = turned_by(b.grains[0].q, {0, 0, -0.5 * bend});
  b.grains[1].q = turned_by(b.grains[1].q, {0, 0, 0.5 * bend});
  const double bent = critical(b, 3 * kUnit, kAcross);
  EXPECT_NEAR(straight * kKs / kArea, 8e6 + 5e6 * tan_phi, 20.0);
  EXPECT_NEAR(bent * kKs / kArea, 8e6 + 2e6 * tan_phi, 20.0);
}

TEST(BeamStrength, moment_factors) {
  BeamParameters p = law(8e6, 0.0);
  p.cutoff = 10e6;
  const double M = 10e6 * 0.25 * kArea * 1e-3, T = 8e6 * 0.5 * kArea * 1e-3;
  for (const double beta : {0.25, 0.5, 1.0}) {
    BeamParameters q = p;
    q.beta1 = beta;
    EXPECT_NEAR(
        2 * critical(one_bond(q), M / kKb / beta, kNone, {0, 0, -1}, {0, 0, 1}) * kKb / M * beta,
        1.0, 1e-8);
    EXPECT_NEAR(critical(one_bond(q), T / kKt, kNone, kNone, kAlong) * kKt / T, 1.0,
                1e-8);  // not its own
    q = p;
    q.beta2 = beta;
    EXPECT_NEAR(critical(one_bond(q), T / kKt / beta, kNone, kNone, kAlong) * kKt / T * beta, 1.0,
                1e-8);
  }
}

TEST(BeamStrength, plane_critical_loads) {
  const double t = 7e-3, A = 2e-3 * t, I = 2.0 / 3.0 * 1e-9 * t, kn = kE * A / 2e-3,
               kb = kE * I / 2e-3;
  BeamParameters p = law(8e6, 30.0);
  const Bench b = one_bond(p, true, t);
  const double tan_phi = std::tan(kPi / 6);
  EXPECT_NEAR(critical(b, 2 * kUnit, kAlong) * kn / (8e6 / tan_phi * A), 1.0, 1e-8);
  EXPECT_NEAR(critical(b, 2 * kUnit, kAcross) * kn / 2.6 / (8e6 * A), 1.0, 1e-6);
  EXPECT_NEAR(
      2 * critical(b, 2e3 * kUnit, kNone, {0, 0, -1}, {0, 0, 1}) * kb / (8e6 / tan_phi * I / 1e-3),
      1.0, 1e-8);
}

// One bond, half the turn at each end: E I theta/l. Named after the flaw: ESyS-Particle's code has
// half of it, which is what bend_factor is for.
TEST(BeamStiffness, bending_is_EI_theta_over_l_and_half_of_it_in_esys) {
  const Rod rod;
  for (const double factor : {1.0, 0.5}) {
    BeamParameters p;
    p.modulus = rod.E, p.poisson = rod.nu, p.bend_factor = factor;
    const Bench b = after(one_bond(p), 0.005, kNone, {0, 0, -1}, {0, 0, 1});
    const double M =
        reference()("bond_bending", rod.name() + "; relative bend 0.01 rad, no shear", "moment");
    EXPECT_NEAR(b.grains[1].t.z / -M, factor, 1e-8);
    EXPECT_EQ(b.grains[1].t.z, -b.grains[0].t.z);
    EXPECT_LT(length(b.grains[1].f), 1e-11);
  }
}

TEST(BeamStiffness, torsion_is_GJ_psi_over_l) {
  const Rod rod;
  BeamParameters p;
  p.modulus = rod.E, p.poisson = rod.nu;
  const Bench b = after(one_bond(p), 0.01, kNone, kNone, kAlong);
  EXPECT_NEAR(b.grains[1].t.x /
                  -reference()("bond_torsion", rod.name() + "; relative twist 0.01 rad", "moment"),
              1.0, 1e-8);
  EXPECT_LT(length(b.grains[1].f), 1e-12);
}

// Named after the flaw: R_i + R_j in the place of R_b = (R_i + R_j)/2 makes K_n, K_s twice and K_b,
// K_t eight times too large. With touching grains: k_n = pi E R_b/2, k_b = pi E R_b^3/8, k_t = pi G
// R_b^3/4.
TEST(BeamStiffness, radius_is_the_mean_of_both_seed004) {
  Bench b = beam_bench();
  b.add({0, 0, 0}, 1.2e-3, 2500);
  b.add({2e-3, 0, 0}, 0.8e-3, 2500);
  BeamParameters p;
  p.modulus = 3e9, p.poisson = 0.2;
  const BeamStiffness k = BeamLaw::stiffness(b, beam(b, 0, 1, p));
  const double R = 1e-3, E = 3e9, G = E / 2.4;
  EXPECT_NEAR(k.normal / (0.5 * kPi * E * R), 1.0, 1e-14);
  EXPECT_NEAR(k.shear / (0.5 * kPi * G * R), 1.0, 1e-14);
  EXPECT_NEAR(k.bend / (kPi / 8 * E * R * R * R), 1.0, 1e-14);
  EXPECT_NEAR(k.twist / (kPi / 4 * G * R * R * R), 1.0, 1e-14);
  p.lambda = 0.5;
  EXPECT_NEAR(BeamLaw::stiffness(b, beam(b, 0, 1, p)).normal / (0.125 * kPi * E * R), 1.0, 1e-14);
}

// Named after the peculiarity: ESyS's rest length is R1 + R2, so that bonds over a gap start
// loaded.
TEST(BeamStiffness, rest_length_at_creation_or_touching_esys) {
  for (const double gap : {-2e-5, 0.0, 2e-5}) {
    Bench b = beam_bench();
    b.add({0, 0, 0}, 1e-3, 2500);
    b.add({2e-3 + gap, 0, 0}, 1e-3, 2500);
    BeamParameters p;
    p.modulus = 1e9, p.poisson = 0.2;
    Bench c = b;
    beam(b, 0, 1, p);
    p.touching = true;
    beam(c, 0, 1, p);
    b.load(0.0, false);
    c.load(0.0, false);
    EXPECT_LT(length(b.grains[0].f), 1e-12);
    EXPECT_NEAR(c.grains[0].f.x, gap * 1e9 * kArea / 2e-3, 1e-11);
  }
}

// What a break leaves: the bond's load is gone; in compression a contact of the same stiffness
// carries on without a jump of the normal force; it slides from nothing, and friction limits it.
TEST(BeamBreak, contact_of_the_same_stiffness_takes_over) {
  for (const bool flat : {false, true}) {
    BeamParameters p = law(8e6, 20.0);
    p.friction = 0.5;
    Bench b = one_bond(p, flat, 3e-3);
    Bench strong = b;
    strong.pairs[0].own[kCohesion] = 1e300;
    const Vec3 press{-2, 4, 0};  // in units of 10 MPa
    b = after(b, kUnit, press, kNone, kNone);
    strong = after(strong, kUnit, press, kNone, kNone);
    ASSERT_EQ(b.pairs[0].fate, BondFate::broken_in_shear);
    const Vec3 e = unit(b.grains[1].x);
    // the last digit of the distance is 1e-9 of the overlap
    EXPECT_NEAR(dot(b.grains[1].f, e) / dot(strong.grains[1].f, e), 1.0, 2e-9);
    EXPECT_LT(length(cross(b.grains[1].f, e)), 1e-12 * length(b.grains[1].f));
    EXPECT_EQ(length(b.grains[0].t) + length(b.grains[1].t), 0.0);
    // slides: k_s, then mu F_n
    const double kn = BeamLaw::stiffness(b, b.pairs[0]).normal,
                 ks = BeamLaw::stiffness(b, b.pairs[0]).shear;
    const double limit = 0.5 * kn * 2 * kUnit;
    double slid = 0.0;
    for (int k = 0; k < 200; ++k) {
      const double step = 0.05 * kUnit;
      b.grains[1].v = {0, step, 0};
      b.grains[1].w = b.grains[0].w = kNone;
      b.drift(1.0);
      b.load(1.0);
      slid += step;
      EXPECT_EQ(b.pairs[0].fate, BondFate::intact);  // reported once
      EXPECT_NEAR(-b.grains[1].f.y / std::min(ks * slid, limit), 1.0, 1e-4);
    }
    EXPECT_GT(ks * slid, 2 * limit);
    // pulled apart: nothing
    b.grains[1].v = {3 * kUnit, 0, 0};
    b.drift(1.0);
    b.load(1.0);
    EXPECT_EQ(length(b.grains[1].f), 0.0);
    EXPECT_EQ(length(b.pairs[0].cs), 0.0);
  }
}

// A pair with a grain contact has that one alone, before and after.
TEST(BeamBreak, grain_contact_is_used_alone) {
  BeamParameters p = law(8e6, 20.0);
  Bench b = beam_bench();
  b.add({0, 0, 0}, 1e-3, 2500, true);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  beam(b, 0, 1, p, {1e13, 2.0, 0.5});
  const double grain = in_series(grain_stiffness_3d(1e-3, 1e13), grain_stiffness_3d(1e-3, 1e13));
  Bench held = after(b, kUnit, {-0.1, 0, 0}, kNone, kNone);
  EXPECT_NEAR(held.grains[1].f.x / (0.1 * kUnit), kKn + grain, 1e-8 * kKn);
  b.pairs[0].own[kCohesion] = 1.0;
  b.pairs[0].own[kTanPhi] = 0.0;
  Bench broken = after(b, kUnit, {-0.1, 1e-3, 0}, kNone, kNone);
  EXPECT_EQ(broken.pairs[0].alive, 0.0);
  EXPECT_NEAR(broken.grains[1].f.x / (0.1 * kUnit), grain, 1e-8 * grain);
  EXPECT_NEAR(length(broken.pairs[0].cs) / (1e-3 * kUnit * grain / 2.0), 1.0, 1e-6);
}

// Nothing changes and nothing breaks during the set-up of a run.
TEST(BeamBreak, set_up_changes_nothing) {
  for (const bool options : {false, true}) {
    Bench b = one_bond(law(8e6, 30.0));
    auto kernel = std::make_shared<BeamLaw>();
    kernel->options = options;
    b.law = kernel;
    b.pairs[0].own[kViscous] = 1.0;
    b.pairs[0].own[kFailure] = 2.0;
    b.grains[1].x.x += 10 * kUnit;  // far beyond its strength
    const PairRow before = b.pairs[0];
    b.load(0.0, false);
    EXPECT_EQ(b.pairs[0].alive, 1.0);
    EXPECT_EQ(b.pairs[0].fate, BondFate::intact);
    EXPECT_EQ(b.pairs[0].own, before.own);
    EXPECT_GT(length(b.grains[0].f), 1.0);
  }
}
