// SPDX-License-Identifier: GPL-2.0-or-later
//
// The Norton bond as a bond: elastic like the parallel bond, yield, the criterion, the printed form,
// objectivity while it creeps, energy, options (PHYSICS.md 2.5, items 4-6, 9; pitfalls of 3.3, 3.6).
#include "norton.h"

#include <gtest/gtest.h>

#include <random>

#include "norton_testbench.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

NortonType material(double m = 3.0, double A = 1e-24) {
  NortonType t;
  t.modulus = 1e9;
  t.exponent = m;
  t.log_rate = std::log(A);
  return t;
}

NortonBench one_bond(const NortonType &t, bool flat = false, double distance = 2e-3) {
  NortonBench b(t, flat, 3e-3);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({distance, 0, 0}, 1e-3, 2500);
  b.norton_bond(0, 1);
  b.load(0.0, false);
  return b;
}

// Grain 1 goes to `x` (m) and the ends turn by -+ half of `turn` (rad), in one call that lasts dt.
void move(NortonBench &b, Vec3 x, Vec3 turn, double dt) {
  b.norton->time = dt;
  b.prescribe(1.0, [&](int k) { return k ? x : b.grains[0].x; },
              [&](int k) { return (k ? 0.5 : -0.5) * turn; });
}
void strain_to(NortonBench &b, double strain, double dt = 0.0) {
  move(b, {2e-3 * (1 + strain), 0, 0}, {0, 0, 0}, dt);
}
double stress(const NortonBench &b) { return b.norton->stress(b, b.pairs[0]); }

const double kArea = kPi * 1e-6;

}  // namespace

// Without creep and yield it is the parallel bond of the same stiffness, force by force.
TEST(NortonBond, is_the_parallel_bond_as_long_as_it_is_elastic) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const bool flat : {false, true}) {
    NortonBench a(material(), flat, 3e-3);
    Bench b(flat, 3e-3);
    ParallelParameters p;
    p.modulus = 1e9;
    p.ratio = 2.6;
    p.beta = 0.7;
    for (int k = 0; k < 4; ++k) {
      const Vec3 x{1.9e-3 * k, 2e-4 * u(random), flat ? 0.0 : 2e-4 * u(random)};
      const double r = 1e-3 * (1 + 0.2 * u(random));
      a.add(x, r, 2500), b.add(x, r, 2500);
    }
    for (int k = 0; k < 3; ++k) {
      PairRow &row = b.bond(k, k + 1, p, {2e9, 2.0, 0.5});
      // one measures strain over the distance, the other stiffness over R_i + R_j
      row.stiffness = 1e9 / row.rest;
      a.norton_bond(k, k + 1, {2e9, 2.0, 0.5}).beta = 0.7;
    }
    for (int k = 0; k < 4; ++k) {
      a.grains[k].v = b.grains[k].v = Vec3{u(random), u(random), flat ? 0.0 : u(random)};
      a.grains[k].w = b.grains[k].w = 300.0 * Vec3{flat ? 0.0 : u(random), flat ? 0.0 : u(random), u(random)};
    }
    a.load(0.0, false), b.load(0.0, false);
    for (int k = 0; k < 200; ++k) a.step(1e-7), b.step(1e-7);
    for (int k = 0; k < 4; ++k) {
      EXPECT_LT(length(a.grains[k].f - b.grains[k].f), 1e-9 * length(b.grains[k].f));
      EXPECT_LT(length(a.grains[k].t - b.grains[k].t), 1e-9 * length(b.grains[k].t) + 1e-16);
    }
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(a.pairs[k].sigma / b.pairs[k].sigma, 1.0, 1e-8);
      EXPECT_NEAR(a.pairs[k].tau / b.pairs[k].tau, 1.0, 1e-8);
    }
    EXPECT_NEAR(a.potential_energy() / b.potential_energy(), 1.0, 1e-9);
  }
}

TEST(NortonBond, length_and_radius_by_choice) {
  NortonType t = material();
  EXPECT_EQ(norton_length(t, 2.1e-3, 1e-3, 1e-3), 2.1e-3);
  EXPECT_EQ(norton_radius(t, 1e-3, 0.8e-3), 0.8e-3);
  t.length = BondLength::surface;
  t.least_length = 5e-5;
  EXPECT_NEAR(norton_length(t, 2.1e-3, 1e-3, 1e-3), 1e-4, 1e-18);
  EXPECT_EQ(norton_length(t, 2.0e-3, 1e-3, 1e-3), 5e-5);
  t.length = BondLength::radii;
  EXPECT_EQ(norton_length(t, 2.1e-3, 1e-3, 0.8e-3), 1.8e-3);
  t.length = BondLength::surface;
  t.diameter = 1.09e-3;
  EXPECT_EQ(norton_radius(t, 1e-3, 0.8e-3), 0.545e-3);
  NortonBench b = one_bond(t, false, 2.1e-3);
  move(b, {2.1e-3 + 1e-8, 0, 0}, {0, 0, 0}, 0.0);
  EXPECT_NEAR(stress(b), 1e9 * 1e-8 / 1e-4, 1.0);
}

// Loaded beyond yield and back: along E, to a permanent strain; the rate doesn't matter.
TEST(NortonBond, yield_unloads_elastically_to_a_permanent_strain) {
  NortonType t = material();
  t.yield_t = 4e6;
  t.yield_c = 6e6;
  for (const double side : {1.0, -1.0})
    for (const int steps : {1, 7, 300}) {
      NortonBench b = one_bond(t);
      const double cap = side > 0 ? 4e6 : -6e6;
      for (int k = 1; k <= steps; ++k) strain_to(b, side * 0.01 * k / steps);
      EXPECT_NEAR(stress(b) / cap, 1.0, 1e-12);
      const double permanent = side * 0.01 - cap / 1e9;
      EXPECT_NEAR(b.pairs[0].own[NortonLaw::STRAIN] / permanent, 1.0, 1e-10);
      strain_to(b, side * 0.009);
      EXPECT_NEAR(stress(b) / (cap - side * 1e6), 1.0, 1e-9);
      strain_to(b, permanent);
      EXPECT_NEAR(stress(b), 0.0, 1e-3);
      if (steps == 300) {  // work of plastic flow; the step over the yield point costs some of it
        EXPECT_NEAR(b.dissipated() / (std::fabs(cap * permanent) * kArea * 2e-3), 1.0, 1e-3);
      }
    }
}

// Shear yields by its own stress, radially: the direction stays.
TEST(NortonBond, shear_yield_is_checked_against_its_own_stress_musen) {
  NortonType t = material();
  t.yield_t = t.yield_c = 1e6;
  t.yield_s = 2e6;
  NortonBench b = one_bond(t);
  const double slip = 1.5e6 * 2.6 / 1e9 * 2e-3;
  move(b, {2e-3, 0.6 * slip, 0.8 * slip}, {0, 0, 0}, 0.0);
  EXPECT_NEAR(length(b.pairs[0].fs) / kArea / 1.5e6, 1.0, 1e-4);  // above the normal one: no yield
  move(b, {2e-3, 1.8 * slip, 2.4 * slip}, {0, 0, 0}, 0.0);
  EXPECT_NEAR(length(b.pairs[0].fs) / kArea / 2e6, 1.0, 1e-12);
  EXPECT_NEAR(b.pairs[0].fs.y / b.pairs[0].fs.z, 0.75, 1e-9);
}

// Named after the flaw: a clip of the stress with the total strain lets it unload without a trace.
TEST(NortonBond, yield_clips_with_total_strain_musen) {
  NortonType t = material(), printed = t;
  t.yield_t = printed.yield_t = 4e6;
  use_printed_form(printed, kNever);
  NortonBench b = one_bond(t), p = one_bond(printed);
  for (const double e : {0.01, 0.0}) strain_to(b, e), strain_to(p, e);
  EXPECT_NEAR(stress(b), -6e6, 1.0);  // it stays longer
  EXPECT_NEAR(stress(p), 0.0, 1e-6);  // as printed it has forgotten
}

// The criterion: signed, one strength a side; order tension, shear, crushing.
TEST(NortonBond, breaks_at_its_strengths) {
  const auto fate = [](Vec3 x, Vec3 turn, double crush) {
    NortonType t = material();
    t.crush = crush;
    NortonBench b = one_bond(t);
    b.pairs[0].sigma_c = 10e6;
    b.pairs[0].tau_c = 8e6;
    move(b, x, turn, 0.0);
    return b.pairs[0].fate;
  };
  const double d = 2e-3, u = 10e6 / 1e9 * d, v = 8e6 * 2.6 / 1e9 * d;
  const double bend = 10e6 / 1e9 * d / 1e-3, twist = 8e6 * 2.6 / 1e9 * d / 1e-3;
  const Vec3 at{d, 0, 0}, none{0, 0, 0};
  for (const double s : {1 - 1e-9, 1 + 1e-9}) {
    EXPECT_EQ(fate({d + s * u, 0, 0}, none, kNever), s > 1 ? BondFate::broken_in_tension : BondFate::intact);
    EXPECT_EQ(fate(at, {0, s * bend, 0}, kNever), s > 1 ? BondFate::broken_in_tension : BondFate::intact);
    EXPECT_EQ(fate(at, {s * twist, 0, 0}, kNever), s > 1 ? BondFate::broken_in_shear : BondFate::intact);
    EXPECT_EQ(fate({d - s * u, 0, 0}, none, 10e6), s > 1 ? BondFate::broken_in_crushing : BondFate::intact);
  }
  EXPECT_EQ(fate({d, 1.001 * v, 0}, none, kNever), BondFate::broken_in_shear);
  EXPECT_EQ(fate({d, 0.99 * v, 0}, none, kNever), BondFate::intact);
  EXPECT_EQ(fate({d + 2 * u, 2 * v, 0}, none, kNever), BondFate::broken_in_tension);
  // a broken bond carries nothing, also when it is stretched or pressed later
  NortonBench b = one_bond(material());
  b.pairs[0].sigma_c = 10e6;
  move(b, {d + 2 * u, v, 0}, {1e-3, 1e-3, 0}, 0.0);
  for (const double x : {0.0, 3 * u, -3 * u}) {
    move(b, {d + x, 0, 0}, none, 1.0);
    EXPECT_EQ(length(b.grains[1].f), 0.0);
    EXPECT_EQ(length(b.grains[1].t), 0.0);
    EXPECT_EQ(b.pairs[0].fate, BondFate::intact);
  }
}

// Named after the flaw: eq. 15 prints |F_n|, so a bond breaks in compression at its tensile strength.
TEST(NortonBond, breaks_in_compression_seed002) {
  NortonType t = material(), printed = t;
  use_printed_form(printed, 10e6);
  for (const NortonType &type : {t, printed}) {
    NortonBench b = one_bond(type);
    b.pairs[0].sigma_c = 10e6;
    strain_to(b, -0.011);
    EXPECT_EQ(b.pairs[0].alive, type.cut_only ? 0.0 : 1.0);
  }
}

// The printed equations step by step, in arithmetic of their own: eqs. 10-13 and 15 with the values of
// Table 3 at -15 degrees, A in Pa (so that it matters), E_b of ice on its own scale: strains are large.
// Explicit creep differs by h/2 at most.
TEST(NortonBond, printed_form_follows_the_printed_equations) {
  const double E = 10.68e6, A = 1.5e-10, R = 0.545e-3, dt = 0.2, h = E * A * dt;
  NortonType t = material(1.0, A);
  t.modulus = E;
  t.diameter = 2 * R;
  t.yield_t = 5e6;
  use_printed_form(t, 8.6e6);
  for (const double side : {1.0, -1.0}) {
    NortonBench b = one_bond(t);
    b.pairs[0].sigma_c = 8.6e6;
    b.pairs[0].tau_c = 0.46e6;
    double creep = 0.0, now = 0.0;
    for (int k = 1; k <= 110 && b.pairs[0].alive != 0.0; ++k) {
      const double strain = side * 0.0085 * k;
      strain_to(b, strain, dt);
      creep += dt * A * E * (strain - creep);  // m = 1: the sign is right as printed
      now = std::min(E * (strain - creep), 5e6);
      EXPECT_NEAR(stress(b) / now, 1.0, h);
      EXPECT_EQ(b.pairs[0].alive, std::fabs(stress(b)) >= 8.6e6 ? 0.0 : 1.0);
    }
    EXPECT_EQ(b.pairs[0].alive, side > 0 ? 1.0 : 0.0);  // cut at 5 MPa in tension, broken in compression
    EXPECT_NEAR(std::fabs(now), side > 0 ? 5e6 : 8.6e6, 0.02 * 8.6e6);
  }
}

// Eq. 14 and its "analogous" creep: the same A and m for the shear stress, not those of von Mises.
TEST(NortonBond, printed_form_creeps_in_shear_with_the_same_coefficient) {
  for (const bool printed : {true, false}) {
    NortonType t = material(3.0, 1e-22);
    t.creep = CreepKind::separate;
    if (printed) use_printed_form(t, kNever);
    NortonBench b = one_bond(t);
    const Vec3 x{2e-3, 2e-6, 0};
    move(b, x, {0, 0, 0}, 0.0);
    const double before = length(b.pairs[0].fs) / kArea;
    move(b, x, {0, 0, 0}, 1e3);
    const double after = length(b.pairs[0].fs) / kArea, A = printed ? 1e-22 : 9e-22;
    EXPECT_NEAR((std::pow(after, -2) - std::pow(before, -2)) / (2 * 1e9 / 2.6 * A * 1e3), 1.0, 1e-9);
  }
}

// Loaded, then turned rigidly any way while it relaxes: the same loads in the turned frame.
TEST(NortonBond, objective_while_it_creeps) {
  for (const bool flat : {false, true}) {
    NortonType t = material(3, 1e-24);
    t.moments = true;
    NortonBench still = one_bond(t, flat);
    move(still, {2.008e-3, 6e-6, flat ? 0.0 : -4e-6}, {flat ? 0 : 2e-3, flat ? 0 : -3e-3, 4e-3}, 0.0);
    NortonBench turning = still;
    const Vec3 x = still.grains[1].x, axis = flat ? Vec3{0, 0, 5e-3} : Vec3{3e-3, -2e-3, 3.5e-3};
    const int steps = 4000;
    for (int k = 1; k <= steps; ++k) {
      move(still, x, {0, 0, 0}, 5.0);
      turning.norton->time = 5.0;
      turning.prescribe(1.0, [&](int g) { return g ? rotated(x, static_cast<double>(k) * axis) : Vec3{0, 0, 0}; },
                        [&](int) { return axis; });
    }
    const Vec3 angle = static_cast<double>(steps) * axis;
    EXPECT_LT(length(still.pairs[0].fs), 0.8 * 6e-6 / 2e-3 * 1e9 / 2.6 * kArea);  // it did relax
    EXPECT_NEAR(stress(turning) / stress(still), 1.0, 1e-8);
    for (const int g : {0, 1}) {
      EXPECT_LT(length(turning.grains[g].f - rotated(still.grains[g].f, angle)), 1e-6 * length(still.grains[g].f)) << flat;
      EXPECT_LT(length(turning.grains[g].t - rotated(still.grains[g].t, angle)), 1e-6 * length(still.grains[g].t)) << flat;
    }
  }
}

TEST(NortonBond, exchange_of_the_particles_changes_nothing) {
  for (const bool flat : {false, true}) {
    NortonType t = material(3, 1e-23);
    t.moments = true;
    NortonBench a(t, flat, 3e-3), b(t, flat, 3e-3);
    const Vec3 x[] = {{0, 0, 0}, {1.7e-3, 5e-4, flat ? 0.0 : -3e-4}};
    for (const int k : {0, 1}) a.add(x[k], k ? 0.8e-3 : 1.1e-3, 2500);
    for (const int k : {1, 0}) b.add(x[k], k ? 0.8e-3 : 1.1e-3, 2500);
    a.norton_bond(0, 1), b.norton_bond(0, 1);
    for (int k = 1; k <= 50; ++k) {
      const auto to = [&](int g) { return x[g] + (k * 1e-7) * Vec3{g ? 1.0 : -0.4, g ? -2.0 : 0.5, flat ? 0.0 : 1.0 * g}; };
      const auto spin = [&](int g) { return 1e-5 * Vec3{flat ? 0.0 : 1.0 + g, flat ? 0.0 : -2.0 * g, 3.0 - 2 * g}; };
      a.norton->time = b.norton->time = 5.0;
      a.prescribe(1.0, to, spin);
      b.prescribe(1.0, [&](int g) { return to(1 - g); }, [&](int g) { return spin(1 - g); });
    }
    for (const int g : {0, 1}) {
      EXPECT_LT(length(a.grains[g].f - b.grains[1 - g].f), 1e-11 * length(a.grains[g].f));
      EXPECT_LT(length(a.grains[g].t - b.grains[1 - g].t), 1e-11 * length(a.grains[g].t));
    }
    EXPECT_LT(length(a.grains[0].f + a.grains[1].f), 1e-15 * length(a.grains[0].f));
  }
}
