// SPDX-License-Identifier: GPL-2.0-or-later
//
// Moments that creep: one bond bent and twisted, a cantilever that goes on sinking (PHYSICS.md 2.5,
// item 11), and the macroscopic exponent when everything that carries load creeps (3.3).
#include <gtest/gtest.h>

#include "norton_testbench.h"
#include "reference_table.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

const ReferenceTable &reference() {
  static const ReferenceTable table;
  return table;
}

NortonType material(double m, double A) {
  NortonType t;
  t.modulus = 1e9;
  t.exponent = m;
  t.log_rate = std::log(A);
  t.creep = CreepKind::none;
  t.moments = true;
  return t;
}

NortonBench one_bond(const NortonType &t, bool flat = false) {
  NortonBench b(t, flat, 3e-3);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  b.norton_bond(0, 1);
  b.load(0.0, false);
  return b;
}

// Ends turn against each other by this much in one call that lasts dt; nothing shears.
void turn(NortonBench &b, Vec3 angle, double dt) {
  b.norton->time = dt;
  b.prescribe(1.0, [&](int k) { return b.grains[k].x; },
              [&](int k) { return (k ? 0.5 : -0.5) * angle; });
}

// dM/dt = -K M^m: K from the moment before and after a time, exact for any time.
double constant_of(double before, double after, double m, double t) {
  if (m == 1.0) return std::log(before / after) / t;
  return (std::pow(after, 1 - m) - std::pow(before, 1 - m)) / ((m - 1) * t);
}

}  // namespace

// Without the option a moment stays as it is: the printed law, and MUSEN's.
TEST(NortonMoments, are_elastic_without_the_option) {
  NortonType t = material(3, 1e-20);
  t.moments = false;
  t.creep = CreepKind::coupled;
  NortonBench b = one_bond(t);
  turn(b, {1e-3, 2e-3, 0}, 0.0);
  const Vec3 bend = b.pairs[0].mb;
  const double twist = b.pairs[0].mt;
  for (int k = 0; k < 100; ++k) turn(b, {0, 0, 0}, 1e6);
  EXPECT_NEAR(length(b.pairs[0].mb - bend), 0.0, 1e-15 * length(bend));
  EXPECT_NEAR(b.pairs[0].mt / twist, 1.0, 1e-13);
}

// Curvature rate A (M/I_m)^m, twist rate A_s (T/J_m)^m, relaxing the moment's own stiffness.
TEST(NortonMoments, bend_and_twist_relax_at_their_own_rates) {
  for (int m = 1; m <= 5; ++m) {
    const std::string row = "round section, m=" + std::to_string(m);
    const double A = 1e-4 / 1e9 * std::pow(1e6, 1 - m), R = 1e-3;
    const double Im = reference()("norton_bending", row, "I_m/R^(3+1/m)") * std::pow(R, 3 + 1.0 / m);
    const double Jm = reference()("norton_torsion", row, "J_m/R^(3+1/m)") * std::pow(R, 3 + 1.0 / m);
    const double As = A * reference()("norton_shear", "von Mises consistent, m=" + std::to_string(m), "A_s/A");
    const double EI = 1e9 * kPi / 4 * std::pow(R, 4), GJ = 1e9 / 2.6 * kPi / 2 * std::pow(R, 4);
    for (const double dt : {1.0, 1e4, 1e8}) {
      NortonBench b = one_bond(material(m, A));
      turn(b, {2e-3, 0, 3e-3}, 0.0);
      const double M = length(b.pairs[0].mb), T = b.pairs[0].mt;
      EXPECT_NEAR(M / (EI / 2e-3 * 3e-3), 1.0, 1e-9);
      turn(b, {0, 0, 0}, dt);
      if (m == 1 && dt > 1e6) continue;  // nothing is left to look at
      const double tolerance = dt < 2.0 ? 1e-6 : 2e-8;
      EXPECT_NEAR(constant_of(M, length(b.pairs[0].mb), m, dt) / (EI * A / std::pow(Im, m)), 1.0, tolerance) << m << " " << dt;
      EXPECT_NEAR(constant_of(T, b.pairs[0].mt, m, dt) / (GJ * As / std::pow(Jm, m)), 1.0, tolerance) << m << " " << dt;
    }
  }
}

// Strip of width 2 R and thickness t: M = (k/A)^(1/m) 2 t R^(2+1/m)/(2+1/m).
TEST(NortonMoments, bend_of_a_strip) {
  for (const double m : {1.0, 2.0, 3.7}) {
    const double A = 1e-4 / 1e9 * std::pow(1e6, 1 - m), R = 1e-3, t = 3e-3;
    const double Im = 2 * t * std::pow(R, 2 + 1 / m) / (2 + 1 / m), EI = 1e9 * 2.0 / 3.0 * R * R * R * t;
    NortonBench b = one_bond(material(m, A), true);
    turn(b, {0, 0, 3e-3}, 0.0);
    const double M = b.pairs[0].mb.x;
    turn(b, {0, 0, 0}, 3e3);
    EXPECT_NEAR(constant_of(M, b.pairs[0].mb.x, m, 3e3) / (EI * A / std::pow(Im, m)), 1.0, 1e-10) << m;
  }
}

const double kR = 1e-3, kL = 2e-3, kEI = 1e9 * kPi / 4 * 1e-12;

double table_velocity(int m, int n) {
  return reference()("norton_cantilever_creep",
                     "R_b=1mm l=2mm F=1e-3 m=" + std::to_string(m) + " A=" +
                         (m == 1 ? "1e-12" : "1e-21") + "; n=" + std::to_string(n) +
                         "; moment creep only (no shear creep)",
                     "steady tip velocity");
}

// Steady sinking of a cantilever's tip: the moment of each bond is known from statics, the rate at
// which it turns from the law. A bond turns about its middle.
TEST(NortonMoments, cantilever_tip_velocity_by_statics) {
  for (const int m : {1, 3})
    for (const int n : {1, 5, 10, 20}) {
      const double A = m == 1 ? 1e-12 : 1e-21;
      double velocity = 0.0;
      for (int i = 0; i < n; ++i) {
        const double lever = (n - i - 0.5) * kL, M = 1e-3 * lever;
        NortonBench b = one_bond(material(m, A));
        turn(b, {0, 0, M * kL / kEI}, 0.0);
        const double start = length(b.pairs[0].mb);
        EXPECT_NEAR(start / M, 1.0, 1e-9);
        const double stress = 4 * M / (kPi * kR * kR * kR), dt = 1.0 / (1e9 * A * std::pow(stress, m - 1));
        turn(b, {0, 0, 0}, dt);
        velocity += constant_of(start, length(b.pairs[0].mb), m, dt) * std::pow(M, m) * kL / kEI * lever;
      }
      EXPECT_NEAR(velocity / table_velocity(m, n), 1.0, 1e-8) << m << " " << n;
    }
}

// The same by motion: a chain under its tip load, brought to rest but for its creep, which is made so
// fast that it shows and so slow that neither the drag nor the sag matters (1e-4).
TEST(NortonMoments, cantilever_sinks_at_the_steady_velocity) {
  for (const int m : {1, 3})
    for (const int n : {1, 5}) {
      NortonType type = material(m, m == 1 ? 1e-12 : 1e-21);
      type.rate_factor = m == 1 ? 1e2 : 1e3;
      NortonBench b(type);
      for (int k = 0; k <= n; ++k) b.add({k * kL, 0, 0}, 1e-3, 2500, k == 0);
      for (int k = 0; k < n; ++k) b.norton_bond(k, k + 1);
      b.grains[n].pull = {0, -1e-3, 0};
      const double per_length = b.grains[n].mass / kL, length = (n + 0.5) * kL, dt = 1e-6;
      const double omega = 3.516 * std::sqrt(kEI / per_length) / (length * length);
      b.viscous = 1.4 * omega;
      b.norton->time = dt;
      b.load(0.0, false);
      const long steps = std::lround(35.0 / (0.7 * omega * dt));
      for (long k = 0; k < steps; ++k) b.step(dt);
      // mean over a while: positions have rounding
      const double y = b.grains[n].x.y;
      for (long k = 0; k < steps; ++k) b.step(dt);
      const double velocity = -(b.grains[n].x.y - y) / (steps * dt) / type.rate_factor;
      EXPECT_NEAR(velocity / table_velocity(m, n), 1.0, 1e-4) << m << " " << n;
    }
}

// A frame in which bonds are pulled, sheared, bent and twisted at once, its ends moved apart at a
// constant rate: the force in steady flow.
double flow_force(NortonType type, double rate, double dt, long steps) {
  NortonBench b(type);
  const double h = 1e-3 * std::sqrt(3.0);
  b.add({0, 0, 0}, 1e-3, 2500, true);
  b.add({2e-3, 0, 0}, 1e-3, 2500);
  b.add({3e-3, h, 0}, 1e-3, 2500);
  b.add({4e-3, h, 2e-3}, 1e-3, 2500, true);
  for (int k = 0; k < 3; ++k) b.norton_bond(k, k + 1);
  b.viscous = 3e4;
  b.norton->time = dt;
  b.grains[3].v = {5e-3 * rate, 0, 0};
  b.load(0.0, false);
  for (long k = 0; k < steps; ++k) b.step(dt);
  return -b.grains[3].f.x;
}

// If everything that carries load creeps with m, the flow force goes with rate^(1/m) exactly. Moments
// that don't creep carry a share of the load for good.
TEST(NortonMoments, macroscopic_exponent_is_that_of_the_bond_if_all_of_it_creeps) {
  for (const CreepKind kind : {CreepKind::coupled, CreepKind::separate}) {
    NortonType type = material(3, 0.01 * std::pow(1e4, -3));  // 0.01 1/s at 10 kPa, 1e-5 of strain
    type.creep = kind;
    const double dt = 5e-7;
    const double slow = flow_force(type, 0.01, dt, 40000), fast = flow_force(type, 0.08, dt, 40000);
    EXPECT_NEAR(std::log(fast / slow) / std::log(8.0), 1.0 / 3.0, 2e-3);
    type.moments = false;
    EXPECT_GT(flow_force(type, 0.08, dt, 20000), 1.05 * fast);
  }
}
