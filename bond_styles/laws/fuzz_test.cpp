// SPDX-License-Identifier: GPL-2.0-or-later
//
// Random states through every law of law_cases.h, in space and in the plane, with and without options,
// contact and breaks: always numbers, nothing from nothing, reaction equals action, a break gives no
// energy, and a broken bond is its contact.
//
// States go to the edge of what a step may be: the pair turns by up to half a radian and its grains by
// up to one, distances from a twentieth of the radii to four times them, sizes over six decades.
#include <gtest/gtest.h>

#include <random>

#include "law_cases.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double sign() { return uniform_(engine_); }                                  // -1 .. 1
  double decades(double low, double high) { return std::pow(10.0, low + 0.5 * (high - low) * (1.0 + sign())); }
  bool one_in(int n) { return static_cast<int>(engine_() % n) == 0; }
  Vec3 within(bool flat) {
    const double x = sign(), y = sign(), z = sign();
    return {x, y, flat ? 0.0 : z};
  }
  Vec3 about(bool flat) {
    const double x = sign(), y = sign(), z = sign();
    return flat ? Vec3{0, 0, z} : Vec3{x, y, z};
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

class Fuzzed : public testing::TestWithParam<LawAndSpace> {
 protected:
  const LawCase &law() const { return GetParam()(); }
  bool flat() const { return GetParam().flat; }

  // Two grains anywhere, of any size and material, bonded in any of the law's ways.
  Bench any_pair(Dice &dice) const {
    const double scale = dice.decades(-6, 0);  // m
    Bench b(flat(), scale * dice.decades(-1, 1));
    const double r1 = scale, r2 = scale * dice.decades(-0.5, 0.5);
    const double distance = (r1 + r2) * (dice.one_in(4) ? dice.decades(-1.3, 0.6) : 1.0 + 0.1 * dice.sign());
    const Vec3 direction = dice.one_in(5) ? Vec3{1, 0, 0} : unit(dice.within(flat()) + Vec3{1e-3, 0, 0});
    b.add({0, 0, 0}, r1, dice.decades(2, 4));
    b.add(distance * direction, r2, dice.decades(2, 4));
    BondCase c;
    c.modulus = dice.decades(6, 12);
    c.ratio = dice.decades(-1, 2);
    if (!dice.one_in(4)) c.sigma_c = c.modulus * dice.decades(-5, 0), c.tau_c = c.modulus * dice.decades(-5, 0);
    c.contact = {dice.one_in(3) ? 0.0 : dice.decades(6, 12), dice.decades(-1, 2), dice.one_in(3) ? 0.0 : dice.decades(-2, 1)};
    b.options = dice.one_in(2);
    b.contacts = !dice.one_in(4);
    PairRow &row = law().bond(b, 0, 1, c);
    if (b.options) {
      if (dice.one_in(2)) row.tension = dice.decades(-2, 1);
      if (dice.one_in(2)) row.failure = dice.one_in(2) ? 1.0 + dice.decades(-12, 0) : dice.decades(0, 4);
      if (dice.one_in(2)) row.viscous = dice.decades(-3, 1);  // steps; prescribed with dt = 1
    }
    return b;
  }

  // One more step: a little, a lot, or nothing at all.
  void move(Bench &b, Dice &dice) const {
    const double d = b.distance(0, 1);
    const double size = dice.one_in(6) ? 0.0 : dice.decades(-9, -0.7), spin = dice.one_in(6) ? 0.0 : dice.decades(-9, -0.3);
    const Vec3 from[2] = {b.grains[0].x, b.grains[1].x};
    Vec3 to[2] = {from[0] + (0.5 * size * d) * dice.within(flat()), from[1] + (0.5 * size * d) * dice.within(flat())};
    if (dice.one_in(20)) to[1] = from[1], to[0] = from[0];
    const Vec3 turns[2] = {spin * dice.about(flat()), spin * dice.about(flat())};
    b.prescribe(1.0, [&](int g) { return to[g]; }, [&](int g) { return turns[g]; });
  }
};

// What rounding of a pair's distance and angles alone makes of a torque, N m: total laws take strains
// of any size from positions and orientations that are good to 1e-16 of themselves.
double torque_rounding(const Bench &b, const BondStiffness &s) {
  const PairRow &r = b.pairs[0];
  const double d = b.distance(0, 1), k = s.normal * std::max(1.0, r.tension) + s.shear + r.kn + r.ks;
  return 2e-15 * (k * d * d + s.bend + s.twist);
}

double load_size(const Bench &b) { return length(b.grains[0].f) + 1e-300; }

}  // namespace

TEST_P(Fuzzed, loads_are_numbers_and_keep_both_momenta) {
  Dice dice(101);
  int broken = 0, softened = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Bench b = any_pair(dice);
    b.load(0.0, false);
    double lost = 0.0, worst = 0.0;
    for (int k = 0; k < 12; ++k) {
      const bool was_alive = b.pairs[0].alive != 0.0;
      move(b, dice);
      const PairRow &r = b.pairs[0];
      const Vec3 f = b.grains[0].f, ti = b.grains[0].t, tj = b.grains[1].t, d = b.grains[1].x - b.grains[0].x;
      ASSERT_TRUE(std::isfinite(length(f) + length(ti) + length(tj))) << trial << ' ' << k;
      ASSERT_TRUE(std::isfinite(r.sigma + r.tau + r.lost + r.worst + b.potential_energy())) << trial << ' ' << k;
      ASSERT_EQ(length(f + b.grains[1].f), 0.0);
      // angular momentum: t_i + t_j = (x_j - x_i) x f, f the force on i
      const double size = length(ti) + length(tj) + length(d) * length(f);
      ASSERT_LE(length(ti + tj - cross(d, f)), 1e-13 * size + torque_rounding(b, law().stiffness(b, r))) << trial << ' ' << k;
      ASSERT_GE(r.lost, lost) << trial << ' ' << k;
      ASSERT_GE(r.worst, worst);
      lost = r.lost, worst = r.worst;
      ASSERT_EQ(r.fate != BondFate::intact, was_alive && r.alive == 0.0);  // a break is told once
      ASSERT_TRUE(r.alive == 0.0 || r.alive == 1.0);
      ASSERT_GE(b.potential_energy(), 0.0);
      broken += r.fate != BondFate::intact;
      softened += r.alive != 0.0 && b.carried(r) < 1.0;
    }
  }
  EXPECT_GT(broken, 300);  // the dice do reach what they should
  EXPECT_GT(softened, 100);
}

TEST_P(Fuzzed, break_creates_no_energy) {
  Dice dice(202);
  int broken = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Bench b = any_pair(dice);
    b.load(0.0, false);
    for (int k = 0; k < 12 && b.pairs[0].alive != 0.0; ++k) {
      Bench strong = b;
      law().unbreakable(strong.pairs[0]);
      Dice same = dice;
      move(b, dice);
      move(strong, same);
      // whatever it lost by its strength, damage included, the unbreakable one has at least as much
      ASSERT_LE(b.potential_energy(), strong.potential_energy() * (1.0 + 1e-12)) << trial << ' ' << k;
      broken += b.pairs[0].alive == 0.0;
    }
  }
  EXPECT_GT(broken, 300);
}

TEST_P(Fuzzed, broken_bond_is_its_contact) {
  Dice dice(303);
  int compared = 0, loaded = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Bench b = any_pair(dice);
    b.load(0.0, false);
    for (int k = 0; k < 12; ++k) {
      Bench contact = b;
      PairRow &row = contact.pairs[0];
      row.bonded = false;
      if (!b.contacts) row.kn = row.ks = 0.0;
      const bool replaced = row.kn == 0.0 && law().replaced_by;
      if (replaced) {
        const ContactParametersOfPair c = law().replaced_by(b, b.pairs[0]);
        row.kn = c.kn, row.ks = c.ks, row.mu = c.mu;
      }
      Dice same = dice;
      move(b, dice);
      move(contact, same);
      if (b.pairs[0].alive != 0.0) continue;
      if (replaced && b.pairs[0].fate != BondFate::intact) continue;  // its history begins after the break
      // in the step of the break and ever after
      ASSERT_LE(length(b.grains[0].f - contact.grains[0].f), 1e-14 * load_size(contact)) << trial << ' ' << k;
      for (int g = 0; g < 2; ++g)
        ASSERT_LE(length(b.grains[g].t - contact.grains[g].t), 1e-14 * (length(contact.grains[g].t) + b.distance(0, 1) * load_size(contact)));
      compared++;
      loaded += length(contact.grains[0].f) > 0.0;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(loaded, 100);
}

// A pair that doesn't move after bonding carries nothing, and one that stops keeps what it has.
TEST_P(Fuzzed, no_motion_no_change) {
  Dice dice(404);
  const auto stay = [](Bench &b) {
    const Vec3 at[2] = {b.grains[0].x, b.grains[1].x};
    b.prescribe(1.0, [&](int g) { return at[g]; }, [](int) { return Vec3{0, 0, 0}; });
  };
  for (int trial = 0; trial < 3000; ++trial) {
    Bench b = any_pair(dice);
    b.load(0.0, false);
    stay(b);
    const BondStiffness s = law().stiffness(b, b.pairs[0]);
    const auto rounding = [&] { return torque_rounding(b, s); };
    ASSERT_LE(length(b.grains[0].f) * b.distance(0, 1), rounding()) << trial;
    ASSERT_LE(length(b.grains[0].t) + length(b.grains[1].t), rounding()) << trial;
    for (int n = 0; n < 4; ++n) move(b, dice);
    stay(b);  // whatever breaks or is damped has done so
    const Vec3 f = b.grains[0].f, ti = b.grains[0].t, tj = b.grains[1].t;
    const double size = length(f), turn = length(ti) + length(tj) + b.distance(0, 1) * size, lost = b.pairs[0].lost;
    for (int n = 0; n < 3; ++n) stay(b);
    ASSERT_LE(length(f - b.grains[0].f) * b.distance(0, 1), 1e-14 * turn + rounding()) << trial;
    ASSERT_LE(length(ti - b.grains[0].t) + length(tj - b.grains[1].t), 1e-14 * turn + rounding()) << trial;
    ASSERT_NEAR(b.pairs[0].lost, lost, 1e-10 * lost) << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, Fuzzed, testing::ValuesIn(laws_in_space_and_plane()),
                         [](const auto &info) { return name_of(info.param); });
