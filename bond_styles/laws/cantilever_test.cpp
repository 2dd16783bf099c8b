// SPDX-License-Identifier: GPL-2.0-or-later
//
// Chains under static load against beam theory (PHYSICS.md 2.5, items 1 and 3), 3D and 2D.
//
// The chains are brought to rest by damping proportional to mass, close to critical for the first
// mode, until exp(-25) = 1e-11 of the deflection is left. Where the reference load would bend the
// chain visibly (the closed form is the linear one) a fraction of it is applied: at a slope of 1e-5
// the nonlinear part is 1e-10.
#include <gtest/gtest.h>

#include "chain_runs.h"
#include "reference_table.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

const ReferenceTable &reference() {
  static const ReferenceTable table;
  return table;
}

Bench chain(const Rod &rod, int bonds, double ratio, bool flat = false, double thickness = 1.0,
            Vec3 along = {1, 0, 0}) {
  Bench b(flat, thickness);
  for (int k = 0; k <= bonds; ++k)
    b.add((k * rod.spacing()) * along, rod.radius, rod.density, k == 0);
  ParallelParameters p;
  p.modulus = rod.E;
  p.ratio = ratio;
  for (int k = 0; k < bonds; ++k) b.bond(k, k + 1, p);
  return b;
}

}  // namespace

class Cantilever : public testing::TestWithParam<std::tuple<const char *, int>> {};

TEST_P(Cantilever, tip_load) {
  const auto [convention, n] = GetParam();
  const Rod rod;
  const double deflection = reference()("cantilever_tip_load", rod.name(convention, n) + " bonds; F=1e-3 N", "tip deflection");
  const double rotation = reference()("cantilever_tip_load", rod.name(convention, n), "tip rotation");
  const double fraction = std::min(1.0, 1e-5 / rotation), dt = 1.5e-6;
  Bench b = chain(rod, n, rod.ratio(convention));
  b.grains[n].pull = {0, -1e-3 * fraction, 0};
  const double l = rod.spacing(), mass = b.grains[n].mass;
  settle(b, dt, slow_frequency(rod.E * rod.I(), mass / l, (n + 0.5) * l));
  EXPECT_NEAR(-b.grains[n].x.y / fraction / deflection, 1.0, 1e-8);
  EXPECT_NEAR(-b.grains[n].turned.z / fraction / rotation, 1.0, 1e-8);
  // the root carries the load
  EXPECT_NEAR(b.grains[0].f.y / (-1e-3 * fraction), 1.0, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(AllRows, Cantilever,
                         testing::Combine(testing::Values("GA/l", "12EI/l3", "Timoshenko"),
                                          testing::Values(1, 2, 5, 10, 20, 40)));

// The same chain along an oblique axis and pulled obliquely: no axis is special.
TEST(Cantilever, oblique_chain_bends_alike) {
  const Rod rod;
  const int n = 5;
  const double deflection = reference()("cantilever_tip_load", rod.name("GA/l", n) + " bonds; F=1e-3 N", "tip deflection");
  const Vec3 along = unit({1, -2, 0.7}), across = unit(cross(along, Vec3{0.3, 1, 2}));
  Bench b = chain(rod, n, rod.ratio("GA/l"), false, 1.0, along);
  b.grains[n].pull = 1e-4 * across;
  const Vec3 start = b.grains[n].x;
  settle(b, 1.5e-6, slow_frequency(rod.E * rod.I(), b.grains[n].mass / 2e-3, 5.5 * 2e-3));
  const Vec3 moved = b.grains[n].x - start;
  EXPECT_NEAR(dot(moved, across) / (0.1 * deflection), 1.0, 1e-8);
  EXPECT_LT(length(moved - dot(moved, across) * across), 1e-4 * length(moved));
}

// A strip of thickness t: A = 2 R t, I = 2 R^3 t/3, the same closed form.
TEST(Cantilever, plane_chain) {
  const Rod rod;
  const double t = 4e-3, E = rod.E, l = rod.spacing();
  const double area = 2.0 * rod.radius * t, I = 2.0 / 3.0 * std::pow(rod.radius, 3) * t;
  for (const int n : {1, 2, 5, 10})
    for (const double ks : {rod.G() * area / l, 12.0 * E * I / (l * l * l)}) {
      Bench b = chain(rod, n, E * area / (l * ks), true, t);
      const double L = n * l, F = 1e-5 * 2.0 * E * I / (L * L);
      b.grains[n].pull = {0, F, 0};
      settle(b, 1.2e-6, slow_frequency(E * I, b.grains[n].mass / l, (n + 0.5) * l));
      const double tip = F * L * L * L / (3.0 * E * I) * (1.0 - 0.25 / (n * n)) + F * L / (ks * l);
      EXPECT_NEAR(b.grains[n].x.y / tip, 1.0, 1e-8) << n;
    }
}

// Torsion: n bonds in series turn by M n l/(G J).
TEST(Torsion, chain_under_end_torque) {
  const Rod rod;
  for (const int n : {1, 4, 12}) {
    Bench b = chain(rod, n, 2.6);
    const double M = 1e-5;
    b.grains[n].turn = {M, 0, 0};
    const double kt = rod.G() * rod.J() / rod.spacing(), inertia = b.grains[n].inertia;
    const double omega = 2.0 * std::sqrt(kt / inertia) * std::sin(0.5 * kPi / (2 * n + 1));
    settle(b, 1e-6, omega);
    for (const PairRow &p : b.pairs) EXPECT_NEAR(p.mt / M, 1.0, 1e-9);
    EXPECT_NEAR(b.grains[n].turned.x / (M * n * rod.spacing() / (rod.G() * rod.J())), 1.0, 1e-9);
  }
}

TEST(Torsion, one_bond) {
  const Rod rod;
  Bench b = chain(rod, 1, 2.6);
  b.grains[1].w = {0.01, 0, 0};
  b.load(1.0);
  EXPECT_NEAR(b.grains[1].t.x, -reference()("bond_torsion", rod.name() + "; relative twist 0.01 rad", "moment"), 1e-11);
  EXPECT_EQ(length(b.grains[1].f), 0.0);
}

// Bending without shear: both ends turn by half the angle, opposite ways.
TEST(Bending, one_bond) {
  const Rod rod;
  Bench b = chain(rod, 1, 2.6);
  b.grains[0].w = {0, 0, -0.005};
  b.grains[1].w = {0, 0, 0.005};
  b.load(1.0);
  EXPECT_NEAR(b.grains[1].t.z, -reference()("bond_bending", rod.name() + "; relative bend 0.01 rad, no shear", "moment"), 1e-11);
  EXPECT_EQ(b.grains[1].t.z, -b.grains[0].t.z);
  EXPECT_EQ(length(b.grains[1].f), 0.0);
}

// Bend and twist are told apart: a bend makes no M_t, a twist no M_b (papers swap the names).
TEST(Bending, bend_is_across_twist_is_along) {
  const Rod rod;
  Bench b = chain(rod, 1, 2.6);
  b.grains[1].w = {0, 1e-3, 0};
  b.load(1.0);
  EXPECT_EQ(b.pairs[0].mt, 0.0);
  EXPECT_NEAR(b.pairs[0].mb.y, 1e-3 * rod.E * rod.I() / rod.spacing(), 1e-12);
  Bench c = chain(rod, 1, 2.6);
  c.grains[1].w = {1e-3, 0, 0};
  c.load(1.0);
  EXPECT_LT(length(c.pairs[0].mb), 1e-15 * c.pairs[0].mt);
  EXPECT_NEAR(c.pairs[0].mt, 1e-3 * rod.G() * rod.J() / rod.spacing(), 1e-12);
}

// Tension of a chain: n springs E A/l; with the grain contact only compression adds to it.
TEST(Axial, stiffness_in_tension_and_compression) {
  const Rod rod;
  for (const double sign : {1.0, -1.0}) {
    Bench b = chain(rod, 1, 2.6);
    const double contact = in_series(grain_stiffness_3d(rod.radius, 3e9), grain_stiffness_3d(rod.radius, 3e9));
    EXPECT_DOUBLE_EQ(contact, 2.0 * rod.radius * 3e9);
    b.pairs[0].kn = contact;
    const double u = 1e-7 * sign;
    b.grains[1].v = {u, 0, 0};
    b.grains[1].x.x += u;
    b.load(1.0);
    const double bond = rod.E * rod.area() / rod.spacing();
    EXPECT_NEAR(-b.grains[1].f.x / u, sign > 0 ? bond : bond + contact, 1e-8 * bond);
  }
}
