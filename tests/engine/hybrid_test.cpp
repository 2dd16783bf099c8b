// SPDX-License-Identifier: GPL-2.0-or-later
//
// `bond_style hybrid` of one law with two bond types is that law with two bond types, bit for bit: bonds
// of both types in the same blocks of lanes, breaks and all, on 1 and 2 ranks. All three laws in the same
// blocks each do what they do alone.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

// The packing `small` with two bond types, mixed all over it.
std::string deck(const EngineFolder &folder, bool hybrid, const std::string &options = "") {
  std::ifstream in(data_path("small.data"));
  std::stringstream data;
  data << in.rdbuf();
  std::string text = data.str();
  const std::size_t at = text.find("1 bond types");
  text.replace(at, 1, "2");
  folder.write("two.data", text);
  std::ifstream list(data_path("small.bonds"));
  std::string line, pairs[2];
  while (std::getline(list, line)) {
    std::istringstream fields(line);
    int a, b;
    if (fields >> a >> b) pairs[(a + b) % 3 == 0] += line + "\n";
  }
  folder.write("first.pairs", pairs[0]);
  folder.write("second.pairs", pairs[1]);
  Preamble p = small();
  p.specimen = folder.file("two.data");
  p.bond = "BOND";
  p.install = "file second.pairs type 2";
  std::string all = p.text();
  const std::string own = hybrid ? "parallel " : "";
  const std::string coefficients = "bond_coeff 1 " + own + "5e9 2.0 20e6 20e6 scatter normal 0.3 0.3 seed 4\n" +
                                   "bond_coeff 2 " + own + "3e9 3.0 15e6 12e6 beta 0.5" + options + "\n" +
                                   "bond_install all file first.pairs type 1\n";
  const std::size_t words = all.find("bond_coeff 1 BOND\n");
  all.replace(words, std::string("bond_coeff 1 BOND\n").size(), coefficients);
  if (hybrid) all.replace(all.find("bond_style parallel"), 19, "bond_style hybrid parallel");
  return all + press_small(1.0) + "fix integrate all nve/bonded\nfix damp all damp/local 0.7\nfix log all bond/log 100 broken.tsv\n"
         "compute e all energy/bonded\nvariable b equal c_e[1]\nvariable c equal c_e[2]\nvariable l equal c_e[5]\n"
         "fix curve all curve 100 curve.tsv b J v_b c J v_c l J v_l\nrun 2500\n" + dump_all("end.txt");
}

void compare(const std::string &options) {
  EngineFolder plain, hybrid, two;
  const EngineResult a = run_deck(plain, deck(plain, false, options)), b = run_deck(hybrid, deck(hybrid, true, options)),
                     c = run_deck(two, deck(two, true, options), 2);
  for (const EngineResult *r : {&a, &b, &c}) ASSERT_TRUE(r->ok()) << r->screen.substr(0, 3000);
  const std::size_t broken = read_table(plain.file("broken.tsv")).rows.size();
  EXPECT_GT(broken, 50u);
  for (const EngineFolder *other : {&hybrid, &two})
    for (const char *file : {"end.txt", "broken.tsv", "curve.tsv"}) {
      EXPECT_FALSE(plain.read(file).empty());
      EXPECT_TRUE(plain.read(file) == other->read(file)) << file << (other == &two ? " on 2 ranks" : "");
    }
}

}  // namespace

TEST(Hybrid, of_one_law_is_that_law) { compare(""); }

TEST(Hybrid, options_of_one_type_leave_the_other_alone) { compare(" softening 40 damping 0.1 contact no"); }

namespace {

const Law kLaws[] = {{"parallel", "5e9 2.0 20e6 20e6 softening 20"},
                     {"beam/mohr/coulomb", "5e9 0.2 20e6 30 friction 0.4"},
                     {"norton", "5e9 0.25 15e6 15e6 0 3 rate_at 20 5e6"}};

// `small` with the bonds of law k = 0, 1, 2 where (a + b) % 3 is k; all laws, or one of them alone.
std::string three(const EngineFolder &folder, int only = -1, bool moving = false) {
  std::ifstream in(data_path("small.data"));
  std::stringstream data;
  data << in.rdbuf();
  std::string text = data.str();
  text.replace(text.find("1 bond types"), 1, "3");
  std::ostringstream velocities;  // of each grain its own; only nve/noforce keeps them
  for (int id = 1; id <= 893; ++id)
    velocities << id << " " << 0.8 * std::sin(11.0 * id) << " " << 0.8 * std::cos(7.0 * id) << " " << 0.8 * std::sin(3.0 * id)
               << " " << 400 * std::cos(5.0 * id) << " " << 400 * std::sin(13.0 * id) << " " << 400 * std::cos(17.0 * id) << "\n";
  folder.write("three.data", text + (moving ? "\nVelocities\n\n" + velocities.str() : ""));
  std::ifstream list(data_path("small.bonds"));
  std::string line, pairs[3];
  while (std::getline(list, line)) {
    std::istringstream fields(line);
    int a, b;
    if (fields >> a >> b) pairs[(a + b) % 3] += line + "\n";
  }
  Preamble p = small();
  p.specimen = folder.file("three.data");
  p.bond = "BOND";
  p.install = "";
  p.safety = 0.0;
  p.bond_style = only < 0 ? "hybrid parallel beam/mohr/coulomb norton" : kLaws[only].style;
  std::string all = p.text(), words;
  for (int k = 0; k < 3; ++k) {
    const Law &law = only < 0 ? kLaws[k] : kLaws[only];
    words += "bond_coeff " + std::to_string(k + 1) + " " + (only < 0 ? std::string(law.style) + " " : "") + law.words + "\n";
  }
  for (int k = 0; k < 3; ++k)
    if (only < 0 || only == k) {
      folder.write(std::to_string(k) + ".pairs", pairs[k]);
      words += "bond_install all file " + std::to_string(k) + ".pairs type " + std::to_string(k + 1) + "\n";
    }
  const std::string place = "bond_coeff 1 BOND\n";
  return all.replace(all.find(place), place.size(), words);
}

std::map<std::string, std::string> values_of_bonds(const EngineFolder &folder) {
  std::istringstream in(folder.read("bonds.txt"));
  std::map<std::string, std::string> rows;
  std::string line, a, b, rest;
  bool inside = false;
  while (std::getline(in, line)) {
    if (line.compare(0, 5, "ITEM:") == 0) {
      inside = line.compare(0, 13, "ITEM: ENTRIES") == 0;
      continue;
    }
    std::istringstream fields(line);
    if (inside && fields >> a >> b && std::getline(fields, rest)) rows[a + " " + b] = rest;
  }
  return rows;
}

}  // namespace

// All grains are moved the same way, whatever the bonds say: then every bond carries what it carries alone.
TEST(HybridOfThree, each_law_does_what_it_does_alone) {
  const std::string moved =
      "timestep 1e-8\ncompute b all bonded/local id1 id2 dist fn fs mb mt sigma tau damage energy\n"
      "fix move all nve/noforce\nrun 200\n"
      "dump b all local 1 bonds.txt c_b[1] c_b[2] c_b[3] c_b[4] c_b[5] c_b[6] c_b[7] c_b[8] c_b[9] c_b[10] c_b[11]\n"
      "dump_modify b format \"%.0f %.0f %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\"\nrun 0\n";
  EngineFolder together;
  const EngineResult r = run_deck(together, three(together, -1, true) + moved, 1);
  ASSERT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
  const auto all = values_of_bonds(together);
  std::size_t found = 0;
  std::set<std::string> different;  // values that are those of one bond alone
  for (int k = 0; k < 3; ++k) {
    EngineFolder alone;
    const EngineResult one = run_deck(alone, three(alone, k, true) + moved, 1);
    ASSERT_TRUE(one.ok()) << one.screen.substr(one.screen.size() > 1500 ? one.screen.size() - 1500 : 0);
    for (const auto &[pair, values] : values_of_bonds(alone)) {
      ASSERT_TRUE(all.count(pair)) << pair;
      EXPECT_EQ(all.at(pair), values) << kLaws[k].style << " " << pair;
      found++;
      different.insert(values);
    }
  }
  EXPECT_EQ(found, all.size());
  EXPECT_GT(different.size(), found / 2);
}

TEST(HybridOfThree, breaking_is_the_same_on_1_2_and_4) {
  const std::string then = "timestep_bonded 0.8\n" + press_small(1.0) +
                           "fix integrate all nve/bonded\nfix damp all damp/local 0.7\nfix log all bond/log 100 broken.tsv\n"
                           "run 2500\n" + dump_all("end.txt");
  EngineFolder one;
  const EngineResult a = run_deck(one, three(one) + then, 1);
  ASSERT_TRUE(a.ok()) << a.screen.substr(a.screen.size() > 1500 ? a.screen.size() - 1500 : 0);
  EXPECT_GT(read_table(one.file("broken.tsv")).rows.size(), 50u);
  for (const int ranks : {2, 4}) {
    EngineFolder other;
    const EngineResult b = run_deck(other, three(other) + then, ranks);
    ASSERT_TRUE(b.ok());
    EXPECT_TRUE(one.read("end.txt") == other.read("end.txt")) << ranks;
    EXPECT_TRUE(one.read("broken.tsv") == other.read("broken.tsv")) << ranks;
  }
}
