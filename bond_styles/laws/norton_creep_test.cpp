// SPDX-License-Identifier: GPL-2.0-or-later
//
// One Norton bond pulled, held and loaded: closed forms in time, rate, temperature and scale
// (PHYSICS.md 2.5, items 10 and 12).
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

NortonType material(double m, double A, double E = 1e9) {
  NortonType t;
  t.modulus = E;
  t.exponent = m;
  t.log_rate = std::log(A);
  return t;
}
const double kRate[] = {0, 1e-12, 1e-19, 1e-27, 1e-34};  // A of the table by m
const char *const kRateName[] = {"", "1e-12", "1e-19", "1e-27", "1e-34"};

NortonBench one_bond(const NortonType &t, bool flat = false, double density = 2500.0) {
  NortonBench b(t, flat, 3e-3);
  b.add({0, 0, 0}, 1e-3, density, true);
  b.add({2e-3, 0, 0}, 1e-3, density);
  b.norton_bond(0, 1);
  b.load(0.0, false);
  return b;
}

// The pair takes this strain in one call of the law that lasts dt.
void strain_to(NortonBench &b, double strain, double dt) {
  b.norton->time = dt;
  b.prescribe(1.0, [&](int k) { return Vec3{k ? 2e-3 * (1 + strain) : 0, 0, 0}; },
              [](int) { return Vec3{0, 0, 0}; });
}
double stress(const NortonBench &b) { return b.norton->stress(b, b.pairs[0]); }

// Stress after pulling at a constant rate for a time, in so many steps.
double pulled(const NortonType &t, double rate, double time, int steps, int every = 1) {
  NortonBench b = one_bond(t);
  b.norton->every = every;
  for (int k = 1; k <= steps; ++k) strain_to(b, rate * time * k / steps, time / steps);
  return stress(b);
}

}  // namespace

TEST(NortonBond, relaxation_at_held_strain) {
  for (const bool flat : {false, true})
    for (const CreepKind kind : {CreepKind::coupled, CreepKind::separate})
      for (int m = 1; m <= 4; ++m) {
        NortonType type = material(m, kRate[m]);
        type.creep = kind;
        NortonBench b = one_bond(type, flat);
        strain_to(b, 5e-3, 0.0);
        EXPECT_NEAR(stress(b), 5e6, 1e-5);
        double t = 0.0;
        for (const int mark : {1, 10, 100, 1000, 10000}) {
          for (int k = 0; k < 7; ++k) strain_to(b, 5e-3, (mark - t) / 7.0);
          t = mark;
          const std::string row = "E=1e9 m=" + std::to_string(m) + " A=" + kRateName[m] +
                                  " Pa^-m/s sigma0=5e6; t=" + std::to_string(mark) + " s";
          const double right = reference()("norton_relaxation", row, "sigma");
          EXPECT_NEAR(stress(b) / right, 1.0, 1e-8) << row;
          const double area = flat ? 2e-3 * 3e-3 : kPi * 1e-6;
          EXPECT_NEAR(-b.grains[1].f.x / (right * area), 1.0, 1e-8) << row;
        }
      }
}

// Under constant stress the strain is s/E + A s^m t. The load is held at the end of each step, so the
// step starts a little above it: first order, and none of it is left in the extrapolation.
TEST(NortonBond, creep_at_constant_stress) {
  for (int m = 1; m <= 4; ++m) {
    const double A = kRate[m], h0 = 1e9 * A * std::pow(5e6, m - 1);
    const auto error = [&](int steps) {
      NortonBench b = one_bond(material(m, A));
      const double dt = 1000.0 / steps, y = (m - 1) * h0 * dt;
      const double raised = m == 1 ? std::exp(h0 * dt) : std::pow(1 - y, -1.0 / (m - 1));
      double strain = 0.0;
      for (int k = 0; k < steps; ++k) {
        strain = b.pairs[0].own[NortonLaw::STRAIN] + 5e-3 * raised;
        strain_to(b, strain, dt);
        EXPECT_NEAR(stress(b) / 5e6, 1.0, 1e-9);
      }
      const double total = b.pairs[0].own[NortonLaw::STRAIN] + 5e-3;
      return total / reference()("norton_creep",
                                 "E=1e9 m=" + std::to_string(m) + " A=" + kRateName[m] +
                                     " sigma=5e6 const; t=1000 s",
                                 "strain") - 1.0;
    };
    const double coarse = error(500), fine = error(1000);
    EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.02) << m;
    EXPECT_LT(std::fabs(2 * fine - coarse), 1e-6) << m;
  }
}

TEST(NortonBond, constant_rate) {
  for (int m = 1; m <= 4; ++m) {
    const std::string row = "E=1e9 m=" + std::to_string(m) + " A=" + kRateName[m] + " rate=1e-6";
    const double flow = reference()("norton_const_rate", row, "sigma_inf");
    for (const char *part : {"0.5", "0.8", "0.95"}) {
      const double share = std::atof(part);
      const double time = reference()("norton_const_rate", row + "; sigma=" + part + " sigma_inf", "time");
      const auto at = [&](int steps) { return pulled(material(m, kRate[m]), 1e-6, time, steps) / (share * flow) - 1; };
      const double coarse = at(1000), fine = at(2000);
      EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.05) << row << part;
      EXPECT_LT(std::fabs(2 * fine - coarse), 1e-6) << row << part;
    }
    // in the end it flows
    EXPECT_NEAR(pulled(material(m, kRate[m]), 1e-6, 40 * flow / 1e3, 20000) / flow, 1.0, 1.05e-3);
  }
}

// The error of a split step with 100 steps up to 0.8 of the flow stress, m = 3, is known: -0.30 %.
TEST(NortonBond, a_hundred_steps_are_good_to_a_third_of_a_percent) {
  EXPECT_NEAR(pulled(material(3, 1e-27), 1e-6, 9504.59181, 100) / 8e6 - 1.0, -3.0e-3, 1e-4);
}

// Creep every n-th step: within h/2 (1 + h) of the exact curve, h the share that creeps at once, below
// it after a step that creeps and above it just before.
TEST(NortonBond, creep_every_few_steps_stays_within_its_bound) {
  const double E = 1e9, A = 1e-27, rate = 1e-6, time = 9504.59181, steps = 2000.0, dt = time / steps;
  for (const int every : {1, 5, 20, 50}) {
    NortonBench b = one_bond(material(3, A));
    b.norton->every = every;
    double exact = 0.0, worst = 0.0;
    for (int k = 1; k <= steps; ++k) {
      // ds/dt = E (rate - A s^3) by the classic Runge-Kutta rule, good to 1e-12 at this step
      const auto slope = [&](double s) { return E * (rate - A * s * s * s); };
      const double k1 = slope(exact), k2 = slope(exact + 0.5 * dt * k1), k3 = slope(exact + 0.5 * dt * k2),
                   k4 = slope(exact + dt * k3);
      exact += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      strain_to(b, rate * time * k / steps, dt);
      const double s = stress(b), h = E * A * s * s * every * dt, off = s / exact - 1.0;
      const double pulls = static_cast<double>(k) / every;  // a ramp of few steps is a coarse one
      EXPECT_LT(std::fabs(off), 0.5 * h * (1 + h + 3 / pulls) + 1e-9) << every << " " << k;
      worst = std::max(worst, std::fabs(off) / h);
    }
    EXPECT_NEAR(exact / 8e6, 1.0, 1e-8);
    EXPECT_GT(worst, 0.2);  // and the bound is no idle one
  }
}

// Slower than r_c = A s_max^m the bond flows for ever, faster it breaks.
TEST(NortonBond, ductile_to_brittle_at_the_critical_rate) {
  const double A = 1e-27, m = 3, strong = 8e6, critical = A * std::pow(strong, m);
  const auto breaks = [&](double rate, int steps) {
    NortonBench b = one_bond(material(m, A));
    b.pairs[0].sigma_c = strong;
    const double end = 12.0 * strong / 1e9;
    for (int k = 1; k <= steps; ++k) {
      strain_to(b, end * k / steps, end / rate / steps);
      if (b.pairs[0].alive == 0.0) return true;
    }
    return false;
  };
  const auto threshold = [&](int steps) {
    double low = 0.5, high = 2.0;
    for (int k = 0; k < 24; ++k) {
      const double middle = 0.5 * (low + high);
      (breaks(middle * critical, steps) ? high : low) = middle;
    }
    return high;
  };
  const double coarse = threshold(600), fine = threshold(1200);
  EXPECT_NEAR(2 * fine - coarse, 1.0, 2e-4);
  EXPECT_LT(fine - 1.0, coarse - 1.0);
}

// log peak against log rate: slope 1/m while it flows, 0 once it breaks.
TEST(NortonBond, peak_stress_follows_the_rate_by_one_over_m) {
  for (const double m : {1.0, 2.5, 4.0}) {
    const double A = 1e-6 * std::pow(5e6, -m);
    const auto peak = [&](double rate) {
      NortonBench b = one_bond(material(m, A));
      b.pairs[0].sigma_c = 50e6;
      double most = 0.0;
      const double flow = std::pow(rate / A, 1.0 / m), end = 10 * std::min(flow, 50e6) / 1e9;
      for (int k = 1; k <= 800; ++k) {
        strain_to(b, end * k / 800, end / rate / 800);
        most = std::max(most, b.pairs[0].sigma);
      }
      return most;
    };
    const double critical = A * std::pow(50e6, m);
    EXPECT_NEAR(std::log(peak(0.1 * critical) / peak(0.001 * critical)) / std::log(100.0), 1.0 / m, 1e-6);
    const double fast = peak(1e3 * critical), faster = peak(1e5 * critical);
    EXPECT_NEAR(std::log(faster / fast) / std::log(100.0), 0.0, 3e-3);
    EXPECT_NEAR(faster / 50e6, 1.0, 0.02);
  }
}

// Item 12 (i), and what it is for: c times faster with c times the creep is the same curve. `c` given
// as a factor of the rate or of the coefficient is the same bond.
TEST(NortonBond, rate_factor_leaves_the_curve_alone) {
  NortonType slow = material(3, 1e-27), fast = slow, scaled = material(3, 1e-27 * 1e4);
  fast.rate_factor = 1e4;
  for (const double time : {1e3, 1e4, 3e4}) {
    const double curve = pulled(slow, 1e-6, time, 300);
    EXPECT_NEAR(pulled(fast, 1e-2, time / 1e4, 300) / curve, 1.0, 1e-12);
    EXPECT_NEAR(pulled(scaled, 1e-2, time / 1e4, 300) / curve, 1.0, 1e-12);
    EXPECT_GT(std::fabs(pulled(slow, 1e-2, time / 1e4, 300) / curve - 1.0), 1e-4);
  }
}

// Item 12 (ii): stresses and moduli times c, A times c^-m.
TEST(NortonBond, stress_scale_leaves_the_curve_alone) {
  const double c = 37.0;
  for (const double m : {1.0, 3.0, 4.2}) {
    const double A = 1e-6 * std::pow(5e6, -m);
    const double curve = pulled(material(m, A), 1e-6, 8e3, 200);
    EXPECT_NEAR(pulled(material(m, A * std::pow(c, -m), 1e9 * c), 1e-6, 8e3, 200) / curve / c, 1.0, 1e-12);
  }
}

// Item 12 (iv): density times c, time times sqrt(c): the same path, inertia and creep together.
TEST(NortonBond, density_scale_leaves_the_path_alone) {
  const auto path = [](double c) {
    NortonBench b = one_bond(material(2, 1e-7 * 1e-6 / std::sqrt(c)), false, 2500.0 * c);
    b.grains[1].v = (1.0 / std::sqrt(c)) * Vec3{3.0, 1.0, 0.5};
    b.grains[1].w = (1.0 / std::sqrt(c)) * Vec3{300.0, -200.0, 500.0};
    const double dt = 1e-7 * std::sqrt(c);
    b.norton->time = dt;
    for (int k = 0; k < 500; ++k) b.step(dt);
    EXPECT_GT(b.dissipated(), 0.01 * b.potential_energy());
    return b.grains[1].x;
  };
  const Vec3 light = path(1.0), heavy = path(400.0);
  EXPECT_LT(length(heavy - light), 1e-11 * length(light));
}

// Arrhenius: at another temperature the same curve, at the rate times exp(-Q/R (1/T - 1/T_ref)).
TEST(NortonBond, time_temperature_superposition) {
  NortonType cold = material(3, 1e-27);
  cold.temperature.reference = 258.15;
  cold.temperature.activation = 60e3;
  const double warm = 268.15, a = std::exp(-60e3 / 8.31446261815324 * (1 / warm - 1 / 258.15));
  EXPECT_NEAR(a, 2.836, 1e-3);
  const auto curve = [&](double kelvin, double rate) {
    NortonBench b = one_bond(cold);
    b.pairs[0].own[NortonLaw::KELVIN] = kelvin;
    for (int k = 1; k <= 200; ++k) strain_to(b, 8e-3 * k / 200, 8e-3 / rate / 200);
    return stress(b);
  };
  EXPECT_NEAR(curve(warm, a * 1e-6) / curve(258.15, 1e-6), 1.0, 1e-12);
  EXPECT_LT(curve(warm, 1e-6), curve(258.15, 1e-6));
}

// E(T) and strength(T): linear about the reference; stored shear force and stress follow E.
TEST(NortonBond, modulus_and_strength_follow_the_temperature) {
  NortonType t = material(1, 1e-300);
  t.temperature.modulus = -1.4e-3;
  t.temperature.strength = -0.02;
  NortonBench b = one_bond(t);
  b.pairs[0].sigma_c = 10e6;
  b.prescribe(1.0, [](int k) { return Vec3{k ? 2.001e-3 : 0, k ? 1e-6 : 0, 0}; }, [](int) { return Vec3{0, 0, 0}; });
  const double cold = stress(b), shear = b.pairs[0].fs.y;
  b.pairs[0].own[NortonLaw::KELVIN] = 263.15 + 10.0;
  const Vec3 x = b.grains[1].x;
  b.prescribe(1.0, [&](int k) { return k ? x : Vec3{0, 0, 0}; }, [](int) { return Vec3{0, 0, 0}; });
  EXPECT_NEAR(stress(b) / cold, 1 - 0.014, 1e-12);
  EXPECT_NEAR(b.pairs[0].fs.y / shear, 1 - 0.014, 1e-12);
  EXPECT_EQ(b.pairs[0].alive, 1.0);
  const auto holds = [&](double stress_at_break) {
    NortonBench c = one_bond(t);
    c.pairs[0].sigma_c = 10e6;
    c.pairs[0].own[NortonLaw::KELVIN] = 263.15 + 10.0;
    strain_to(c, stress_at_break / (0.986e9), 0.0);
    return c.pairs[0].alive;
  };
  EXPECT_EQ(holds(8e6 * (1 - 1e-9)), 1.0);
  EXPECT_EQ(holds(8e6 * (1 + 1e-9)), 0.0);
  EXPECT_EQ(linear_share(-1.0, 400.0, 263.15), 0.01);  // never zero or negative
}

// Named after the flaw: seed 002 prints A sigma^m, which for a compressive stress is complex, or of the
// wrong sign for an even m.
TEST(NortonBond, power_of_a_compressive_stress_seed002) {
  for (const double m : {1.0, 2.0, 2.6, 3.0, 4.0}) {
    const double A = 1e-4 * std::pow(5e6, -m) * 5e-3;
    NortonBench pull = one_bond(material(m, A)), push = pull;
    for (int k = 0; k < 50; ++k) strain_to(pull, 5e-3, 100.0), strain_to(push, -5e-3, 100.0);
    EXPECT_LT(stress(pull), 4.9e6);
    EXPECT_NEAR(stress(push) / -stress(pull), 1.0, 1e-12) << m;
  }
}

// Named after the flaw: MUSEN's explicit factor 1 - dt A |tau|^m L/|u| of the shear displacement turns
// negative at a large step.
TEST(NortonBond, explicit_shear_factor_turns_the_sign_musen) {
  for (const CreepKind kind : {CreepKind::separate, CreepKind::coupled})
    for (const double dt : {1e3, 1e6, 1e20}) {
      NortonType t = material(3, 1e-24);
      t.creep = kind;
      NortonBench b = one_bond(t);
      const auto at = [](int k) { return Vec3{k ? 2e-3 : 0, k ? 2e-5 : 0, 0}; };
      b.prescribe(1.0, at, [](int) { return Vec3{0, 0, 0}; });
      const double start = b.pairs[0].fs.y;
      b.norton->time = dt;
      const double explicit_factor = 1 - dt * 1e-24 * std::pow(start / (kPi * 1e-6), 3) / 1e-2;
      b.prescribe(1.0, at, [](int) { return Vec3{0, 0, 0}; });
      EXPECT_LT(explicit_factor, 0.0);
      EXPECT_GT(b.pairs[0].fs.y / start, 0.0) << dt;
      EXPECT_LT(b.pairs[0].fs.y / start, 1.0) << dt;
    }
}
