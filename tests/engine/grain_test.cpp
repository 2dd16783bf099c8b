// SPDX-License-Identifier: GPL-2.0-or-later
//
// pair_style grain in the engine: types, the stress-free reference before and after a break, and the
// hand-over from a broken bond to an ordinary contact.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

// Two grains of types 1 and 2 that overlap by 1 um, at rest.
std::string two_types(int dimension) {
  const std::string z = dimension == 2 ? "0.001" : "0.02";
  return "two\n\n2 atoms\n2 atom types\n1 bond types\n\n-0.02 0.02 xlo xhi\n-0.02 0.02 ylo yhi\n-" + z +
         " " + z + " zlo zhi\n\nAtoms\n\n1 1 2e-3 2500 0 0 0\n2 2 1e-3 2500 1.499e-3 0 0\n";
}

double force_at_rest(const std::string &coefficients, int dimension) {
  EngineFolder folder;
  folder.write("grains.data", two_types(dimension));
  const std::string style = dimension == 2 ? " thickness 0.005" : "";
  const EngineResult r = run_deck(folder,
      "units si\ndimension " + std::to_string(dimension) + "\nnewton off\nboundary f f " + (dimension == 2 ? "p" : "f") +
      "\natom_style bonded/sphere" + style + "\ncommunicate single vel yes\npair_style grain\nread_data grains.data\n"
      "neighbor 1e-4 bin\n" + coefficients + "fix i all nve/bonded\ntimestep 1e-9\nrun 0\n" + dump_all("end.txt"));
  EXPECT_TRUE(r.ok()) << r.screen;
  return read_dump(folder, "end.txt").at(2)[9];
}

}  // namespace

TEST(Grain, stiffness_of_two_types) {
  const auto series = [](double a, double b) { return a * b / (a + b); };
  EXPECT_NEAR(force_at_rest("pair_coeff * * 5e9 2 0.5\n", 3) / (1e-6 * series(4e-3 * 5e9, 2e-3 * 5e9)), 1.0, 1e-9);
  EXPECT_NEAR(force_at_rest("pair_coeff * * 5e9 2 0.5\n", 2) / (1e-6 * series(0.01 * 5e9, 0.01 * 5e9)), 1.0, 1e-9);
  // named only with themselves: each brings its own modulus
  EXPECT_NEAR(force_at_rest("pair_coeff 1 1 5e9 2 0.5\npair_coeff 2 2 20e9 2 0.5\n", 3) /
                  (1e-6 * series(4e-3 * 5e9, 2e-3 * 20e9)), 1.0, 1e-9);
  // named as a pair
  EXPECT_NEAR(force_at_rest("pair_coeff 1 1 5e9 2 0.5\npair_coeff 2 2 20e9 2 0.5\npair_coeff 1 2 1e9 2 0.5\n", 3) /
                  (1e-6 * series(4e-3 * 1e9, 2e-3 * 1e9)), 1.0, 1e-9);
  EXPECT_EQ(force_at_rest("pair_coeff * * 0 2 0.5\n", 3), 0.0);
}

// A packing with overlaps and gaps bonded as it is: no force anywhere, and it stays at rest.
TEST(Grain, bonded_packing_is_stress_free) {
  EngineFolder folder;
  Preamble p;
  p.specimen = "grains.data";
  p.install = "gap 3e-4";
  folder.write("grains.data", data_file({{0, 0, 0}, {1.9e-3, 0, 0}, {4e-3, 0, 0}, {4e-3, 1.95e-3, 0}, {2e-3, 2.1e-3, 1e-4}}, 3, 0.02));
  const EngineResult r = run_deck(folder, p.text() + "fix i all nve/bonded\nrun 500\n" + dump_all("end.txt"));
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_EQ(bonds_installed(r), 5);
  // rounding of the distance (4e-19 m) times the stiffness (1e7 N/m), once in motion a little more
  for (const auto &[id, row] : read_dump(folder, "end.txt"))
    for (int k = 9; k < 12; ++k) EXPECT_LT(std::fabs(row[k]), 1e-9) << id;
}

// A pair bonded with a gap breaks in tension, comes back: between the two distances nothing acts
// (its reference is now R1 + R2), and it bounces off as an unbonded pair would.
TEST(Grain, reference_is_the_touching_distance_once_the_pair_has_parted) {
  for (const double distance : {2.02e-3, 1.98e-3}) {
    EngineFolder folder;
    folder.write("grains.data", data_file({{0, 0, 0}, {distance, 0, 0}}, 3, 0.02));
    Preamble p;
    p.specimen = "grains.data";
    p.install = "gap 1e-4";
    p.bond = "5e9 2.0 1e6 1e6";
    p.safety = 0.0;
    // out at 1 m/s until it has broken and parted, then back
    const EngineResult r = run_deck(folder, p.text() +
        "group second id 2\nvelocity second set 1 0 0\nfix i second nve/bonded\ntimestep 1e-8\nrun 10000\n"
        "velocity second set -1 0 0\nvariable x equal x[2]\nvariable f equal fx[2]\n"
        "fix curve all curve 1 curve.tsv x m v_x f N v_f\nrun 25000\n");
    ASSERT_TRUE(r.ok()) << r.screen;
    const Table t = read_table(folder.file("curve.tsv"));
    const std::vector<double> x = t.column("x"), f = t.column("f");
    const double kn = 0.5 * 4e-3 * 5e9;
    EXPECT_GT(x.front(), 2.05e-3);
    double deepest = 0.0;
    for (std::size_t k = 1; k < x.size(); ++k) {
      const double overlap = 2e-3 - x[k];
      deepest = std::max(deepest, overlap);
      if (overlap <= 0.0) {
        EXPECT_EQ(f[k], 0.0);
      } else {
        EXPECT_NEAR(f[k], kn * overlap, 1e-9 * kn * 1e-6);
      }
    }
    EXPECT_GT(deepest, 1e-6);
  }
}

// A pair that has broken, parted and come together again slides on with its history whenever lists
// are rebuilt (a rebuild used to wipe it).
TEST(Grain, history_of_a_broken_pair_survives_rebuilds) {
  std::string last;
  for (const char *neighbour : {"delay 0", "delay 0 every 1 check no"}) {
    EngineFolder folder;
    folder.write("grains.data", data_file({{0, 0, 0}, {2e-3, 0, 0}, {5e-3, 5e-3, 0}}, 3, 0.02));
    Preamble p;
    p.specimen = "grains.data";
    p.install = "gap 1e-5";
    p.bond = "5e9 2.0 1e6 1e6";
    p.contact = "5e9 2.0 10.0";  // sticks
    p.skin = "1e-4";
    p.neighbour = neighbour;
    p.safety = 0.0;
    const EngineResult r = run_deck(folder, p.text() +
        "group second id 2\nvelocity second set 0.5 0 0\nfix i second nve/bonded\ntimestep 1e-8\nrun 400\n"
        "velocity second set -0.5 0.3 0.1\nrun 480\n" + dump_all("end.txt"));
    ASSERT_TRUE(r.ok()) << r.screen;
    const auto rows = read_dump(folder, "end.txt");
    EXPECT_GT(std::fabs(rows.at(2)[10]), 0.1);  // a shear force is held
    if (last.empty())
      last = folder.read("end.txt");
    else
      EXPECT_TRUE(last == folder.read("end.txt"));
  }
}
