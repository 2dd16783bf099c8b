// SPDX-License-Identifier: GPL-2.0-or-later
//
// The options of all bond styles in the engine: softening, damping, tension_modulus and `contact no`
// on any number of ranks and through a restart, bit for bit; against closed forms for one bond; and the
// energy of a pressed specimen: what the platens put in is what is stored, moving and lost.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

const char *kEverything =
    "5e9 2.0 8e6 8e6 scatter normal 0.3 0.3 seed 4 softening 12 damping 0.1 tension_modulus 0.8 contact no";

const char *kCurve =
    "compute energy all energy/bonded\n"
    "variable bond equal c_energy[1]\nvariable contact equal c_energy[2]\nvariable lost equal c_energy[5]\n"
    "variable top equal f_top[3]\n"
    "fix curve all curve 100 curve.tsv top N v_top bond J v_bond contact J v_contact lost J v_lost\n"
    "fix log all bond/log 100 broken.tsv\n";

std::string crushed(int steps, const std::string &neighbour = "delay 0") {
  Preamble p = small();
  p.bond = kEverything;
  p.neighbour = neighbour;
  return p.text() + press_small(2.0) + "fix integrate all nve/bonded\n" + kCurve + "run " + std::to_string(steps) + "\n" +
         dump_all("end.txt");
}

struct Outcome {
  std::string particles, curve, broken;
  std::size_t breaks = 0;
  double lost = 0.0;
};

Outcome run(const std::string &deck, int ranks) {
  EngineFolder folder;
  const EngineResult r = run_deck(folder, deck, ranks, {}, 180.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1000 ? r.screen.size() - 1000 : 0);
  Outcome o{folder.read("end.txt"), folder.read("curve.tsv"), folder.read("broken.tsv"), 0, 0.0};
  EXPECT_FALSE(o.particles.empty());
  o.breaks = read_table(folder.file("broken.tsv")).rows.size();
  o.lost = read_table(folder.file("curve.tsv")).last("lost");
  return o;
}

void expect_same(const Outcome &a, const Outcome &b, const std::string &what) {
  EXPECT_TRUE(a.particles == b.particles) << what << ": particles differ";
  EXPECT_TRUE(a.curve == b.curve) << what << ": curves differ";
  EXPECT_TRUE(a.broken == b.broken) << what << ": broken bonds differ";
}

std::string again(const std::string &file) {
  return "atom_style bonded/sphere\nnewton off\ncommunicate single vel yes\nread_restart " + file +
         "\nneighbor 5e-5 bin\nneigh_modify delay 0\nthermo 100000\nthermo_style custom step time ke\n"
         "thermo_modify lost error\n";
}

// Two touching grains of 1 mm radius on a string: the second one goes along x as prescribed.
struct Pull {
  double area = 3.14159265358979323846 * 1e-6, k = 5e9 * area / 2e-3;  // m2, N/m
  std::string bond;
  std::string contact = "0 2.0 0.5";
  int dimension = 3;

  // Moves grain 2 by the given stretches (m), in straight lines of `steps` steps each.
  Table run(const std::vector<double> &stretches, int steps) const {
    EngineFolder folder;
    folder.write("grains.data", data_file({{0, 0, 0}, {2e-3, 0, 0}}, dimension, 0.02));
    Preamble p;
    p.dimension = dimension;
    if (dimension == 2) p.atom_style = "bonded/sphere thickness 0.001";
    p.specimen = "grains.data";
    p.install = "gap 1e-5";
    p.bond = bond;
    p.contact = contact;
    p.safety = 0.0;
    std::ostringstream deck;
    deck.precision(17);
    deck << p.text() << "group second id 2\ntimestep 1e-9\nfix integrate all nve/bonded\nfix still all setforce 0 0 0\n"
         << "compute energy all energy/bonded\nvariable x equal x[2]-0.002\nvariable lost equal c_energy[5]\n"
         << "variable bond equal c_energy[1]\nvariable contact equal c_energy[2]\n"
         << "fix curve all curve 1 curve.tsv x m v_x lost J v_lost bond J v_bond contact J v_contact\n";
    double at = 0.0;
    for (const double x : stretches) {
      deck << "velocity second set " << (x - at) / (steps * 1e-9) << " 0 0\nrun " << steps << "\n";
      at = x;
    }
    const EngineResult r = run_deck(folder, deck.str());
    EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1000 ? r.screen.size() - 1000 : 0);
    return read_table(folder.file("curve.tsv"));
  }
};

}  // namespace

TEST(OptionsRanks, everything_at_once_is_the_same_on_1_2_and_4) {
  const Outcome one = run(crushed(2500), 1);
  EXPECT_GT(one.breaks, 1000u);
  EXPECT_GT(one.lost, 0.0);
  expect_same(one, run(crushed(2500), 2), "2 ranks");
  expect_same(one, run(crushed(2500), 4), "4 ranks");
}

TEST(OptionsRanks, rebuilding_the_neighbour_list_at_every_step_changes_nothing) {
  const Outcome rarely = run(crushed(1500), 1);
  EXPECT_GT(rarely.breaks, 300u);
  expect_same(rarely, run(crushed(1500, "delay 0 every 1 check no"), 2), "rebuilt at every step");
}

TEST(OptionsRestart, goes_on_with_the_same_bits_on_another_number_of_ranks) {
  const std::string fixes = press_small(2.0) + "fix integrate all nve/bonded\ncompute energy all energy/bonded\n"
                            "fix log all bond/log 50 broken.tsv\n";
  const std::string end = dump_all("end.txt") +
      "variable a equal c_energy[1]\nvariable b equal c_energy[2]\nvariable c equal c_energy[5]\nvariable d equal f_log[1]\n"
      "fix end all curve 1 last.tsv a J v_a b J v_b c J v_c d 1 v_d\nrun 0\n";
  Preamble p = small();
  p.bond = kEverything;
  const auto values = [](const EngineFolder &f) {
    const Table t = read_table(f.file("last.tsv"));
    std::string text;
    for (std::size_t c = 0; c < t.names.size(); ++c)
      if (t.names[c] != "time") text += t.rows.back()[c] + " ";
    return text;
  };
  EngineFolder one;
  EngineResult r = run_deck(one, p.text() + fixes + "restart 1231 state.*\nrun 2000\n" + end, 1);
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_GT(read_table(one.file("last.tsv")).last("d"), 500.0);
  for (const int ranks : {1, 4}) {
    EngineFolder other;
    r = run_deck(other, again(one.file("state.1231")) + fixes + "run 769\n" + end, ranks);
    ASSERT_TRUE(r.ok()) << r.screen;
    EXPECT_TRUE(one.read("end.txt") == other.read("end.txt")) << ranks;
    EXPECT_EQ(values(one), values(other)) << ranks;
  }
  EngineFolder pieces;
  r = run_deck(pieces, p.text() + fixes + "run 1\nrun 830\nrun 0\nrun 1169\n" + end, 2);
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_TRUE(one.read("end.txt") == pieces.read("end.txt")) << "in pieces";
  EXPECT_EQ(values(one), values(pieces)) << "in pieces";
}

// G_f A of one bond is gone when it is, with the tension modulus as well, in space and in the plane.
TEST(OptionsBond, pull_dissipates_the_fracture_energy) {
  for (const int dimension : {3, 2})
    for (const double tension : {1.0, 0.5, 2.0}) {
      Pull pull;
      pull.dimension = dimension;
      const double area = dimension == 3 ? pull.area : 2e-3 * 1e-3, G_f = 40.0;
      pull.bond = "5e9 2.0 5e6 1e12 softening 40 tension_modulus " + std::to_string(tension);
      const double u_f = 2.0 * G_f / 5e6;
      const Table t = pull.run({1.1 * u_f}, 500);
      EXPECT_NEAR(t.last("lost") / (G_f * area), 1.0, 1e-6) << dimension << ' ' << tension;
      EXPECT_EQ(t.last("bond"), 0.0);
    }
}

// Energy on the two sides of the length of bonding: 1/2 k u^2 and 1/2 (E_t/E_c) k u^2.
TEST(OptionsBond, tension_modulus) {
  Pull pull;
  pull.bond = "5e9 2.0 1e12 1e12 tension_modulus 0.3";
  const Table t = pull.run({1e-6, -1e-6}, 100);
  const std::vector<double> x = t.column("x"), e = t.column("bond");
  for (std::size_t k = 0; k < x.size(); ++k)
    EXPECT_NEAR(e[k], 0.5 * (x[k] > 0.0 ? 0.3 : 1.0) * pull.k * x[k] * x[k], 1e-8 * pull.k * 1e-12) << k;
}

// The dashpot takes c v^2 a second: c = 2 zeta sqrt(k m), m that of the two grains together.
TEST(OptionsBond, damping_takes_what_a_dashpot_takes) {
  Pull pull;
  pull.bond = "5e9 2.0 1e12 1e12 damping 0.2";
  const int steps = 200;
  const double mass = 4.0 / 3.0 * 3.14159265358979323846 * 1e-9 * 2500 / 2.0, c = 2.0 * 0.2 * std::sqrt(pull.k * mass);
  const Table t = pull.run({1e-6}, steps);
  const double v = 1e-6 / (steps * 1e-9);
  EXPECT_NEAR(t.last("lost") / (c * v * 1e-6), 1.0, 1e-6);
  EXPECT_NEAR(t.last("bond") / (0.5 * pull.k * 1e-12), 1.0, 1e-6);
}

// `contact no`: no contact beside the intact bond; after the break one that starts unloaded.
TEST(OptionsBond, contact_no) {
  Pull pull;
  pull.contact = "5e9 2.0 0.5";
  pull.bond = "5e9 2.0 1e12 1e12 contact no";
  const Table t = pull.run({-1e-6}, 100);
  EXPECT_NEAR(t.last("bond") / (0.5 * pull.k * 1e-12), 1.0, 1e-6);
  EXPECT_EQ(t.last("contact"), 0.0);
  // broken in tension, pressed again: loaded from R_i + R_j on, as any contact
  pull.bond = "5e9 2.0 5e6 1e12 contact no";
  const Table back = pull.run({1e-5, -1e-6}, 100);
  EXPECT_EQ(back.last("bond"), 0.0);
  EXPECT_NEAR(back.last("contact") / (0.5 * 0.5 * 4e-3 * 5e9 * 1e-12), 1.0, 1e-6);
}
