// SPDX-License-Identifier: GPL-2.0-or-later
//
// Damping in the bond (bond_options.h) against the damped oscillator, for every law of law_cases.h in
// space and in the plane: decrement of each way of vibrating, the limit of the time step, energy;
// and what it must not change.
//
// The dashpot's force is that of the half step before, so a mode x obeys exactly
//     x(k+1) = (2 - w^2 dt^2 - g) x(k) - (1 - g) x(k-1),   g = 2 zeta w dt,
// whose amplitude falls by sqrt(1 - g) a step: the damped oscillator's exp(-zeta w dt) to first order.
#include <gtest/gtest.h>

#include <random>

#include "chain_runs.h"
#include "law_cases.h"
#include "reference_table.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

constexpr double kThickness = 4e-3;  // m, in the plane

class Damping : public testing::TestWithParam<LawAndSpace> {
 protected:
  const LawCase &law() const { return GetParam()(); }
  bool flat() const { return GetParam().flat; }

  Bench chain(int grains, double zeta, const BondCase &c = {}) const {
    Bench b(flat(), kThickness);
    for (int k = 0; k < grains; ++k) b.add({2e-3 * k, 0, 0}, 1e-3, 2500);
    b.options = true;
    for (int k = 0; k + 1 < grains; ++k) {
      PairRow &row = law().bond(b, k, k + 1, c);
      row.viscous = viscous_time(zeta, law().stiffness(b, row).normal, b.grains[k].mass, b.grains[k + 1].mass);
    }
    return b;
  }
};

enum class Mode { axial, shear, bend, twist };

// Puts the dimer into one way of vibrating and gives its undamped frequency. Other ways are locked by
// a mass or inertia so large that nothing follows.
double excite(Bench &b, Mode mode, const BondStiffness &k, double speed) {
  Grain &i = b.grains[0], &j = b.grains[1];
  const double heavy = 1e12;
  switch (mode) {
    case Mode::axial:
      i.v.x = -speed, j.v.x = speed;
      return std::sqrt(k.normal * 2.0 / i.mass);
    case Mode::shear:
      i.inertia *= heavy, j.inertia *= heavy;
      i.v.y = -speed, j.v.y = speed;
      return std::sqrt(k.shear * 2.0 / i.mass);
    case Mode::bend:
      i.mass *= heavy, j.mass *= heavy;
      i.w.z = -speed / i.radius, j.w.z = speed / i.radius;
      return std::sqrt(k.bend * 2.0 / i.inertia);
    case Mode::twist:
      i.mass *= heavy, j.mass *= heavy;
      i.w.x = -speed / i.radius, j.w.x = speed / i.radius;
      return std::sqrt(k.twist * 2.0 / i.inertia);
  }
  return 0.0;
}

double displacement(const Bench &b, Mode mode) {
  const Grain &i = b.grains[0], &j = b.grains[1];
  switch (mode) {
    case Mode::axial: return j.x.x - i.x.x - 2e-3;
    case Mode::shear: return j.x.y - i.x.y;
    case Mode::bend: return j.turned.z - i.turned.z;
    case Mode::twist: return j.turned.x - i.turned.x;
  }
  return 0.0;
}

// Least squares of x(k+1) = a x(k) + c x(k-1).
struct Recurrence {
  double a, c;
  double a_step() const { return std::sqrt(-c); }                      // fall of the amplitude
  double turn() const { return std::acos(0.5 * a / a_step()); }        // of the phase
  double decrement() const { return -2.0 * kPi / turn() * std::log(a_step()); }
};
Recurrence fitted(const std::vector<double> &x) {
  double pp = 0, pq = 0, qq = 0, rp = 0, rq = 0;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    const double p = x[k], q = x[k - 1], r = x[k + 1];
    pp += p * p, pq += p * q, qq += q * q, rp += r * p, rq += r * q;
  }
  const double det = pp * qq - pq * pq;
  return {(rp * qq - rq * pq) / det, (rq * pp - rp * pq) / det};
}

}  // namespace

TEST_P(Damping, decrement_of_every_way_of_vibrating) {
  for (const Mode mode : {Mode::axial, Mode::shear, Mode::bend, Mode::twist}) {
    if (flat() && mode == Mode::twist) continue;
    for (const double zeta : {0.02, 0.3}) {
      double error[2];
      for (int fine = 0; fine < 2; ++fine) {
        Bench b = chain(2, zeta);
        const BondStiffness k = law().stiffness(b, b.pairs[0]);
        const double omega = excite(b, mode, k, 1e-5);
        const double own = 0.5 * omega * b.pairs[0].viscous;  // zeta of this way
        const double dt = (fine ? 0.01 : 0.02) / omega;
        if (mode == Mode::axial) {
          EXPECT_NEAR(own / zeta, 1.0, 1e-12);
        }
        std::vector<double> x;
        b.load(0.0, false);
        for (int n = 0; n < 2000; ++n) {
          x.push_back(displacement(b, mode));
          b.step(dt);
        }
        const Recurrence r = fitted(x);
        const double g = 2.0 * own * omega * dt;
        EXPECT_NEAR((1.0 + r.c) / g, 1.0, 1e-4) << int(mode) << ' ' << zeta;
        EXPECT_NEAR((2.0 - g - r.a) / (omega * omega * dt * dt), 1.0, 1e-2) << int(mode) << ' ' << zeta;
        error[fine] = r.decrement() / (2.0 * kPi * own / std::sqrt(1.0 - own * own)) - 1.0;
      }
      EXPECT_LT(std::fabs(error[1]), 0.01) << int(mode) << ' ' << zeta;
      if (zeta > 0.1) {  // below, the (w dt)^2 of Verlet is of the same size
        EXPECT_NEAR(std::log2(error[0] / error[1]), 1.0, 0.1) << int(mode) << ' ' << zeta;
      }
    }
  }
}

TEST_P(Damping, limit_of_the_time_step) {
  for (const double zeta : {0.1, 0.5, 1.5}) {
    Bench b = chain(2, zeta, {1e9, 1e6, 1e300, 1e300, {}});  // shear soft: the axial mode is the highest
    for (Grain &g : b.grains) g.inertia *= 100.0;           // and bending slow
    const double omega = std::sqrt(law().stiffness(b, b.pairs[0]).normal * 2.0 / b.grains[0].mass);
    const double limit = 2.0 / omega * (std::sqrt(1.0 + zeta * zeta) - zeta);
    EXPECT_FALSE(grows(b, 0.999 * limit, 20000)) << zeta;
    EXPECT_TRUE(grows(b, 1.001 * limit, 20000)) << zeta;
  }
}

// Kinetic + elastic + lost energy of a free tumbling chain stays: to first order of the step, as the
// dashpot's force is.
TEST_P(Damping, energy_is_kept_and_accounted_for) {
  const auto run = [&](double dt, int steps, double &lost_share) {
    Bench b = chain(4, 0.05, {1e9, 2.6, 1e300, 1e300, {flat() ? 0.0 : 1e9, 2.0, 0.0}});
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    for (Grain &g : b.grains) {
      g.v = 0.02 * Vec3{u(random), u(random), flat() ? 0.0 : u(random)};
      g.w = 20.0 * Vec3{flat() ? 0.0 : u(random), flat() ? 0.0 : u(random), u(random)};
    }
    b.load(0.0, false);
    const double start = b.kinetic_energy();
    double worst = 0.0;
    for (int k = 0; k < steps; ++k) {
      b.step(dt);
      worst = std::max(worst, std::fabs((b.kinetic_energy() + b.potential_energy() + b.lost_energy()) / start - 1.0));
    }
    lost_share = b.lost_energy() / start;
    return worst;
  };
  double lost[3];
  const double coarse = run(1e-7, 2000, lost[0]), fine = run(5e-8, 4000, lost[1]), finest = run(2.5e-8, 8000, lost[2]);
  EXPECT_GT(lost[2], 0.3);
  EXPECT_LT(finest, 0.01);
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.2);
  EXPECT_NEAR(std::log2(fine / finest), 1.0, 0.2);
  EXPECT_NEAR(lost[1], lost[2], 0.02);
}

// At rest nothing is left of it: the chain hangs as the undamped one does.
TEST_P(Damping, does_not_change_static_answers) {
  const auto tip = [&](double zeta) {
    Bench b = chain(3, zeta);
    b.grains[0].held = true;
    b.grains[2].pull = {1e-3, 1e-4, 0};  // small: shear depends on its path in second order
    b.load(0.0, false);
    b.viscous = 6e4;
    for (int k = 0; k < 12000; ++k) b.step(2e-7);
    EXPECT_LT(length(b.grains[2].v), 1e-10);
    return b.grains[2].x - Vec3{4e-3, 0, 0};
  };
  const Vec3 without = tip(0.0), with = tip(0.4);
  EXPECT_GT(without.y, 1e-10);
  EXPECT_LT(length(without - with), 1e-8 * length(without));
}

// The dashpot's force is no stress of the criterion: the break comes at the same step, however fast.
TEST_P(Damping, does_not_break_bonds) {
  for (const double speed : {1e-3, 1.0, 30.0}) {
    Bench damped = chain(2, 0.5, {1e9, 2.6, 5e6, 4e6, {}}), plain = chain(2, 0.0, {1e9, 2.6, 5e6, 4e6, {}});
    const double dt = 1e-8, u = speed * dt;
    double most = 0.0;
    for (int k = 1; k <= 20000; ++k) {
      if (k * u > 3e-5) break;
      for (Bench *b : {&damped, &plain})
        b->prescribe(dt, [&](int g) { return g ? Vec3{2e-3 + k * u, 0.5 * k * u, 0} : Vec3{0, 0, 0}; },
                     [&](int g) { return (g * u * 10.0) * (flat() ? Vec3{0, 0, 1} : Vec3{1, 1, 1}); });
      ASSERT_EQ(damped.pairs[0].sigma, plain.pairs[0].sigma);
      ASSERT_EQ(damped.pairs[0].tau, plain.pairs[0].tau);
      ASSERT_EQ(damped.pairs[0].alive, plain.pairs[0].alive) << k;
      most = std::max(most, length(damped.grains[0].f - plain.grains[0].f));
    }
    EXPECT_GT(most, 0.0);  // the force is there
    if (speed > 1.5) {
      EXPECT_EQ(plain.pairs[0].alive, 0.0);
      // and gone with the bond, its moments too
      EXPECT_EQ(length(damped.grains[0].f) + length(damped.grains[0].t) + length(damped.grains[1].t), 0.0);
    }
  }
}

// A rigid motion is no strain: a dashpot in it does nothing.
TEST_P(Damping, rigid_motion_is_free) {
  Bench b = chain(2, 1.0);
  const int steps = 4000;
  const Vec3 turn = (2.0 * kPi / steps) * (flat() ? Vec3{0, 0, 1} : unit({1, 2, -1}));
  b.load(0.0, false);
  for (int k = 1; k <= steps; ++k) {
    const Vec3 drift{1e-6 * k, -2e-6 * k, 0};
    b.prescribe(1e-7, [&](int g) { return drift + rotated(Vec3{2e-3 * g, 0, 0}, static_cast<double>(k) * turn); },
                [&](int) { return turn; });
    ASSERT_LT(length(b.grains[0].f), 1e-4) << k;  // N; the damper of this motion would be 1e3 N
  }
  EXPECT_LT(b.lost_energy(), 1e-14);
}

// Action, reaction and both momenta, with the dashpots at work.
TEST_P(Damping, keeps_both_momenta) {
  Bench b = chain(2, 0.3);
  b.grains[0].v = {1, -2, flat() ? 0.0 : 0.5};
  b.grains[1].v = {-1, 1, flat() ? 0.0 : 1.5};
  b.grains[0].w = {flat() ? 0.0 : 500.0, 0, -900};
  b.grains[1].w = {0, flat() ? 0.0 : 300.0, 200};
  b.load(0.0, false);
  const Vec3 before = b.momentum(), spin = b.angular_momentum();
  for (int k = 0; k < 2000; ++k) b.step(1e-7);
  const double size = b.grains[0].mass * 4.0;
  EXPECT_LT(length(b.momentum() - before), 1e-12 * size);
  EXPECT_LT(length(b.angular_momentum() - spin), 1e-12 * size * 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Laws, Damping, testing::ValuesIn(laws_in_space_and_plane()),
                         [](const auto &info) { return name_of(info.param); });
