// SPDX-License-Identifier: GPL-2.0-or-later
//
// fix curve, fix stop/peak and fix bond/log: what is in the files, and when they call themselves
// complete.
#include <gtest/gtest.h>

#include <cmath>

#include "fixes_deck.h"

namespace {

using namespace engine;

// A load that rises to 100 at step 100 and falls again, with nothing in it but the step.
std::string triangle(const EngineFolder &folder) {
  folder.write("particles.data", data_file({{0, 0, 0}}, 3, 0.01));
  return few_particles(3, 0.5) +
         "variable load equal 100-abs(step-100)\n"
         "variable strain equal step*1e-4\n";
}

TEST(FixCurve, WritesNamesUnitsAndValues) {
  EngineFolder folder;
  const EngineResult r = run_deck(folder,
                                  triangle(folder) +
                                      "compute k all ke\n"
                                      "fix c all curve 20 curve.tsv load kN v_load k J c_k\n"
                                      "run 50\n",
                                  2);
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_EQ(folder.read("curve.tsv"),
            "# bondlab-curve 1\n# names: step\ttime\tload\tk\n# units: 1\ts\tkN\tJ\n"
            "0\t0\t0\t0\n20\t10\t20\t0\n40\t20\t40\t0\n# complete: end_of_run\n");
}

TEST(FixCurve, LaterRunsGoOnAndOnlyTheLastLineSaysComplete) {
  EngineFolder folder;
  const EngineResult r = run_deck(folder, triangle(folder) +
                                              "fix c all curve 20 curve.tsv load N v_load\n"
                                              "run 50\nrun 30\nrun 10\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  const Table t = read_table(folder.file("curve.tsv"));
  EXPECT_EQ(t.column("step"), (std::vector<double>{0, 20, 40, 60, 80}));
  EXPECT_EQ(t.completion, "end_of_run");
  const std::string text = folder.read("curve.tsv");
  EXPECT_EQ(text.find("# complete"), text.rfind("# complete"));
}

TEST(FixCurve, AKilledRunIsNotComplete) {
  EngineFolder folder;
  const EngineResult r = run_deck(folder,
                                  triangle(folder) +
                                      "fix c all curve 20 curve.tsv load N v_load\n"
                                      "run 2000000000\n",
                                  1, {}, 2.0);
  EXPECT_TRUE(r.timed_out);
  EXPECT_NE(r.status, 0);
  const Table t = read_table(folder.file("curve.tsv"));
  EXPECT_GT(t.rows.size(), 5u);
  EXPECT_EQ(t.completion, "");
}

TEST(FixCurve, NotANumberNamesColumnAndStep) {
  EngineFolder folder;
  const EngineResult r =
      run_deck(folder, triangle(folder) +
                           "variable big equal exp(20*step)\nvariable bad equal v_big-v_big\n"
                           "fix c all curve 20 curve.tsv load N v_load odd 1 v_bad\nrun 100\n");
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("Fix curve (id c): column 'odd' (v_bad) is") && r.says("at step 40"))
      << r.screen;
  const Table t = read_table(folder.file("curve.tsv"));
  EXPECT_EQ(t.rows.size(), 2u);
  EXPECT_EQ(t.completion, "");
}

TEST(FixCurve, AppendReplacesRowsBeyondTheRestart) {
  EngineFolder folder;
  const std::string fix = "fix c all curve 20 curve.tsv load N v_load ";
  const std::string deck = triangle(folder);
  ASSERT_TRUE(run_deck(folder, deck + fix + "\nrun 50\nwrite_restart r\nrun 40\n").ok());
  const std::string restart =
      "newton off\nread_restart r\nneighbor 0.001 bin\npair_style grain\npair_coeff * * 1e9 2 0.5\n"
      "timestep 0.5\nvariable load equal 1000+step\n";
  EngineResult r = run_deck(folder, restart + fix + "append\nrun 30\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  const Table t = read_table(folder.file("curve.tsv"));
  EXPECT_EQ(t.column("step"), (std::vector<double>{0, 20, 40, 60, 80}));
  EXPECT_EQ(t.column("load"), (std::vector<double>{0, 20, 40, 1060, 1080}));
  // Another set of columns is refused, and the file left alone.
  const std::string before = folder.read("curve.tsv");
  r = run_deck(folder, restart + "fix c all curve 20 curve.tsv other N v_load append\nrun 30\n");
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("can't be gone on with")) << r.screen;
  EXPECT_EQ(folder.read("curve.tsv"), before);
}

TEST(FixCurve, AFileThatCannotBeWrittenIsAnError) {
  EngineFolder folder;
  const EngineResult r = run_deck(
      folder, triangle(folder) + "fix c all curve 20 absent/curve.tsv load N v_load\nrun 50\n", 2);
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("absent/curve.tsv") && r.says("No such file")) << r.screen;
}

TEST(FixStopPeak, StopsAfterTheDropAndTheDeckGoesOn) {
  EngineFolder folder;
  for (int ranks : {1, 2}) {
    const EngineResult r =
        run_deck(folder,
                 triangle(folder) +
                     "fix s all stop/peak 10 v_load drop 0.3 min 50\n"
                     "fix c all curve 10 curve.tsv load N v_load peak N f_s[1] stopped 1 f_s[2]\n"
                     "run 1000\nvariable at equal step\nprint \"stopped at ${at}\"\n"
                     "unfix c\nrun 25\nprint \"then at ${at}\"\n",
                 ranks);
    ASSERT_TRUE(r.ok()) << r.screen;
    // 100 - (step - 100) < 70 first holds at step 140.
    EXPECT_TRUE(r.says("stopped at 140")) << r.screen;
    EXPECT_TRUE(r.says("then at 165")) << r.screen;
    const Table t = read_table(folder.file("curve.tsv"));
    EXPECT_EQ(t.completion, "stop_after_peak");
    EXPECT_EQ(t.last("step"), 140);
    EXPECT_EQ(t.last("peak"), 100);
  }
}

TEST(FixStopPeak, StopsAtTheLimit) {
  EngineFolder folder;
  const EngineResult r =
      run_deck(folder, triangle(folder) +
                           "fix s all stop/peak 10 v_load drop 0.3 min 50 max_abs v_strain 0.0065\n"
                           "fix c all curve 10 curve.tsv load N v_load\nrun 1000\n"
                           "variable flag equal f_s[2]\nprint \"flag ${flag}\"\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_TRUE(r.says("flag 2"));
  const Table t = read_table(folder.file("curve.tsv"));
  EXPECT_EQ(t.completion, "stop_at_limit");
  EXPECT_EQ(t.last("step"), 70);
}

TEST(FixStopPeak, NeverReachedLetsTheRunEnd) {
  EngineFolder folder;
  const EngineResult r =
      run_deck(folder, triangle(folder) +
                           "fix s all stop/peak 10 v_load drop 0.3 min 500\n"
                           "fix c all curve 10 curve.tsv load N v_load\nrun 160\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_EQ(read_table(folder.file("curve.tsv")).completion, "end_of_run");
}

TEST(FixStopPeak, ThePeakIsRestarted) {
  EngineFolder folder;
  const std::string fixes =
      "fix s all stop/peak 10 v_load drop 0.3 min 50\n"
      "fix c all curve 10 curve.tsv load N v_load append\n";
  ASSERT_TRUE(run_deck(folder, triangle(folder) + fixes + "run 120\nwrite_restart r\n").ok());
  const EngineResult r =
      run_deck(folder,
               "newton off\nread_restart r\nneighbor 0.001 bin\npair_style grain\n"
               "pair_coeff * * 1e9 2 0.5\ntimestep 0.5\nvariable load equal 100-abs(step-100)\n" +
                   fixes + "run 1000\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  const Table t = read_table(folder.file("curve.tsv"));
  EXPECT_EQ(t.last("step"), 140);  // without the old peak of 100: 80 at 120, below 56 at 150
  EXPECT_EQ(t.completion, "stop_after_peak");
}

TEST(FixBondLog, TruncatedRunHasNoLastLine) {
  EngineFolder folder;
  folder.write("particles.data", data_file(brick(8, 12, 1e-3), 2, 0.03));
  CompressionDeck deck;
  deck.run =
      "variable big equal exp((step-5000))\n"
      "fix guard all curve 50 guard.tsv big 1 v_big\nrun 6000\n";
  const EngineResult r = run_deck(folder, deck.text());
  EXPECT_NE(r.status, 0);
  const Table t = read_table(folder.file("broken_bonds.tsv"));
  EXPECT_GT(t.rows.size(), 5u);
  EXPECT_EQ(t.completion, "");
}

}  // namespace
