// SPDX-License-Identifier: GPL-2.0-or-later
//
// A run that is cut into pieces, or stopped, written to a file and taken up by another number of
// ranks, ends with the same bits as the run in one piece.
#include <gtest/gtest.h>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

// Strengths scattered, platens that move, damping that amplifies rounding: everything with a memory.
std::string start(bool breaking) {
  Preamble p = small();
  if (breaking) p.bond = "5e9 2.0 20e6 20e6 scatter normal 0.3 0.3 seed 4";
  return p.text();
}

const std::string kFixes = press_small(0.5) +
                           "fix gauge all gauge axial z layers 0.25 0.75 thickness 1e-3 lateral x strip 1e-3\n"
                           "fix integrate all nve/bonded\nfix damp all damp/local 0.7\n"
                           "fix log all bond/log 50 broken.tsv\n"
                           "compute energy all energy/bonded\n";

std::string finish() {
  return dump_all("end.txt") +
         "variable a equal f_top[3]\nvariable b equal f_bottom[1]\nvariable c equal f_gauge[1]\n"
         "variable d equal f_gauge[2]\nvariable e equal c_energy[1]\nvariable g equal f_log[1]\n"
         "fix end all curve 1 last.tsv a N v_a b N v_b c 1 v_c d 1 v_d e J v_e g 1 v_g\nrun 0\n";
}

std::string again(const std::string &file) {
  return "atom_style bonded/sphere\nnewton off\ncommunicate single vel yes\nread_restart " + file +
         "\nneighbor 5e-5 bin\nneigh_modify delay 0\nthermo 100000\nthermo_style custom step time ke\n"
         "thermo_modify lost error\n";
}

struct End {
  std::string particles, values;
  double broken = 0.0, time = 0.0;
};

End run(EngineFolder &folder, const std::string &deck, int ranks) {
  const EngineResult r = run_deck(folder, deck, ranks, {}, 300.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
  End e;
  e.particles = folder.read("end.txt");
  if (folder.has("last.tsv")) {
    const Table t = read_table(folder.file("last.tsv"));
    EXPECT_FALSE(t.rows.empty());
    for (std::size_t c = 0; c < t.names.size(); ++c)
      if (t.names[c] != "time") e.values += t.rows.back()[c] + " ";
    e.broken = t.last("g");
    e.time = t.last("time");
  }
  return e;
}

void expect_same(const End &a, const End &b, const std::string &what) {
  EXPECT_FALSE(a.particles.empty());
  EXPECT_TRUE(a.particles == b.particles) << what << ": particles differ";
  EXPECT_EQ(a.values, b.values) << what;
  EXPECT_NEAR(a.time, b.time, 1e-14 * a.time) << what;  // sums of steps, rounded once a piece
}

}  // namespace

TEST(Restart, run_in_pieces_equals_one_run) {
  EngineFolder one, pieces;
  const End whole = run(one, start(true) + kFixes + "run 5000\n" + finish(), 1);
  EXPECT_GT(whole.broken, 1000);
  const End split = run(pieces, start(true) + kFixes + "run 1\nrun 1233\nrun 0\nrun 766\nrun 3000\n" + finish(), 1);
  expect_same(whole, split, "in pieces");
}

TEST(Restart, at_any_step_on_another_number_of_ranks) {
  EngineFolder one;
  const End whole = run(one, start(true) + kFixes + "restart 2237 state.*\nrun 5000\n" + finish(), 1);
  EXPECT_GT(whole.broken, 1000);
  ASSERT_TRUE(one.has("state.2237"));
  ASSERT_TRUE(one.has("state.4474"));
  const struct {
    int step, ranks;
  } ways[] = {{2237, 1}, {2237, 2}, {4474, 4}};
  for (const auto &w : ways) {
    EngineFolder other;
    const std::string file = one.file("state." + std::to_string(w.step));
    const End end = run(other, again(file) + kFixes + "run " + std::to_string(5000 - w.step) + "\n" + finish(), w.ranks);
    expect_same(whole, end, "from step " + std::to_string(w.step) + " on " + std::to_string(w.ranks) + " ranks");
  }
}

TEST(Restart, written_on_4_ranks_by_command_read_by_1) {
  EngineFolder one, four, back;
  const End whole = run(one, start(true) + kFixes + "run 2500\n" + finish(), 1);
  run(four, start(true) + kFixes + "run 1750\nwrite_restart state\n", 4);
  const End end = run(back, again(four.file("state")) + kFixes + "run 750\n" + finish(), 1);
  expect_same(whole, end, "4 ranks to 1");
}

// Nothing has moved yet: there is no force to go on from, only that of the set-up.
TEST(Restart, written_before_the_first_run) {
  EngineFolder one, first, second;
  const std::string push = "variable vx atom 40*z\nvelocity all set v_vx NULL NULL\n";
  const End whole = run(one, start(false) + push + kFixes + "run 300\n" + dump_all("end.txt"), 1);
  run(first, start(false) + push + "write_restart state\n", 2);
  const End end = run(second, again(first.file("state")) + kFixes + "run 300\n" + dump_all("end.txt"), 1);
  EXPECT_TRUE(whole.particles == end.particles);
}

TEST(Restart, truncated_file_is_an_error) {
  EngineFolder one, other;
  run(one, start(false) + "write_restart state\n", 1);
  const std::string bytes = one.read("state");
  other.write("state", bytes.substr(0, bytes.size() / 3));
  const EngineResult r = run_deck(other, again("state") + "fix integrate all nve/bonded\nrun 1\n", 1, {}, 30.0);
  EXPECT_FALSE(r.ok());
  EXPECT_FALSE(r.timed_out);
}
