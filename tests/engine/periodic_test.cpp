// SPDX-License-Identifier: GPL-2.0-or-later
//
// A bonded body that fills a periodic box: bonds reach through its faces, grains drift through them,
// bonds break and grains slide; the same bits on 1, 2 and 4 ranks, momentum kept. Where other codes cut
// bonds near the edges of the box (PHYSICS.md 3.1).
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

// n x n x n spheres (n x n discs) of not quite equal size on a not quite regular lattice that goes on
// through the faces; all drift, each with a speed of its own besides.
struct Box {
  int dimension = 3, n = 6;
  double spacing = 1.98e-3;  // m
  double drift = 0.0, own = 0.0;  // m/s
  std::string style = "parallel";
  std::vector<double> mass;  // in units of 4/3 pi density, or pi t density

  double width() const { return n * spacing; }
  std::string data() {
    std::vector<Particle> particles;
    std::ostringstream velocities;
    velocities.precision(17);
    mass.clear();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < (dimension == 3 ? n : 1); ++k) {
          Particle p;
          p.x = spacing * (i + 0.5) - 0.5 * width() + 2e-5 * std::sin(7.0 * i + 3.0 * j + k);
          p.y = spacing * (j + 0.5) - 0.5 * width() + 2e-5 * std::sin(5.0 * i - 2.0 * j + 4.0 * k);
          p.z = dimension == 3 ? spacing * (k + 0.5) - 0.5 * width() + 2e-5 * std::cos(3.0 * i + j - k) : 0.0;
          p.radius = 1e-3 * (1.0 - 0.02 * ((i + 2 * j + 3 * k) % 5));
          particles.push_back(p);
          mass.push_back(std::pow(p.radius, dimension));
          velocities << particles.size() << ' ' << drift + own * std::sin(11.0 * i + j + 5.0 * k) << ' '
                     << 0.7 * drift + own * std::cos(3.0 * i - 13.0 * j + k) << ' '
                     << (dimension == 3 ? -0.4 * drift + own * std::sin(i + 7.0 * j - 9.0 * k) : 0.0) << " 0 0 "
                     << 500.0 * std::sin(i + 2.0 * j + k) << '\n';
        }
    return data_file(particles, dimension, 0.5 * width()) + "\nVelocities\n\n" + velocities.str();
  }

  std::string deck(const EngineFolder &folder, const std::string &bond, const std::string &grid,
                   const std::string &then) {
    folder.write("box.data", data());
    Preamble p;
    p.dimension = dimension;
    p.boundary = "p p p";
    p.specimen = "box.data";
    p.install = "gap 3e-4";
    p.bond_style = style;
    p.bond = bond;
    p.contact = "5e9 2.0 0.4";
    p.skin = "2e-4";
    if (dimension == 2) p.atom_style = "bonded/sphere thickness 0.01";
    return "processors " + grid + "\n" + p.text() + "fix integrate all nve/bonded\n" + then + dump_all("end.txt");
  }
};

class Periodic : public testing::TestWithParam<int> {};

std::string run(const std::string &deck, int ranks, const EngineFolder &folder, EngineResult *result = nullptr) {
  const EngineResult r = run_deck(folder, deck, ranks, {}, 300.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
  if (result) *result = r;
  return folder.read("end.txt");
}

}  // namespace

// Every face has as many bonds as every layer inside: 3 (2) for each grain.
TEST_P(Periodic, bonds_reach_through_the_faces) {
  Box box;
  box.dimension = GetParam();
  EngineFolder folder;
  EngineResult r;
  run(box.deck(folder, "5e9 2.0 1e12 1e12", "1 1 1", "run 0\n"), 1, folder, &r);
  EXPECT_EQ(bonds_installed(r), box.dimension == 3 ? 3 * 216 : 2 * 36);
  for (const auto &[id, row] : read_dump(folder, "end.txt"))
    for (int c = 9; c < 15; ++c) EXPECT_LT(std::fabs(row[c]), 1e-8) << id;  // nothing is loaded
}

TEST_P(Periodic, intact_body_drifts_through_the_faces) {
  Box box;
  box.dimension = GetParam();
  box.drift = 60.0, box.own = 0.5;
  const auto deck = [&](const EngineFolder &f, const char *grid) {
    return box.deck(f, "5e9 2.0 1e12 1e12", grid, "variable n equal ceil(1.5e-4/dt)\nrun $n\n");  // 9 mm of 12
  };
  EngineFolder one, two, four;
  const std::string alone = run(deck(one, "1 1 1"), 1, one);
  EXPECT_TRUE(alone == run(deck(two, "2 1 1"), 2, two)) << "2 ranks";
  EXPECT_TRUE(alone == run(deck(four, box.dimension == 3 ? "1 2 2" : "2 2 1"), 4, four)) << "4 ranks";
  const auto rows = read_dump(one, "end.txt");
  double momentum[3] = {0, 0, 0}, all = 0.0;
  const double expected[3] = {60.0, 42.0, box.dimension == 3 ? -24.0 : 0.0};
  double start[3] = {0, 0, 0};
  int at = 0;
  for (const auto &[id, row] : rows) {
    for (int c = 0; c < 3; ++c) momentum[c] += box.mass[at] * row[3 + c];
    all += box.mass[at++];
  }
  // the drift and the mean of the grains' own speeds, as given in the data file
  std::istringstream data(one.read("box.data"));
  std::string line;
  while (std::getline(data, line) && line != "Velocities") {
  }
  while (std::getline(data, line)) {
    std::istringstream f(line);
    int id;
    double v[3];
    if (f >> id >> v[0] >> v[1] >> v[2])
      for (int c = 0; c < 3; ++c) start[c] += box.mass[id - 1] * v[c];
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(momentum[c] / all, start[c] / all, 1e-10) << c;
    EXPECT_NEAR(momentum[c] / all, expected[c], 0.5) << c;
  }
}

TEST_P(Periodic, breaking_body_is_the_same_on_1_2_and_4_ranks) {
  for (const Law &law : {Law{"parallel", "5e9 2.0 20e6 20e6 scatter weibull 4 4 seed 3"},
                         Law{"beam/mohr/coulomb", "5e9 0.2 20e6 30 scatter weibull 4 seed 3 friction 0.3"},
                         Law{"norton", "5e9 0.25 20e6 20e6 0 3 rate_at 20 5e6 moment_creep yes scatter weibull 4 4 seed 3"}}) {
    SCOPED_TRACE(law.style);
    Box box;
    box.dimension = GetParam();
    box.style = law.style;
    box.drift = 40.0, box.own = 8.0;
    const auto deck = [&](const EngineFolder &f, const char *grid) {
      return box.deck(f, law.words, grid,
                      "fix log all bond/log 10 broken.tsv\nvariable n equal ceil(2e-4/dt)\nrun $n\n");
    };
    EngineFolder one, two, four;
    const std::string alone = run(deck(one, "1 1 1"), 1, one);
    const std::size_t broken = read_table(one.file("broken.tsv")).rows.size();
    EXPECT_GT(broken, box.dimension == 3 ? 100u : 10u);
    EXPECT_LT(broken, box.dimension == 3 ? 648u : 72u);
    EXPECT_TRUE(alone == run(deck(two, "2 1 1"), 2, two)) << "2 ranks";
    EXPECT_EQ(one.read("broken.tsv"), two.read("broken.tsv"));
    EXPECT_TRUE(alone == run(deck(four, box.dimension == 3 ? "1 2 2" : "2 2 1"), 4, four)) << "4 ranks";
    EXPECT_EQ(one.read("broken.tsv"), four.read("broken.tsv"));
  }
}

// Shifting everything by half a box changes which bonds are cut, and nothing else but rounding: positions
// lie on a grid of 7e-18 m, bonds are stretched by some 1e-9 m.
TEST_P(Periodic, no_place_is_special) {
  const auto energies = [&](const char *shift) {
    Box box;
    box.dimension = GetParam();
    box.own = 0.5;
    EngineFolder folder;
    run(box.deck(folder, "5e9 2.0 1e12 1e12", "1 1 1",
                 std::string(shift) + "compute energy all energy/bonded\nvariable b equal c_energy[1]\n"
                 "variable k equal c_energy[3]\nfix curve all curve 50 curve.tsv b J v_b k J v_k\nrun 500\n"), 1, folder);
    const Table t = read_table(folder.file("curve.tsv"));
    std::vector<double> all = t.column("b");
    for (const double k : t.column("k")) all.push_back(k);
    return all;
  };
  const std::vector<double> here = energies(""), there = energies("displace_atoms all move 0.006 0.0047 0\n");
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t k = 1; k < here.size(); ++k) EXPECT_NEAR(here[k], there[k], 2e-8 * (here[k] + here.back())) << k;
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Periodic, testing::Values(2, 3));
