// SPDX-License-Identifier: GPL-2.0-or-later
//
// What bond_install leaves out, what write_data keeps, what compute bonded/local says.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

const char *kDump =
    "compute bonds all bonded/local id1 id2 nx ny nz dist fn fs sigma damage energy\n"
    "dump bonds all local 1 bonds.txt c_bonds[1] c_bonds[2] c_bonds[3] c_bonds[4] c_bonds[5] "
    "c_bonds[6] c_bonds[7] c_bonds[8] c_bonds[9] c_bonds[10] c_bonds[11]\n";

using Bonds = std::map<std::pair<int, int>, std::array<double, 9>>;

// The last frame of a dump of kDump.
Bonds read_bonds(const EngineFolder &folder, const std::string &file = "bonds.txt") {
  std::istringstream in(folder.read(file));
  Bonds bonds;
  std::string line;
  bool inside = false;
  while (std::getline(in, line)) {
    if (line.compare(0, 5, "ITEM:") == 0) {
      inside = line.compare(0, 13, "ITEM: ENTRIES") == 0;
      if (inside) bonds.clear();
      continue;
    }
    if (!inside) continue;
    std::istringstream fields(line);
    int a, b;
    std::array<double, 9> values;
    fields >> a >> b;
    for (double &v : values) fields >> v;
    bonds[{a, b}] = values;
  }
  return bonds;
}

std::set<std::pair<int, int>> keys(const Bonds &bonds) {
  std::set<std::pair<int, int>> all;
  for (const auto &entry : bonds) all.insert(entry.first);
  return all;
}

Bonds installed(const std::string &words, int ranks = 1) {
  EngineFolder folder;
  Preamble p = small();
  p.install += " " + words;
  const EngineResult r = run_deck(folder, p.text() + "fix integrate all nve/bonded\n" + kDump + "run 0\n", ranks);
  EXPECT_TRUE(r.ok()) << r.screen;
  const Bonds bonds = read_bonds(folder);
  EXPECT_EQ(static_cast<int>(bonds.size()), bonds_installed(r));
  return bonds;
}

constexpr int kAll = 2963;

}  // namespace

TEST(MissingBonds, are_the_share_asked_for_and_the_same_on_any_ranks) {
  EXPECT_EQ(installed("").size(), static_cast<std::size_t>(kAll));
  const Bonds one = installed("missing 0.2 seed 5");
  const double sd = std::sqrt(0.2 * 0.8 * kAll);
  EXPECT_NEAR(kAll - static_cast<double>(one.size()), 0.2 * kAll, 4.0 * sd);
  EXPECT_EQ(keys(one), keys(installed("missing 0.2 seed 5", 2)));
  EXPECT_EQ(keys(one), keys(installed("missing 0.2 seed 5", 4)));
  EXPECT_NE(keys(one), keys(installed("missing 0.2 seed 6")));
}

TEST(MissingBonds, lie_within_the_cone_asked_for) {
  const Bonds all = installed(""), left = installed("missing 1 orientation 0 0 2 30");
  const double least = std::cos(30.0 * 3.14159265358979323846 / 180.0);
  for (const auto &[pair, values] : all)
    EXPECT_EQ(left.count(pair), std::fabs(values[2]) < least ? 1u : 0u) << pair.first << " " << pair.second;
  EXPECT_GT(left.size(), 0.5 * all.size());
}

namespace {

// Two spheres that touch, their bond missing, pressed together at a constant speed.
double force_after(double approach, const std::string &words) {
  EngineFolder folder;
  Preamble p;
  folder.write("two.data", data_file({{0, 0, 0}, {2e-3, 0, 0}}, 3, 0.05));
  p.specimen = "two.data";
  p.install = "gap 1e-5 missing 1 " + words;
  p.contact = "1e9 2.0 0.0";
  p.safety = 0.0;
  const double speed = 1e-3, dt = 1e-7;
  const int steps = static_cast<int>(std::lround(approach / (2.0 * speed * dt)));
  std::ostringstream o;
  o << p.text() << "timestep " << dt << "\ngroup left id 1\ngroup right id 2\nvelocity left set " << speed
    << " 0 0\nvelocity right set " << -speed << " 0 0\nfix left left move linear " << speed
    << " 0 0\nfix right right move linear " << -speed << " 0 0\nrun " << steps << "\n";
  const EngineResult r = run_deck(folder, o.str() + dump_all("end.txt"), 1);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 600 ? r.screen.size() - 600 : 0);
  return read_dump(folder, "end.txt").at(2)[9];
}

}  // namespace

// k of the contact of two equal spheres: 2 R E_c.
TEST(MissingBonds, are_contacts_that_begin_when_the_crack_has_closed) {
  const double k = 2.0 * 1e-3 * 1e9;
  EXPECT_NEAR(force_after(2e-6, ""), k * 2e-6, 1e-6 * k * 2e-6);
  EXPECT_EQ(force_after(2e-6, "open 3e-6"), 0.0);
  EXPECT_NEAR(force_after(5e-6, "open 3e-6"), k * 2e-6, 1e-5 * k * 2e-6);
}

TEST(BondInstall, names_what_it_does_not_understand) {
  const std::pair<const char *, const char *> cases[] = {
      {"missing 1.5", "missing is 1.5, it must be a share between 0 and 1"},
      {"orientation 0 0 0 30", "orientation is 0 0 0, it must be a direction"},
      {"open -1", "open is -1, it must be a distance"},
      {"seed 1.5", "seed is 1.5, it must be a whole number"},
      {"lost 0.1", "unknown word 'lost', allowed are type, missing, orientation, open, seed"},
      {"type 2", "bond type 2 is not between 1 and 1"},
  };
  for (const auto &[words, says] : cases) {
    EngineFolder folder;
    Preamble p = small();
    p.install += std::string(" ") + words;
    const EngineResult r = run_deck(folder, p.text());
    EXPECT_FALSE(r.ok()) << words;
    EXPECT_TRUE(r.says(says)) << words << ": " << r.screen.substr(r.screen.size() > 300 ? r.screen.size() - 300 : 0);
  }
}

class WriteData : public testing::TestWithParam<Law> {};

TEST_P(WriteData, keeps_the_bonds_that_are_left) {
  EngineFolder folder;
  Preamble p = small();
  p.bond_style = GetParam().style;
  p.bond = GetParam().words;
  const std::string start = p.text() + press_small(0.5) + "fix integrate all nve/bonded\nfix damp all damp/local 0.7\n";
  const EngineResult r = run_deck(folder, start + "run 3000\n" + kDump + "run 0\nundump bonds\nwrite_data left.data\nrun 10\n", 2);
  ASSERT_TRUE(r.ok()) << r.screen;
  const Bonds left = read_bonds(folder);
  ASSERT_LT(left.size(), static_cast<std::size_t>(kAll - 100));

  EngineFolder again;
  p.specimen = folder.file("left.data");
  p.install = "data";
  const EngineResult s = run_deck(again, p.text() + "fix integrate all nve/bonded\n" + kDump + "run 0\n", 4);
  ASSERT_TRUE(s.ok()) << s.screen;
  EXPECT_EQ(keys(read_bonds(again)), keys(left));

  // a file with bonds nobody installs would lose them without a word
  EngineFolder refused;
  p.install = "";
  p.safety = 0.0;
  const EngineResult t = run_deck(refused, p.text() + "fix integrate all nve/bonded\nrun 0\n");
  EXPECT_FALSE(t.ok());
  EXPECT_TRUE(t.says("use `bond_install GROUP data`"));
}

INSTANTIATE_TEST_SUITE_P(Laws, WriteData,
                         testing::Values(Law{"parallel", "5e9 2.0 20e6 20e6"}, Law{"beam/mohr/coulomb", "5e9 0.2 20e6 30"},
                                         Law{"norton", "5e9 0.25 20e6 20e6 0 3 rate_at 20 5e6"}));

class BondedLocal : public testing::TestWithParam<Law> {};

// The elastic energy of all rows is what compute energy/bonded says, and fn that of the law.
TEST_P(BondedLocal, agrees_with_the_energy_and_the_law) {
  EngineFolder folder;
  Preamble p = small();
  p.bond_style = GetParam().style;
  p.bond = GetParam().words;
  const std::string deck = p.text() + press_small(0.2) +
                           "fix integrate all nve/bonded\nfix damp all damp/local 0.7\ncompute e all energy/bonded\n"
                           "variable e equal c_e[1]\nfix curve all curve 500 curve.tsv energy J v_e\n"
                           "compute b all bonded/local id1 id2 dist fn energy damage\n"
                           "dump b all local 500 bonds.txt c_b[1] c_b[2] c_b[3] c_b[4] c_b[5] c_b[6]\n"
                           "dump_modify b format \"%.0f %.0f %.17g %.17g %.17g %.17g\"\nrun 500\n";
  const EngineResult r = run_deck(folder, deck, 2);
  ASSERT_TRUE(r.ok()) << r.screen;
  std::istringstream in(folder.read("bonds.txt"));
  std::string line;
  std::map<std::pair<int, int>, double> rest;
  double energy = 0.0;
  int rows = 0, frame = 0;
  bool inside = false;
  while (std::getline(in, line)) {
    if (line.compare(0, 5, "ITEM:") == 0) {
      inside = line.compare(0, 13, "ITEM: ENTRIES") == 0;
      frame += inside;
      continue;
    }
    if (!inside) continue;
    std::istringstream fields(line);
    double a, b, dist, fn, e, damage;
    fields >> a >> b >> dist >> fn >> e >> damage;
    const std::pair<int, int> pair(static_cast<int>(a), static_cast<int>(b));
    EXPECT_LT(pair.first, pair.second);
    EXPECT_EQ(damage, 0.0);
    if (frame == 1) {
      rest[pair] = dist;
      EXPECT_LT(std::fabs(fn), 1e-11);  // the last digit of the distance (2e-19 m) times the stiffness
    } else {
      // pulled bonds are in tension, pressed ones in compression
      if (std::fabs(dist - rest.at(pair)) > 1e-13) { EXPECT_EQ(fn > 0.0, dist > rest.at(pair)); }
      energy += e;
      rows++;
    }
  }
  EXPECT_EQ(rows, kAll);
  const double whole = read_table(folder.file("curve.tsv")).last("energy");
  EXPECT_GT(whole, 0.0);
  EXPECT_NEAR(energy, whole, 1e-12 * whole);
}

INSTANTIATE_TEST_SUITE_P(Laws, BondedLocal,
                         testing::Values(Law{"parallel", "5e9 2.0 1e12 1e12"}, Law{"beam/mohr/coulomb", "5e9 0.2 1e12 30"},
                                         Law{"norton", "5e9 0.25 1e12 1e12 0 3 rate_at 1e-9 5e6"}));
