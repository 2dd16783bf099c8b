// SPDX-License-Identifier: GPL-2.0-or-later
//
// `bond_style hybrid` of one law with two bond types is that law with two bond types, bit for bit: bonds
// of both types in the same blocks of lanes, breaks and all, on 1 and 2 ranks.
#include <gtest/gtest.h>

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
  const EngineResult a = run_deck(plain, deck(plain, false, options), 0), b = run_deck(hybrid, deck(hybrid, true, options), 0),
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
