// SPDX-License-Identifier: GPL-2.0-or-later
//
// compute stress/bonded: the closed form on a chain, equilibrium in a packing, any number of ranks.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

const double kPi = 3.14159265358979323846;

std::string dump_stress() {
  return "dump s all custom 1 stress.txt id x y z radius c_s[1] c_s[2] c_s[3] c_s[4] c_s[5] c_s[6]\n"
         "dump_modify s sort id format \"%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\"\n"
         "run 0\n";
}

std::vector<std::array<double, 10>> rows_of(const std::string &text) {
  std::istringstream in(text);
  std::string line;
  std::vector<std::array<double, 10>> rows;
  while (std::getline(in, line) && line.compare(0, 11, "ITEM: ATOMS") != 0) {
  }
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    int id;
    std::array<double, 10> row;
    fields >> id;
    for (double &v : row) fields >> v;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

// Three spheres in line along an oblique direction, the outer ones drawn apart by u each: bonds carry
// f = E_b pi R^2 u/(2R); the middle sphere has two contact points, the outer ones one.
TEST(StressBonded, is_the_closed_form_on_a_chain) {
  EngineFolder folder;
  Preamble p;
  const double R = 1e-3, e[3] = {0.6, 0.0, 0.8};
  folder.write("chain.data", data_file({{-2 * R * e[0], 0, -2 * R * e[2]}, {0, 0, 0}, {2 * R * e[0], 0, 2 * R * e[2]}}, 3, 0.05));
  p.specimen = "chain.data";
  p.install = "gap 1e-6";
  p.bond = "1e9 2.0 1e20 1e20";
  p.safety = 0.0;
  const double u = 1e-7, dt = 1e-8, speed = u / (100 * dt);
  std::ostringstream o;
  o.precision(17);
  o << p.text() << "timestep " << dt << "\ngroup a id 1\ngroup b id 3\nfix a a move linear " << -speed * e[0] << " 0 "
    << -speed * e[2] << "\nfix b b move linear " << speed * e[0] << " 0 " << speed * e[2]
    << "\ncompute s all stress/bonded\nrun 100\n" << dump_stress();
  const EngineResult r = run_deck(folder, o.str(), 1);
  ASSERT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 600 ? r.screen.size() - 600 : 0);
  const auto rows = rows_of(folder.read("stress.txt"));
  ASSERT_EQ(rows.size(), 3u);
  const double f = 1e9 / (2 * R) * kPi * R * R * u, V = 4.0 / 3.0 * kPi * R * R * R, branch = R + 0.5 * u;
  for (const int k : {0, 1, 2}) {
    const double size = (k == 1 ? 2.0 : 1.0) * f * branch / V;
    const double expected[6] = {size * e[0] * e[0], 0.0, size * e[2] * e[2], 0.0, size * e[0] * e[2], 0.0};
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(rows[k][4 + c], expected[c], 1e-7 * size) << "sphere " << k << " component " << c;
  }
}

// In a pressed specimen the sum of V_p sigma_zz over a layer is the platens' force times the layer's
// height, but for the particles its faces cut.
TEST(StressBonded, sums_to_force_times_height_in_a_pressed_packing) {
  EngineFolder folder;
  const Preamble p = small();
  const std::string press = p.text() + press_small(0.05) +
                            "fix integrate all nve/bonded\nfix damp all damp/local 0.7\nvariable top equal f_top[3]\n"
                            "fix curve all curve 2000 curve.tsv top N v_top\ncompute s all stress/bonded\nrun 40000\n" +
                            dump_stress();
  const EngineResult r = run_deck(folder, press, 2);
  ASSERT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 600 ? r.screen.size() - 600 : 0);
  const double force = std::fabs(read_table(folder.file("curve.tsv")).last("top"));
  double sum = 0.0, across = 0.0, middle = 0.0;
  const double low = 0.003, high = 0.009, layer = force * (high - low);
  for (const auto &row : rows_of(folder.read("stress.txt"))) {
    const double V = 4.0 / 3.0 * kPi * row[3] * row[3] * row[3];
    sum += V * row[6];
    across += V * row[4];
    if (row[2] > low && row[2] < high) middle += V * row[6];
  }
  EXPECT_GT(force, 1.0);
  // particles cut by the layers' faces: a radius in six
  EXPECT_NEAR(-middle / layer, 1.0, 0.1);
  EXPECT_LT(sum, 0.0);
  EXPECT_LT(std::fabs(across), 0.2 * std::fabs(sum));
}

TEST(StressBonded, is_the_same_on_any_number_of_ranks) {
  std::string texts[3];
  const int ranks[3] = {1, 2, 4};
  for (const int k : {0, 1, 2}) {
    EngineFolder folder;
    const EngineResult r = run_deck(folder, small().text() + press_small(0.5) +
                                               "fix integrate all nve/bonded\nfix damp all damp/local 0.7\n"
                                               "compute s all stress/bonded\nrun 2000\n" + dump_stress(), ranks[k]);
    ASSERT_TRUE(r.ok()) << r.screen;
    texts[k] = folder.read("stress.txt");
  }
  EXPECT_GT(texts[0].size(), 10000u);
  EXPECT_TRUE(texts[0] == texts[1]);
  EXPECT_TRUE(texts[0] == texts[2]);
}
