// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/brazilian.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "response/run_quality.h"

namespace bondlab {
namespace {

// The load rises to its peak at 1 s and falls.
Curve splitting_curve() {
  Curve curve;
  curve.names = {"time", "force_top", "force_bottom"};
  curve.columns.resize(3);
  for (int i = 0; i <= 150; ++i) {
    const double load = i <= 100 ? i : 200 - i;
    curve.columns[0].push_back(0.01 * i);
    curve.columns[1].push_back(load);
    curve.columns[2].push_back(load);
  }
  return curve;
}

BrokenBond crack(double time, double x, double y) {
  BrokenBond bond;
  bond.time = time, bond.x = x, bond.y = y;
  return bond;
}

const ResponseContext kDisc{{{"diameter", 0.05}, {"thickness", 1}}};

TEST(Brazilian, FirstCracksAreTheFirstTenthUpToThePeak) {
  std::vector<BrokenBond> events;
  for (int k = 0; k < 8; ++k) events.push_back(crack(0.5, 0.003, 0.004));  // 5 mm: a fifth of the radius
  for (int k = 0; k < 72; ++k) events.push_back(crack(0.9, 0, 0.025));     // at a platen
  for (int k = 0; k < 900; ++k) events.push_back(crack(1.2, 0, 0.025));    // behind the peak
  EXPECT_NEAR(brazilian::first_cracks(splitting_curve(), events, kDisc), 0.2, 1e-12);
  // at least five: 5 of these 9, although a tenth is none
  events.erase(events.begin() + 3, events.end());
  for (int k = 0; k < 6; ++k) events.push_back(crack(0.9, 0, 0.025));
  EXPECT_NEAR(brazilian::first_cracks(splitting_curve(), events, kDisc), (3 * 0.2 + 2 * 1) / 5, 1e-12);
}

TEST(Brazilian, WithoutACrackBeforeThePeakThereIsNoPlace) {
  EXPECT_THROW(brazilian::first_cracks(splitting_curve(), {crack(1.2, 0, 0)}, kDisc), ResponseError);
}

TEST(RunQuality, ASplittingTestSaysWhereItsFirstCracksAre) {
  const TestFolder folder;
  folder.write("broken_bonds.tsv",
               "# bondlab-broken-bonds 1\n# names: "
               "step\ttime\tid1\tid2\ttype\tx\ty\tz\tmode\tsigma\ttau\tsigma_c\ttau_c\n"
               "# units: 1\ts\t1\t1\t1\tm\tm\tm\t1\tPa\tPa\tPa\tPa\n"
               "9\t0.5\t1\t2\t1\t0.003\t0.004\t0\ttension\t1\t0\t1\t1\n");
  TestEntry test;
  test.definition.responses["sigma_t"].function = "brazilian.tensile_strength";
  ForwardOutcome outcome;
  outcome.ok = true;
  outcome.curve = splitting_curve();
  outcome.deck_variables = kDisc.variables;
  outcome.run_directory = folder.path().string();
  EXPECT_NEAR(run_quality(test, outcome).at("first_cracks"), 0.2, 1e-12);
  EXPECT_EQ(run_quality(test, outcome).at("platen_imbalance"), 0);
  outcome.run_directory += "/gone";
  EXPECT_EQ(run_quality(test, outcome).count("first_cracks"), 0u);
  EXPECT_EQ(run_quality(test, outcome).count("platen_imbalance"), 1u);
}

}  // namespace
}  // namespace bondlab
