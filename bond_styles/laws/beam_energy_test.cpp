// SPDX-License-Identifier: GPL-2.0-or-later
//
// Beams as springs: what goes in comes out, also at large strains; breaks, softening and dashpots
// take energy and never give any; blocks of lanes; random states (PHYSICS.md 2.5, items 5 and 12).
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

Bench pair_of(bool flat = false, double second = 1e-3, bool at_contact = false) {
  Bench b = beam_bench(flat, 5e-3);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({2e-3, 0, 0}, second, 2500);
  BeamParameters p = law();
  p.at_contact = at_contact;
  beam(b, 0, 1, p);
  return b;
}

// Grain 1 goes along a closed path of motion and turning; work of the end loads and largest energy.
struct Cycle {
  double work, peak;
};
Cycle closed_path(Bench b, Vec3 size, Vec3 turn_size, int steps) {
  const Vec3 x0 = b.grains[1].x;
  b.load(0.0, false);
  Cycle r{0, 0};
  const auto at = [&](double s, double phase) {
    return std::sin(2 * kPi * s + phase) - std::sin(phase);
  };
  Vec3 was{0, 0, 0};  // rotation vector of grain 1, all turns about one axis at a time in the plane
  for (int k = 1; k <= steps; ++k) {
    const double s = static_cast<double>(k) / steps;
    const Vec3 x = x0 + Vec3{size.x * at(s, 0), size.y * at(s, 1), size.z * at(s, 2)};
    const Vec3 now{turn_size.x * at(s, 0.5), turn_size.y * at(s, 0.5), turn_size.z * at(s, 0.5)};
    const Grain before = b.grains[1];
    const Vec3 step = now - was;  // one axis: rotations add up
    b.prescribe(
        1e-7,
        [&](int g) {
          return g ? x : Vec3{0, 0, 0};
        },
        [&](int g) {
          return g ? step : Vec3{0, 0, 0};
        });
    const Grain &after = b.grains[1];
    r.work -=
        0.5 * dot(before.f + after.f, after.x - before.x) + 0.5 * dot(before.t + after.t, step);
    r.peak = std::max(r.peak, b.potential_energy());
    was = now;
  }
  return r;
}

}  // namespace

// One kind of strain at a time: the energies of the springs.
TEST(BeamEnergy, stored_energy_is_that_of_four_springs) {
  const double u = 1e-7, phi = 1e-4, E = 1e9, A = kPi * 1e-6, l = 2e-3;
  const struct {
    Vec3 move, turn_i, turn_j;
    double energy;
  } cases[] = {{{u, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0.5 * u * u * E * A / l},
               {{-u, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0.5 * u * u * E * A / l},
               {{0, u, 0}, {0, 0, 0}, {0, 0, 0}, 0.5 * u * u * E / 2.6 * A / l},
               {{0, 0, 0}, {0, 0, 0}, {phi, 0, 0}, 0.5 * phi * phi * E / 2.6 * A * 0.5e-6 / l},
               {{0, 0, 0}, {0, 0, -phi}, {0, 0, phi}, 2 * phi * phi * E * A * 0.25e-6 / l},
               {{0, 0, 0}, {0, phi, 0}, {0, phi, 0}, 0.5 * phi * phi * E / 2.6 * A * l}};
  for (const auto &c : cases) {
    Bench b = pair_of();
    b.grains[1].x = b.grains[1].x + c.move;
    b.grains[0].q = turned_by(b.grains[0].q, c.turn_i);
    b.grains[1].q = turned_by(b.grains[1].q, c.turn_j);
    EXPECT_NEAR(b.potential_energy() / c.energy, 1.0, 3e-9);
  }
}

// Closed paths of large strain (shear 0.3 rad, turning 0.5 rad, stretch 10 %): the mid-point work
// is of second order in the step, and so is what is left of it; by Richardson nothing remains.
TEST(BeamEnergy, closed_cycle_leaves_nothing_at_large_strain) {
  for (const bool flat : {false, true})
    for (const Vec3 turn :
         {Vec3{0.5, 0, 0}, Vec3{0, 0.4, 0}, Vec3{0, 0, 0.5}, Vec3{0.2, -0.3, 0.3}}) {
      if (flat && turn.z != 0.5) continue;
      const Vec3 size{2e-4, 6e-4, flat ? 0.0 : 4e-4};
      for (const bool at_contact : {false, true}) {
        const Cycle coarse = closed_path(pair_of(flat, 0.5e-3, at_contact), size, turn, 400);
        const Cycle fine = closed_path(pair_of(flat, 0.5e-3, at_contact), size, turn, 800);
        EXPECT_GT(fine.peak, 1e-3);
        EXPECT_LT(std::fabs(fine.work), 1e-4 * fine.peak);
        EXPECT_LT(std::fabs(4.0 * fine.work - coarse.work), 3e-8 * fine.peak);
      }
    }
}

// Free vibration of a chain of three beams, tumbling as well, for a million steps at a tenth of the
// limit of the step.
TEST(BeamEnergy, free_chain_keeps_its_energy_for_a_million_steps) {
  Bench b = beam_bench();
  for (int k = 0; k < 4; ++k) b.add({2e-3 * k, 0, 0}, 1e-3, 2500);
  for (int k = 0; k < 3; ++k) beam(b, k, k + 1, law());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-1, 1);
  for (Grain &g : b.grains) {
    g.v = 0.3 * Vec3{u(random), u(random), u(random)};
    g.w = 100.0 * Vec3{u(random), u(random), u(random)};
  }
  b.load(0.0, false);
  const double dt = 0.1 * 2.6e-6;
  const auto mean = [&](int steps) {
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
      b.step(dt);
      sum += b.kinetic_energy() + b.potential_energy();
    }
    return sum / steps;
  };
  const auto run = [&](int steps) {
    for (int k = 0; k < steps; ++k) b.step(dt);
  };
  const double first = mean(20000);
  run(480000);
  const double middle = mean(20000);
  run(460000);
  const double last = mean(20000);
  EXPECT_NEAR(middle / first, 1.0, 1e-5);
  EXPECT_NEAR(last / first, 1.0, 1e-5);
}

// Kinetic and stored energy never rise at a break; with softening and dashpots what is missing is
// in `lost`.
TEST(BeamEnergy, breaking_bonds_never_make_energy) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> u(-1, 1);
  int broken = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const bool flat = trial % 2;
    Bench b = beam_bench(flat, 2e-3);
    for (int k = 0; k < 6; ++k)
      b.add({1.9e-3 * k, 2e-4 * u(random), flat ? 0.0 : 2e-4 * u(random)},
            1e-3 * (1 + 0.2 * u(random)), 2500);
    for (int k = 0; k < 5; ++k) {
      BeamParameters p = law();
      p.cohesion = 3e6 * (1.5 + u(random));
      p.cutoff = 3e6 * (1.5 + u(random));
      p.tan_phi = trial % 3 ? 0.0 : 0.7;
      p.friction = 0.6;
      beam(b, k, k + 1, p, trial % 4 < 2 ? ContactSpec{} : ContactSpec{2e9, 2.0, 0.5});
    }
    for (Grain &g : b.grains) {
      g.v = 4.0 * Vec3{u(random), u(random), flat ? 0.0 : u(random)};
      g.w = 2000.0 * Vec3{flat ? 0.0 : u(random), flat ? 0.0 : u(random), u(random)};
    }
    b.load(0.0, false);
    const double dt = 2e-8, start = b.kinetic_energy() + b.potential_energy();
    for (int k = 0; k < 3000; ++k) {
      const double before = b.kinetic_energy() + b.potential_energy();
      b.step(dt);
      const double after = b.kinetic_energy() + b.potential_energy();
      bool breaks = false;
      for (const PairRow &p : b.pairs) breaks = breaks || p.fate != BondFate::intact;
      ASSERT_TRUE(std::isfinite(after));
      if (breaks) {
        EXPECT_LT(after, before) << "trial " << trial << " step " << k;
      }
      ASSERT_LT(after, 1.01 * start);
    }
    for (const PairRow &p : b.pairs) broken += p.alive == 0.0;
  }
  EXPECT_GT(broken, 80);
}

// A lane's bits don't depend on its place in the block or on its neighbours: contacts and dashpots
// of others don't touch it.
TEST(BeamBlock, lanes_do_not_depend_on_their_place) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const bool flat : {false, true})
    for (const bool options : {false, true}) {
      Bench many = beam_bench(flat, 2e-3, options);
      const int pairs = 150;
      for (int k = 0; k < pairs; ++k) {
        many.add({5e-3 * k, 0, 0}, 1e-3 * (1 + 0.3 * u(random)), 2500);
        many.add({5e-3 * k + 2e-3, 1e-4 * u(random), flat ? 0 : 1e-4 * u(random)}, 1e-3, 2500);
      }
      for (int k = 0; k < pairs; ++k) {
        BeamParameters p = law();
        p.cohesion = 1e6, p.tan_phi = 0.5, p.friction = 0.4;
        PairRow &row =
            beam(many, 2 * k, 2 * k + 1, p, k % 70 ? ContactSpec{} : ContactSpec{1e9, 2.0, 0.4});
        if (options && k % 50 == 0) row.own[kViscous] = 0.5, row.own[kFailure] = 2.0;
      }
      for (Grain &g : many.grains) {
        g.v = 2.0 * Vec3{u(random), u(random), flat ? 0 : u(random)};
        g.w = 500.0 * Vec3{flat ? 0 : u(random), flat ? 0 : u(random), u(random)};
      }
      std::vector<Bench> single;
      for (int k = 0; k < pairs; ++k) {
        Bench one = beam_bench(flat, 2e-3, options);
        one.grains = {many.grains[2 * k], many.grains[2 * k + 1]};
        one.pairs = {many.pairs[k]};
        one.pairs[0].i = 0, one.pairs[0].j = 1;
        single.push_back(one);
      }
      many.load(0.0, false);
      for (int s = 0; s < 60; ++s) many.step(5e-8);
      int broken = 0;
      for (int k = 0; k < pairs; ++k) {
        single[k].load(0.0, false);
        for (int s = 0; s < 60; ++s) single[k].step(5e-8);
        for (int g = 0; g < 2; ++g) {
          EXPECT_EQ(length(single[k].grains[g].x - many.grains[2 * k + g].x), 0.0);
          EXPECT_EQ(length(single[k].grains[g].t - many.grains[2 * k + g].t), 0.0);
        }
        broken += many.pairs[k].alive == 0.0;
      }
      EXPECT_GT(broken, 10);
      EXPECT_LT(broken, pairs);
    }
}

// Random states, small and beyond all bounds: always numbers, newton's third law, no energy from a
// break.
TEST(BeamFuzz, no_state_gives_nan_and_no_break_makes_energy) {
  std::mt19937 random(101);
  std::uniform_real_distribution<double> u(-1, 1);
  int breaks = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const bool flat = trial % 2, options = trial % 5 < 2;
    const double scale = std::pow(10.0, 3 * u(random));
    Bench b = beam_bench(flat, 1e-3 * scale, options);
    const Vec3 direction{u(random), u(random), flat ? 0.0 : u(random)};
    b.add({0, 0, 0}, 1e-3 * scale, 2500);
    b.add((1.5e-3 * scale * (1 + 0.5 * u(random))) * unit(direction), 0.5e-3 * scale, 2500);
    BeamParameters p;
    p.modulus = std::pow(10.0, 9 + 2 * u(random));
    p.poisson = 0.49 * std::fabs(u(random));
    p.lambda = 1.0 + 0.5 * u(random);
    p.bend_factor = trial % 5 ? 1.0 : 0.5;
    p.beta1 = trial % 7 ? 1.0 : 0.0, p.beta2 = trial % 11 ? 1.0 : 0.0;
    p.tan_phi = trial % 3 ? 0.0 : 1.0;
    p.shear = static_cast<BeamShear>(trial % 3);
    p.cohesion = std::pow(10.0, 7 + 2 * u(random));
    p.cutoff = trial % 4 ? std::pow(10.0, 7 + 2 * u(random)) : 1e300;
    p.friction = trial % 6 ? 0.5 : 0.0;
    p.touching = trial % 13 == 0;
    p.at_contact = trial % 17 < 8;
    for (Grain &g : b.grains)
      g.q = turned_by(g.q, {flat ? 0 : u(random), flat ? 0 : u(random), u(random)});
    beam(b, 0, 1, p, {trial % 3 ? 0.0 : 1e9, 2.0, 0.5});
    b.pairs[0].own[kTension] = trial % 2 ? 1.0 : 0.6;
    b.pairs[0].own[kFailure] = trial % 3 ? 1.0 : 3.0;
    b.pairs[0].own[kViscous] = trial % 4 ? 0.0 : 0.5;
    b.load(0.0, false);
    for (int k = 0; k < 20; ++k) {
      const double speed = std::pow(10.0, 1 + 2 * u(random)), dt = 1e-7 * scale;
      for (Grain &g : b.grains) {
        g.v = speed * Vec3{u(random), u(random), flat ? 0.0 : u(random)};
        g.w =
            (speed / scale * 1e3) * Vec3{flat ? 0.0 : u(random), flat ? 0.0 : u(random), u(random)};
      }
      b.drift(dt);
      const bool was_alive = b.pairs[0].alive != 0.0;
      const Bench before = b;
      b.load(dt);
      const PairRow &r = b.pairs[0];
      ASSERT_TRUE(
          std::isfinite(length(b.grains[0].f) + length(b.grains[0].t) + length(b.grains[1].t)));
      ASSERT_TRUE(std::isfinite(r.own[kLost] + r.own[kWorst] + r.sigma + r.tau));
      ASSERT_EQ(length(b.grains[0].f + b.grains[1].f), 0.0);
      ASSERT_GE(r.own[kLost], before.pairs[0].own[kLost]);
      ASSERT_EQ(r.fate != BondFate::intact, was_alive && r.alive == 0.0);
      if (was_alive && r.alive == 0.0) {
        ++breaks;
        Bench strong = before;
        strong.pairs[0].own[kCohesion] = strong.pairs[0].own[kCutoff] = 1e300;
        strong.load(dt);
        ASSERT_LE(b.potential_energy(), strong.potential_energy() * (1 + 1e-12));
      }
    }
  }
  EXPECT_GT(breaks, 500);
}

// All stresses and moduli times c: forces times c. All lengths times c: forces times c^2, couples
// times c^3, stresses the same.
TEST(BeamScaling, moduli_and_lengths) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 d = unit({u(random), u(random), u(random)}),
               a = 1e-3 * Vec3{u(random), u(random), u(random)},
               c = 1e-3 * Vec3{u(random), u(random), u(random)};
    const auto loaded = [&](double size, double stiff) {
      Bench b = beam_bench();
      b.add({0, 0, 0}, 1e-3 * size, 2500);
      b.add(1.8e-3 * size * d, 0.8e-3 * size, 2500);
      BeamParameters p = law();
      p.modulus *= stiff, p.cohesion = 5e6 * stiff, p.tan_phi = 0.5;
      p.shear = BeamShear::timoshenko;
      beam(b, 0, 1, p);
      b.grains[1].x = b.grains[1].x + 1e-6 * size * c;
      b.grains[0].q = turned_by(b.grains[0].q, a);
      b.load(1.0);
      return b;
    };
    const Bench one = loaded(1, 1), stiff = loaded(1, 7), large = loaded(7, 1);
    EXPECT_EQ(one.pairs[0].fate, stiff.pairs[0].fate);
    EXPECT_EQ(one.pairs[0].fate, large.pairs[0].fate);
    for (int g = 0; g < 2; ++g) {
      const Grain &x = one.grains[g], &y = stiff.grains[g], &z = large.grains[g];
      EXPECT_LT(length(y.f - 7.0 * x.f), 1e-9 * length(y.f));
      EXPECT_LT(length(y.t - 7.0 * x.t), 1e-9 * length(y.t));
      EXPECT_LT(length(z.f - 49.0 * x.f), 1e-9 * length(z.f));
      EXPECT_LT(length(z.t - 343.0 * x.t), 1e-9 * length(z.t));
    }
    EXPECT_NEAR(large.pairs[0].sigma / one.pairs[0].sigma, 1.0, 1e-9);
  }
}

// Rotating everything rotates the loads.
TEST(BeamScaling, rotated_specimen) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Bench b = pair_of();
    const Vec3 turn = 3.0 * Vec3{u(random), u(random), u(random)};
    b.grains[1].x = b.grains[1].x + 1e-5 * Vec3{u(random), u(random), u(random)};
    b.grains[0].q = turned_by(b.grains[0].q, 0.01 * Vec3{u(random), u(random), u(random)});
    Bench c = b;
    for (Grain &g : c.grains) g.x = rotated(g.x, turn), g.q = turned_by(g.q, turn);
    b.load(0.0, false);
    c.load(0.0, false);
    for (int g = 0; g < 2; ++g) {
      EXPECT_LT(length(c.grains[g].f - rotated(b.grains[g].f, turn)),
                1e-11 * length(b.grains[g].f));
      EXPECT_LT(length(c.grains[g].t - rotated(b.grains[g].t, turn)),
                1e-11 * length(b.grains[g].t));
    }
  }
}
