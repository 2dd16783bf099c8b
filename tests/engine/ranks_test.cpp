// SPDX-License-Identifier: GPL-2.0-or-later
//
// The number of ranks, the rebuilds of the neighbour list and the way a run is cut into pieces change
// no bit of what comes out: positions, velocities, forces, platen forces, the log of breaks.
#include <gtest/gtest.h>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

const char *kCurve =
    "compute energy all energy/bonded\n"
    "variable top equal f_top[3]\nvariable side equal f_bottom[1]\nvariable strain equal c_energy[1]\n"
    "fix curve all curve 100 curve.tsv top N v_top side N v_side strain J v_strain\n"
    "fix log all bond/log 100 broken.tsv\n";

struct Outcome {
  std::string particles, curve, broken;
  int breaks = 0;
};

Outcome run(const std::string &deck, int ranks) {
  EngineFolder folder;
  const EngineResult r = run_deck(folder, deck, ranks, {}, 300.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1000 ? r.screen.size() - 1000 : 0);
  Outcome o{folder.read("end.txt"), folder.read("curve.tsv"), folder.read("broken.tsv"), 0};
  EXPECT_FALSE(o.particles.empty());
  EXPECT_FALSE(o.curve.empty());
  if (folder.has("broken.tsv"))
    o.breaks = static_cast<int>(read_table(folder.file("broken.tsv")).rows.size());
  return o;
}

void expect_same(const Outcome &a, const Outcome &b, const std::string &what) {
  EXPECT_TRUE(a.particles == b.particles) << what << ": particles differ";
  EXPECT_TRUE(a.curve == b.curve) << what << ": curves differ";
  EXPECT_TRUE(a.broken == b.broken) << what << ": broken bonds differ";
}

std::string elastic(int steps) {
  return small().text() + press_small(0.2) +
         "fix integrate all nve/bonded\nfix damp all damp/local 0.7\n" + kCurve +
         "run " + std::to_string(steps) + "\n" + dump_all("end.txt");
}

// Strong enough a push that hundreds of bonds break and grains slide, strengths scattered.
std::string breaking(int steps, const std::string &neighbour = "delay 0", double damping = 0.7) {
  Preamble p = small();
  p.neighbour = neighbour;
  p.bond = "5e9 2.0 20e6 20e6 scatter normal 0.3 0.3 seed 4";
  return p.text() + press_small(0.5) + "fix integrate all nve/bonded\nfix damp all damp/local " +
         std::to_string(damping) + "\n" + kCurve + "run " + std::to_string(steps) + "\n" +
         dump_all("end.txt");
}

}  // namespace

TEST(Ranks, elastic_compression_with_damping_is_the_same_on_1_2_and_4) {
  const Outcome one = run(elastic(8000), 1);
  EXPECT_EQ(one.breaks, 0);
  expect_same(one, run(elastic(8000), 2), "2 ranks");
  expect_same(one, run(elastic(8000), 4), "4 ranks");
}

TEST(Ranks, breaking_and_sliding_is_the_same_on_1_2_and_4) {
  const Outcome one = run(breaking(8000), 1);
  EXPECT_GT(one.breaks, 1000);
  expect_same(one, run(breaking(8000), 2), "2 ranks");
  expect_same(one, run(breaking(8000), 4), "4 ranks");
}

TEST(Ranks, rebuilding_the_neighbour_list_at_every_step_changes_nothing) {
  const Outcome rarely = run(breaking(6000), 1);
  EXPECT_GT(rarely.breaks, 1000);
  expect_same(rarely, run(breaking(6000, "delay 0 every 1 check no"), 2), "rebuilt at every step");
}
