// SPDX-License-Identifier: GPL-2.0-or-later
//
// The fixes together in a small compression test of bonded discs: the same bits on any number of
// ranks, and after a restart.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "fixes_deck.h"

namespace {

using namespace engine;

constexpr double radius = 1e-3;

void write_brick(const EngineFolder &folder) {
  folder.write("particles.data", data_file(brick(8, 12, radius), 2, 0.03));
}

// "" if there is none; else the two lines.
std::string first_difference(const std::string &a, const std::string &b) {
  std::istringstream left(a), right(b);
  std::string l, r;
  for (;;) {
    const bool more_left = static_cast<bool>(std::getline(left, l));
    const bool more_right = static_cast<bool>(std::getline(right, r));
    if (!more_left && !more_right) return "";
    if (l != r || more_left != more_right) return "now:      " + l + "\nexpected: " + r;
  }
}

// Without the thermo lines and times of the log, tables are all there is to compare.
std::string tables(const EngineFolder &folder) {
  return folder.read("curve.tsv") + folder.read("broken_bonds.tsv");
}

TEST(Compression, BreaksAndStaysInBalance) {
  EngineFolder folder;
  write_brick(folder);
  CompressionDeck deck;
  deck.run = "run 6000\n";
  const EngineResult r = run_deck(folder, deck.text());
  ASSERT_TRUE(r.ok()) << r.screen;
  const Table curve = read_table(folder.file("curve.tsv"));
  EXPECT_EQ(curve.completion, "end_of_run");
  ASSERT_EQ(curve.rows.size(), 121u);
  EXPECT_NEAR(curve.column("force_top").front(), 0.0, 1e-9);  // touches, doesn't press
  EXPECT_EQ(curve.column("axial").front(), 0.0);
  EXPECT_GT(curve.last("axial"), 0.0);
  EXPECT_GT(curve.last("lateral"), 0.0);

  const Table log = read_table(folder.file("broken_bonds.tsv"));
  EXPECT_EQ(log.kind, "bondlab-broken-bonds 1");
  EXPECT_EQ(log.completion, "end_of_run");
  ASSERT_GT(log.rows.size(), 5u);  // else this test shows nothing about breaks
  EXPECT_EQ(curve.last("broken"), static_cast<double>(log.rows.size()));
  int tension = 0;
  const auto steps = log.column("step"), time = log.column("time"), sigma = log.column("sigma"),
             sigma_c = log.column("sigma_c"), tau = log.column("tau"), tau_c = log.column("tau_c"),
             id1 = log.column("id1"), id2 = log.column("id2");
  for (std::size_t k = 0; k < log.rows.size(); ++k) {
    const bool in_tension = log.rows[k][8] == "tension";
    tension += in_tension;
    EXPECT_LT(id1[k], id2[k]);
    EXPECT_NEAR(time[k], steps[k] * 2e-7, 1e-15);
    EXPECT_GE(in_tension ? sigma[k] - sigma_c[k] : tau[k] - tau_c[k], 0.0);
    EXPECT_GE(steps[k], steps[k ? k - 1 : 0]);
  }
  EXPECT_EQ(curve.last("tension"), tension);
}

TEST(Compression, RanksGiveTheSameBits) {
  std::string one;
  for (int ranks : {1, 2, 4}) {
    EngineFolder folder;
    write_brick(folder);
    CompressionDeck deck;
    deck.run = "run 6000\n";
    const EngineResult r = run_deck(folder, deck.text(), ranks);
    ASSERT_TRUE(r.ok()) << ranks << " ranks\n" << r.screen;
    if (ranks == 1) one = tables(folder);
    ASSERT_GT(one.size(), 1000u);
    EXPECT_EQ(first_difference(tables(folder), one), "") << ranks << " ranks";
  }
}

TEST(Compression, RestartedRunLeavesTheFilesOfTheUninterruptedOne) {
  const std::string data = "read_data particles.data\nreset_timestep 700\n";  // clocks start late
  EngineFolder whole;
  write_brick(whole);
  CompressionDeck deck;
  deck.start = data;
  deck.run = "run 6000\n";
  ASSERT_TRUE(run_deck(whole, deck.text()).ok());

  EngineFolder parts;
  write_brick(parts);
  CompressionDeck first;  // a restart, then rows that the restarted run must replace
  first.start = data;
  first.run = "run 3270\nwrite_restart middle.restart\nrun 500\n";
  EngineResult r = run_deck(parts, first.text(), 2);
  ASSERT_TRUE(r.ok()) << r.screen;
  CompressionDeck second;
  second.start = "read_restart middle.restart\n";
  second.install = "";
  second.append = "append";
  second.run = "run 2730\n";
  r = run_deck(parts, second.text(), 1);
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_EQ(first_difference(tables(parts), tables(whole)), "");
}

TEST(Compression, RunInTwoPartsIsTheRunInOne) {
  std::string one;
  for (const std::string run : {"run 6000\n", "run 1234\nrun 4766\n"}) {
    EngineFolder folder;
    write_brick(folder);
    CompressionDeck deck;
    deck.run = run;
    const EngineResult r = run_deck(folder, deck.text());
    ASSERT_TRUE(r.ok()) << r.screen;
    if (one.empty()) one = tables(folder);
    EXPECT_EQ(first_difference(tables(folder), one), "") << run;
  }
}

}  // namespace
