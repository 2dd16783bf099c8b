// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/measuring_error.h"

#include <gtest/gtest.h>

namespace bondlab::diagnose {
namespace {

MeasuredRun run(const std::string &kind, const std::string &series, double most) {
  MeasuredRun out{kind, series, {}};
  out.curve.names = {"time", "axial_stress", "force_top", "strain_axial"};
  out.curve.units = {"s", "Pa", "N", "1"};
  out.curve.columns = {{0, 1, 2}, {0, most, most / 2}, {0, 2 * most, most}, {0, 0.1, 0.2}};
  return out;
}

EffectDefinition effect(const std::string &columns, MeasuringRule rule, const std::string &test) {
  EffectDefinition out;
  out.measures.push_back({columns, test, rule, {}});
  return out;
}

TEST(MeasuringError, AGaugeThatReadsLowChangesItsColumnInItsTestOnly) {
  std::vector<MeasuredRun> runs = {run("tension", "a", 10), run("compression", "b", 10)};
  apply_measuring_errors(effect("strain_axial", MeasuringRule::scale, "tension"), -0.1, runs);
  EXPECT_DOUBLE_EQ(runs[0].curve.columns[3][2], 0.18);
  EXPECT_EQ(runs[0].curve.columns[1], run("tension", "a", 10).curve.columns[1]);
  EXPECT_EQ(runs[1].curve.columns, run("compression", "b", 10).curve.columns);
}

TEST(MeasuringError, ALoadCellEndsAtOneLoadForAllSpecimensOfASeries) {
  std::vector<MeasuredRun> runs = {run("tension", "a", 10), run("tension", "a", 7),
                                   run("tension", "b", 20)};
  apply_measuring_errors(effect("loads", MeasuringRule::saturate, ""), 0.2, runs);
  EXPECT_DOUBLE_EQ(runs[0].curve.columns[1][1], 8);
  EXPECT_DOUBLE_EQ(runs[0].curve.columns[1][2], 5);
  EXPECT_DOUBLE_EQ(runs[1].curve.columns[1][1], 7);
  EXPECT_DOUBLE_EQ(runs[2].curve.columns[1][1], 16);
  EXPECT_DOUBLE_EQ(runs[0].curve.columns[2][1], 16);  // N, its own scale
  EXPECT_DOUBLE_EQ(runs[0].curve.columns[3][2], 0.2);
}

TEST(MeasuringError, ADriftGrowsFromNothingInTheFirstTestToItsSizeInTheLast) {
  std::vector<MeasuredRun> runs = {run("x", "a", 10), run("x", "a", 10), run("y", "b", 10)};
  apply_measuring_errors(effect("loads", MeasuringRule::drift, ""), 0.1, runs);
  EXPECT_DOUBLE_EQ(runs[0].curve.columns[1][1], 10);
  EXPECT_DOUBLE_EQ(runs[1].curve.columns[1][1], 10.5);
  EXPECT_DOUBLE_EQ(runs[2].curve.columns[1][1], 11);
  EXPECT_EQ(runs[2].curve.columns[0], run("y", "b", 10).curve.columns[0]);
}

}  // namespace
}  // namespace bondlab::diagnose
