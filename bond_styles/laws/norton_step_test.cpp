// SPDX-License-Identifier: GPL-2.0-or-later
//
// The creep step alone: closed forms, the coupled step against quadrature, limits of exponent and size
// (PHYSICS.md 2.5, items 10 and 11; pitfalls of 3.3).
#include "norton_step.h"

#include <gtest/gtest.h>

#include <random>

#include "norton_type.h"
#include "reference_table.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

const ReferenceTable &reference() {
  static const ReferenceTable table;
  return table;
}

double relaxed(double s, double E, double A, double m, double t) {
  return s - s * single_creep(s * s, E, std::log(A * t), m - 1.0);
}

// x of int_0^x s_eq^(1-m) dx = A dt by Gauss-Legendre on many pieces and bisection: slow and right.
double exact_time(double s2, double t2, double E, double S, double m, double adt) {
  const double at[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
  const double weight[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const auto integral = [&](double x) {
    const int pieces = 60;
    double sum = 0.0;
    for (int k = 0; k < pieces; ++k)
      for (int g = 0; g < 5; ++g) {
        const double z = (k + 0.5 + 0.5 * at[g]) * x / pieces;
        sum += weight[g] * std::pow(s2 * std::exp(-2 * E * z) + t2 * std::exp(-2 * S * z), 0.5 * (1 - m));
      }
    return 0.5 * sum * x / pieces;
  };
  double low = 0.0, high = 1e-30;
  while (integral(high) < adt) high *= 2;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (integral(middle) < adt ? low : high) = middle;
  }
  return high;
}

}  // namespace

// One step of any length gives the closed form.
TEST(NortonStep, relaxation_in_one_step) {
  const double rate[] = {1e-12, 1e-19, 1e-27, 1e-34};
  const char *name[] = {"1e-12", "1e-19", "1e-27", "1e-34"};
  for (int m = 1; m <= 4; ++m)
    for (const int t : {1, 10, 100, 1000, 10000}) {
      const std::string row = "E=1e9 m=" + std::to_string(m) + " A=" + name[m - 1] +
                              " Pa^-m/s sigma0=5e6; t=" + std::to_string(t) + " s";
      const double right = reference()("norton_relaxation", row, "sigma");
      EXPECT_NEAR(relaxed(5e6, 1e9, rate[m - 1], m, t) / right, 1.0, 3e-9) << row;
    }
}

// Two steps are one: the step is exact, so nothing depends on how the time is cut.
TEST(NortonStep, steps_add_up) {
  for (const double m : {0.5, 0.99, 1.0, 1.0 + 1e-9, 1.01, 1.7, 3.0, 4.5, 12.0}) {
    const double A = std::pow(5e6, 1.0 - m) * 1e-13;  // E A s^(m-1) = 1e-4 1/s
    double cut = 5e6;
    for (int k = 0; k < 1000; ++k) cut = relaxed(cut, 1e9, A, m, 7.0);
    EXPECT_NEAR(cut / relaxed(5e6, 1e9, A, m, 7000.0), 1.0, 1e-12) << m;
  }
}

TEST(NortonStep, exponent_near_one_joins_the_exponential) {
  const double straight = relaxed(5e6, 1e9, 1e-12, 1.0, 700.0);
  EXPECT_NEAR(straight / (5e6 * std::exp(-0.7)), 1.0, 3e-15);
  for (const double off : {1e-15, 1e-12, 1e-9, 1e-6})
    for (const double m : {1.0 - off, 1.0 + off}) {
      const double A = 1e-12 * std::pow(5e6, 1.0 - m);
      EXPECT_NEAR(relaxed(5e6, 1e9, A, m, 700.0) / straight, 1.0, off + 3e-15) << m;
    }
}

// m < 1: [s^(1-m) - (1-m) E A t]^(1/(1-m)), nothing left once the bracket is used up.
TEST(NortonStep, small_exponent_relaxes_in_finite_time) {
  const double A = 1e-13 * std::pow(5e6, 0.5), end = 2.0 / 1e-4;  // m = 0.5
  for (const double part : {0.1, 0.5, 0.99})
    EXPECT_NEAR(relaxed(5e6, 1e9, A, 0.5, part * end) / (5e6 * std::pow(1.0 - part, 2)), 1.0, 1e-12);
  EXPECT_LT(relaxed(5e6, 1e9, A, 0.5, 1.01 * end), 1e-9);
  EXPECT_GE(relaxed(5e6, 1e9, A, 0.5, 1e9 * end), 0.0);
}

// The share lost is right to rounding however little creeps.
TEST(NortonStep, tiny_creep_keeps_its_digits) {
  for (const double m : {1.0, 2.0, 3.3, 5.0})
    for (const double h : {1e-6, 1e-12, 1e-18, 1e-30, 1e-100}) {
      const double lost = single_creep(2e6 * 2e6, 1e9, std::log(h / 1e9) - (m - 1) * std::log(2e6), m - 1);
      EXPECT_NEAR(lost / h, 1.0, m * h + 5e-13) << m << " " << h;
    }
}

// Stable for any time: the stress falls towards zero, keeps its sign and stays a number.
TEST(NortonStep, any_time_is_stable) {
  for (const double m : {0.3, 1.0, 2.0, 3.0, 7.5, 50.0})
    for (const double s : {0.0, 1e-200, 1e-3, 1.0, 1e6, 1e12, 1e100})
      for (double log_a = -600.0; log_a <= 600.0; log_a += 50.0) {
        const double lost = single_creep(s * s, 1e9, log_a, m - 1.0);
        ASSERT_TRUE(lost >= 0.0 && lost <= 1.0) << m << " " << s << " " << log_a << " " << lost;
        const CreepLoss both = coupled_creep(s, 0.3 * s * s, 1e9, 1.2e9, log_a, m - 1.0);
        ASSERT_TRUE(both.normal >= 0.0 && both.normal <= 1.0 && both.shear >= 0.0 && both.shear <= 1.0);
      }
}

// Longer or faster creep never leaves more.
TEST(NortonStep, relaxation_is_monotone) {
  for (const double m : {0.5, 1.0, 3.0, 6.5}) {
    double before = 0.0;
    for (double log_a = -300.0; log_a < 3000.0; log_a += 0.05) {
      const double lost = single_creep(1e12, 1e9, log_a, m - 1.0);
      ASSERT_GE(lost, before * (1 - 1e-14));
      before = lost;
    }
  }
}

// Coupled: exact for one stress alone, exact when normal and shear stress decay alike.
TEST(NortonStep, coupled_step_is_exact_where_a_closed_form_exists) {
  for (const double m : {1.0, 2.0, 3.5})
    for (const double h : {1e-3, 1.0, 1e4}) {
      const double s = 3e6, log_a = std::log(h / 1e9) - (m - 1) * std::log(s);
      const double lost = single_creep(s * s, 1e9, log_a, m - 1);
      EXPECT_NEAR(coupled_creep(s, 0, 1e9, 1.2e9, log_a, m - 1).normal / lost, 1.0, 1e-14);
      // sqrt(3) tau = 3 MPa with A_s = 3^((m+1)/2) A is the same in shear
      const double shear = single_creep(s * s / 3.0, 0.4e9, log_a + log_mises_ratio(m), m - 1);
      EXPECT_NEAR(coupled_creep(0, s * s / 3.0, 1e9, 1.2e9, log_a, m - 1).shear / shear, 1.0, 1e-13);
      const CreepLoss alike = coupled_creep(0.6 * s, 0.64 * s * s / 3.0, 1e9, 1e9, log_a, m - 1);
      EXPECT_NEAR(alike.normal / lost, 1.0, 1e-13);
      EXPECT_NEAR(alike.shear / lost, 1.0, 1e-13);
      EXPECT_EQ(single_creep(0.0, 1e9, -700.0, m - 1) * 0.0, 0.0);
    }
}

// Largest relative error of the stresses left after a coupled step, against quadrature. E = s_eq = 1.
double coupled_error(double S, double m, double mix, double h) {
  const double right = exact_time(1 - mix, mix, 1.0, S, m, h);
  const CreepLoss lost = coupled_creep(std::sqrt(1 - mix), mix / 3.0, 1.0, S, std::log(h), m - 1);
  return std::max(std::fabs((1 - lost.normal) / std::exp(-right) - 1),
                  std::fabs((1 - lost.shear) / std::exp(-S * right) - 1));
}

// Coupled in general: against quadrature; the error of a step falls with the fourth power of what creeps.
TEST(NortonStep, coupled_step_is_of_fourth_order) {
  for (const double S : {0.4, 1.2, 1.5, 3.0})
    for (const double m : {2.0, 3.0, 5.0})
      for (const double mix : {0.1, 0.9}) {
        const double h = 0.02 / std::max(1.0, S), large = coupled_error(S, m, mix, h);
        if (large < 1e-11) continue;  // below it the quadrature shows
        EXPECT_NEAR(std::log2(large / coupled_error(S, m, mix, 0.5 * h)), 4.0, 0.25) << S << " " << m << " " << mix;
      }
}

// What norton_step.h and bond_norton.md promise at 0.1, 1, 10 and 1000 relaxations in one step, with shear
// stiffnesses of nu = 0.25 and nu = 0.
TEST(NortonStep, coupled_step_is_bounded_at_any_size) {
  const struct {
    double S, h, bound, bound_of_1_5;
  } cases[] = {{1.2, 0.1, 1e-8, 1e-8}, {1.2, 1.0, 1e-5, 1e-5}, {1.2, 10.0, 1.2e-3, 2.5e-3}, {1.2, 1000.0, 4e-2, 0.11},
               {1.5, 0.1, 2e-7, 2e-7}, {1.5, 1.0, 1.3e-4, 1.3e-4}, {1.5, 10.0, 2e-2, 4.2e-2}, {1.5, 1000.0, 0.3, 1.2}};
  for (const auto &c : cases)
    for (const double m : {1.0, 1.5, 2.0, 3.0, 3.5, 5.0})
      for (const double mix : {0.01, 0.1, 0.5, 0.9, 0.99}) {
        if (m == 1.0 && c.h > 10.0) continue;  // nothing is left to compare
        EXPECT_LT(coupled_error(c.S, m, mix, c.h), m == 1.5 ? c.bound_of_1_5 : c.bound)
            << c.S << " " << c.h << " " << m << " " << mix;
      }
}

// Where little creeps the first look is enough; the second comes in time.
TEST(NortonStep, small_coupled_steps_are_good_to_1e10) {
  for (const double S : {1.0, 1.2, 1.5})
    for (const double m : {1.5, 2.0, 3.5, 5.0})
      for (const double mix : {0.1, 0.3, 0.5, 0.7, 0.9})
        for (const double h : {1e-5, 0.99e-3, 1.01e-3, 3e-3, 1e-2})
          EXPECT_LT(coupled_error(S, m, mix, h / (1 + (S - 1) * mix)), 1.5e-10) << S << " " << m << " " << mix << " " << h;
}

// One step or many: the stresses go to the same place, closer with more steps.
TEST(NortonStep, coupled_steps_converge_to_a_fine_reference) {
  const double E = 1.0, S = 1.2, m = 3.5;
  const auto left = [&](double h, int steps) {
    double s = 0.8, t = 0.6 / std::sqrt(3.0);
    for (int k = 0; k < steps; ++k) {
      const CreepLoss lost = coupled_creep(s, t * t, E, S, std::log(h / steps), m - 1);
      s *= 1 - lost.normal, t *= 1 - lost.shear;
    }
    return std::make_pair(s, t);
  };
  for (const double h : {1.0, 10.0, 1000.0}) {
    const auto fine = left(h, 20000);
    double before = 1.0;
    for (const int steps : {1, 4, 16, 64}) {
      const auto now = left(h, steps);
      const double error = std::max(std::fabs(now.first / fine.first - 1), std::fabs(now.second / fine.second - 1));
      EXPECT_LT(error, std::max(0.3 * before, 1e-11)) << h << " " << steps;
      before = error;
    }
  }
}

// The reduced time stays between those of the slower and the faster decay for any step.
TEST(NortonStep, coupled_step_stays_between_the_two_decays) {
  for (const double S : {0.4, 1.2, 3.0})
    for (const double m : {0.5, 1.0, 2.0, 5.0})
      for (const double mix : {0.01, 0.5, 0.99})
        for (const double h : {1e-6, 1e-2, 0.3, 1.0, 30.0}) {
          const CreepLoss lost = coupled_creep(std::sqrt(1 - mix), mix / 3.0, 1.0, S, std::log(h), m - 1);
          const double slow = creep_time(std::log(h), m - 1, 0.0, std::min(1.0, S));
          const double fast = creep_time(std::log(h), m - 1, 0.0, std::max(1.0, S));
          EXPECT_LE(lost.normal, decay_lane(std::max(slow, fast)) * (1 + 1e-12));
          EXPECT_GE(lost.normal, decay_lane(std::min(slow, fast)) * (1 - 1e-12));
        }
}

TEST(NortonStep, shapes_of_creeping_sections) {
  for (int m = 1; m <= 5; ++m) {
    const std::string row = "round section, m=" + std::to_string(m);
    EXPECT_NEAR(round_bend_shape(m), reference()("norton_bending", row, "I_m/R^(3+1/m)"), 5e-9);
    EXPECT_NEAR(round_twist_shape(m), reference()("norton_torsion", row, "J_m/R^(3+1/m)"), 1e-8);
    EXPECT_NEAR(std::exp(log_mises_ratio(m)),
                reference()("norton_shear", "von Mises consistent, m=" + std::to_string(m), "A_s/A"), 1e-7);
  }
  EXPECT_NEAR(strip_bend_shape(1.0), 2.0 / 3.0, 1e-15);  // elastic: I/(R^3 t)
  EXPECT_NEAR(strip_bend_shape(1e9), 1.0, 1e-9);         // rigid-plastic: R^2 t
}

// Named after the slip: a coefficient given in MPa^-m taken for Pa^-m (seed 002, A of its Table 3).
TEST(NortonStep, unit_of_a_seed002) {
  const double modulus = 10.68e6;
  EXPECT_NEAR(1.0 / (modulus * 1.5e-10), 624.2, 0.1);                               // s, if in Pa
  EXPECT_NEAR(1.0 / (modulus * creep_rate_in_mpa(1.5e-10, 1.0)) / 6.242e8, 1.0, 1e-3);  // as printed
  EXPECT_NEAR(creep_rate_in_mpa(1.0, 3.0) / 1e-18, 1.0, 1e-14);
  // in the 250 s of the slow test a third of the stress relaxes, or nothing at all
  EXPECT_NEAR(relaxed(1e6, modulus, 1.5e-10, 1.0, 250.0) / 1e6, std::exp(-250 / 624.2), 1e-5);
  EXPECT_NEAR(relaxed(1e6, modulus, creep_rate_in_mpa(1.5e-10, 1.0), 1.0, 250.0) / 1e6, 1.0, 1e-6);
  EXPECT_NEAR(log_rate_at(1e-6, 5e6, 3.0), std::log(1e-6 / 1.25e20), 1e-12);
}
