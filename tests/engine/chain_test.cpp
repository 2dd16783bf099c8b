// SPDX-License-Identifier: GPL-2.0-or-later
//
// The laws inside the engine do what the laws alone do: chains and dimers run in lmp_bondlab and on
// the engine-free bench (laws/chain_testbench.h) side by side; a cantilever against beam theory; a
// dimer that spins freely.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"
#include "laws/chain_testbench.h"
#include "laws/reference_table.h"
#include "laws/strength.h"

using namespace engine;
using namespace engine::bonds;
using bondlab::laws::Vec3;
namespace bench = bondlab::laws::testbench;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kThickness = 0.004;

// A data file with velocities of the same grains.
std::string data_of(const bench::Bench &b, double half_width) {
  std::vector<Particle> particles;
  std::ostringstream velocities;
  velocities.precision(17);
  for (const bench::Grain &g : b.grains) {
    const double r = g.radius, volume = b.flat() ? kPi * r * r * kThickness : 4.0 / 3.0 * kPi * r * r * r;
    particles.push_back({g.x.x, g.x.y, g.x.z, r, g.mass / volume});
    velocities << particles.size() << ' ' << g.v.x << ' ' << g.v.y << ' ' << g.v.z << ' ' << g.w.x
               << ' ' << g.w.y << ' ' << g.w.z << '\n';
  }
  return data_file(particles, b.flat() ? 2 : 3, half_width) + "\nVelocities\n\n" + velocities.str();
}

// The preamble of the same material; the bench's bonds are listed in `pairs`.
Preamble deck_of(const bench::Bench &b, const EngineFolder &folder, double half_width,
                 const std::string &bond, const std::string &contact) {
  folder.write("grains.data", data_of(b, half_width));
  std::string list;
  for (const bench::PairRow &p : b.pairs)
    if (p.bonded) list += std::to_string(p.i + 1) + " " + std::to_string(p.j + 1) + "\n";
  folder.write("pairs", list);
  Preamble p;
  p.dimension = b.flat() ? 2 : 3;
  if (b.flat()) p.atom_style = "bonded/sphere thickness " + std::to_string(kThickness);
  p.specimen = "grains.data";
  p.install = list.empty() ? "" : "file pairs";
  p.bond = bond;
  p.contact = contact;
  p.skin = "3e-4";
  p.safety = 0.0;
  return p;
}

// Largest differences of positions and forces, each relative to the size of its motion.
struct Difference {
  double place = 0.0, force = 0.0, turn = 0.0;
};
Difference compare(const bench::Bench &b, const std::map<int, Row> &rows) {
  Difference d;
  double force = 1e-300, torque = 1e-300;
  for (const bench::Grain &g : b.grains) {
    force = std::max(force, bench::length(g.f));
    torque = std::max(torque, bench::length(g.t));
  }
  for (std::size_t k = 0; k < b.grains.size(); ++k) {
    const Row &r = rows.at(static_cast<int>(k) + 1);
    const bench::Grain &g = b.grains[k];
    d.place = std::max(d.place, bench::length(Vec3{r[0], r[1], r[2]} - g.x));
    d.force = std::max(d.force, bench::length(Vec3{r[9], r[10], r[11]} - g.f) / force);
    d.turn = std::max(d.turn, bench::length(Vec3{r[12], r[13], r[14]} - g.t) / torque);
  }
  return d;
}

bench::Bench moving_chain(bool flat, int grains) {
  bench::Bench b(flat, kThickness);
  for (int k = 0; k < grains; ++k)
    b.add({1.9e-3 * k - 4e-3, 2e-4 * std::sin(3.0 * k), flat ? 0.0 : 2e-4 * std::cos(5.0 * k)},
          1e-3 * (1.0 - 0.1 * (k % 3)), 2500);
  for (int k = 0; k < grains; ++k) {
    bench::Grain &g = b.grains[k];
    g.v = {2.0 * std::sin(1.0 + k), 3.0 * std::cos(2.0 * k), flat ? 0.0 : 2.0 * std::sin(4.0 * k)};
    g.w = {flat ? 0.0 : 900.0 * std::sin(k), flat ? 0.0 : -700.0, 1000.0 * std::cos(k)};
  }
  return b;
}

}  // namespace

class EngineAndBench : public testing::TestWithParam<bool> {};

TEST_P(EngineAndBench, vibrating_tumbling_chain) {
  const bool flat = GetParam();
  bench::Bench b = moving_chain(flat, 6);
  bondlab::laws::ParallelParameters p;
  p.modulus = 1e9;
  p.ratio = 2.6;
  for (int k = 0; k < 5; ++k) b.bond(k, k + 1, p, {2e9, 2.0, 0.4});
  EngineFolder folder;
  const double dt = 1e-7;
  const EngineResult r = run_deck(folder, deck_of(b, folder, 0.02, "1e9 2.6 1e15 1e15", "2e9 2.0 0.4").text() +
                                              "fix integrate all nve/bonded\ntimestep 1e-7\nrun 3000\n" + dump_all("end.txt"));
  ASSERT_TRUE(r.ok()) << r.screen;
  b.load(0.0, false);
  for (int k = 0; k < 3000; ++k) b.step(dt);
  const Difference d = compare(b, read_dump(folder, "end.txt"));
  EXPECT_LT(d.place, 1e-14);  // m, of a motion of millimetres: rounding of 3000 steps
  EXPECT_LT(d.force, 1e-9);
  EXPECT_LT(d.turn, 1e-9);
  EXPECT_GT(bench::length(b.grains[2].f), 0.5);
}

// Breaks at the same step, in the same mode, and the pieces go on alike.
TEST_P(EngineAndBench, chain_that_breaks) {
  const bool flat = GetParam();
  bench::Bench b = moving_chain(flat, 6);
  bondlab::laws::ParallelParameters p;
  p.modulus = 1e9;
  p.ratio = 2.6;
  p.beta = 0.5;
  p.tan_phi = std::tan(20.0 * kPi / 180.0);
  p.lambda = 0.8;
  for (int k = 0; k < 5; ++k) {
    bench::PairRow &row = b.bond(k, k + 1, p, {2e9, 2.0, 0.4});
    const bondlab::laws::StrengthDistribution sigma{4e6, bondlab::laws::Scatter::weibull, 4.0, 7, 0};
    const bondlab::laws::StrengthDistribution tau{6e6, bondlab::laws::Scatter::weibull, 5.0, 7, 1};
    row.sigma_c = bond_strength(sigma, k + 1, k + 2);
    row.tau_c = bond_strength(tau, k + 1, k + 2);
  }
  EngineFolder folder;
  const EngineResult r = run_deck(
      folder, deck_of(b, folder, 0.02,
                      "1e9 2.6 4e6 6e6 lambda 0.8 beta 0.5 friction_angle 20 scatter weibull 4 5 seed 7", "2e9 2.0 0.4").text() +
                  "fix log all bond/log 10 broken.tsv\nfix integrate all nve/bonded\ntimestep 1e-7\nrun 400\n" + dump_all("end.txt"));
  ASSERT_TRUE(r.ok()) << r.screen;
  std::vector<std::pair<int, int>> expected;  // step, first id
  std::string modes;
  b.load(0.0, false);
  for (int k = 1; k <= 400; ++k) {
    b.step(1e-7);
    for (bench::PairRow &row : b.pairs) {
      const double touching = b.grains[row.i].radius + b.grains[row.j].radius;
      if (row.alive == 0.0 && b.distance(row.i, row.j) >= std::max(touching, row.reference))
        row.reference = touching;  // apart: an ordinary contact from now on
      if (row.fate != bondlab::laws::BondFate::intact) {
        expected.push_back({k, row.i + 1});
        modes += row.fate == bondlab::laws::BondFate::broken_in_shear ? "shear " : "tension ";
      }
    }
  }
  EXPECT_GE(expected.size(), 2u);
  const Table log = read_table(folder.file("broken.tsv"));
  ASSERT_EQ(log.rows.size(), expected.size());
  std::string logged;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(log.column("step")[k], expected[k].first);
    EXPECT_EQ(log.column("id1")[k], expected[k].second);
    logged += log.rows[k][8] + " ";
  }
  EXPECT_EQ(logged, modes);
  const Difference d = compare(b, read_dump(folder, "end.txt"));
  EXPECT_LT(d.place, 1e-14);
}

// Two loose grains collide, slide and part.
TEST_P(EngineAndBench, collision_of_two_grains) {
  const bool flat = GetParam();
  bench::Bench b(flat, kThickness);
  b.add({0, 0, 0}, 1e-3, 2500);
  b.add({1.7e-3, 0.6e-3, flat ? 0.0 : 0.3e-3}, 0.8e-3, 2000);
  b.grains[1].v = {-3.0, 0.5, flat ? 0.0 : 0.3};
  b.grains[0].w = {0, 0, 3000.0};
  b.contact(0, 1, {5e9, 2.0, 0.3});
  EngineFolder folder;
  const EngineResult r = run_deck(folder, deck_of(b, folder, 0.02, "1e9 2 1e9 1e9", "5e9 2.0 0.3").text() +
                                              "fix integrate all nve/bonded\ntimestep 5e-8\nrun 2000\n" + dump_all("end.txt"));
  ASSERT_TRUE(r.ok()) << r.screen;
  b.load(0.0, false);
  double strongest = 0.0;
  for (int k = 0; k < 2000; ++k) {
    b.step(5e-8);
    strongest = std::max(strongest, bench::length(b.pairs[0].cs));
  }
  EXPECT_GT(strongest, 1.0);                        // they did slide
  EXPECT_EQ(bench::length(b.grains[0].f), 0.0);     // and part
  const Difference d = compare(b, read_dump(folder, "end.txt"));
  EXPECT_LT(d.place, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, EngineAndBench, testing::Values(false, true),
                         [](const auto &flat) { return flat.param ? "plane" : "space"; });

// Tip load of a cantilever of ten bonds against the reference table, 3D.
TEST(Cantilever, in_the_engine) {
  const bench::Rod rod;
  const bench::ReferenceTable reference;
  const int n = 10;
  const double F = 1e-6;  // a thousandth of the table's load: linear
  bench::Bench b;
  for (int k = 0; k <= n; ++k) b.add({k * 2e-3, 0, 0}, 1e-3, rod.density);
  bondlab::laws::ParallelParameters p;
  for (int k = 0; k < n; ++k) b.bond(k, k + 1, p);
  const double f1 = reference("cantilever_vibration", rod.name("GA/l", n), "f1");
  const double mass = b.grains[0].mass, damping = 1.4 * 2.0 * kPi * f1 * mass;
  EngineFolder folder;
  std::ostringstream deck;
  deck.precision(17);
  deck << deck_of(b, folder, 0.05, "1e9 2.6 1e15 1e15", "0 1 0").text() << "group free id > 1\ngroup tip id "
       << n + 1 << "\nfix load tip addforce 0 " << F << " 0\nfix drag free viscous " << damping
       << "\nfix integrate free nve/bonded\ntimestep 1.5e-6\nrun 10000\n" << dump_all("end.txt");
  const EngineResult r = run_deck(folder, deck.str());
  ASSERT_TRUE(r.ok()) << r.screen;
  const double tip = read_dump(folder, "end.txt").at(n + 1)[1];
  EXPECT_NEAR(tip / (1e-3 * reference("cantilever_tip_load", rod.name("GA/l", n) + " bonds; F=1e-3 N", "tip deflection")), 1.0, 1e-6);
}

// A dimer of unequal grains spins freely about an oblique axis for a hundred turns: both momenta to
// rounding, energy and distance as at the start (a top turns steadily; the bond swings elastically).
TEST(Dimer, spins_freely_for_a_hundred_turns) {
  bench::Bench b;
  const Vec3 spin{3000.0, 4000.0, -6000.0};
  b.add({-1e-3, 0, 0}, 1e-3, 2500);
  b.add({0.8e-3, 0, 0}, 0.7e-3, 2500);
  const double m0 = b.grains[0].mass, m1 = b.grains[1].mass;
  const double centre = (m0 * b.grains[0].x.x + m1 * b.grains[1].x.x) / (m0 + m1);
  for (bench::Grain &g : b.grains) {
    g.w = spin;
    g.v = cross(spin, g.x - Vec3{centre, 0, 0});
  }
  bondlab::laws::ParallelParameters p;
  p.modulus = 1e9;
  p.ratio = 2.6;
  b.bond(0, 1, p);
  b.load(0.0, false);
  const Vec3 start = b.angular_momentum();
  const double energy = b.kinetic_energy();
  const double turn = 2.0 * kPi / bench::length(spin), dt = 1e-7;
  const int steps = static_cast<int>(100 * turn / dt);
  EngineFolder folder;
  const EngineResult r = run_deck(folder, deck_of(b, folder, 0.02, "1e9 2.6 1e15 1e15", "0 1 0").text() +
                                              "fix integrate all nve/bonded\ntimestep 1e-7\nrun " + std::to_string(steps) +
                                              "\n" + dump_all("end.txt"));
  ASSERT_TRUE(r.ok()) << r.screen;
  const std::map<int, Row> rows = read_dump(folder, "end.txt");
  for (int k = 0; k < 2; ++k) {
    const Row &row = rows.at(k + 1);
    b.grains[k].x = {row[0], row[1], row[2]};
    b.grains[k].v = {row[3], row[4], row[5]};
    b.grains[k].w = {row[6], row[7], row[8]};
  }
  EXPECT_LT(bench::length(b.angular_momentum() - start), 1e-10 * bench::length(start));
  EXPECT_LT(bench::length(b.momentum()), 1e-10 * m0 * bench::length(spin) * 1e-3);
  // the bond's own energy is (v/c)^2 = 1e-4 of the motion's
  EXPECT_NEAR(b.kinetic_energy() / energy, 1.0, 1e-3);
  EXPECT_NEAR(b.distance(0, 1) / 1.8e-3, 1.0, 1e-3);
}
