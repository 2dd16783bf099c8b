// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/measured_cost.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"

namespace bondlab {
namespace {

TEST(MeasuredCost, sums_the_run_commands_of_a_deck) {
  const TestFolder folder;
  folder.write("log.bondlab",
               "LIGGGHTS\n  1226 bonds installed, 2.140 a particle\n"
               "Loop time of 0.25 on 2 procs for 1000 steps with 573 atoms\nrun 3000\n"
               "Loop time of 0.75 on 2 procs for 3000 steps with 573 atoms, at 3 steps/s\n");
  const auto cost = measured_cost(folder.path());
  ASSERT_TRUE(cost);
  EXPECT_DOUBLE_EQ(cost->loop_seconds, 1);
  EXPECT_DOUBLE_EQ(cost->steps, 4000);
  EXPECT_DOUBLE_EQ(cost->particles, 573);
  EXPECT_DOUBLE_EQ(cost->bonds, 1226);
  EXPECT_EQ(cost->ranks, 2);
  EXPECT_NEAR(cost->ns_per_bond_and_step(), 1e9 / 4000 / 1226, 1e-9);
  EXPECT_EQ(cost_text(*cost),
            "4000 steps, 573 particles, 1226 bonds, 204 ns a bond and step on 2 ranks");
}

TEST(MeasuredCost, is_nothing_without_a_finished_run_command) {
  const TestFolder folder;
  EXPECT_FALSE(measured_cost(folder.path()));
  folder.write("log.bondlab", "LIGGGHTS\n  1226 bonds installed, 2.140 a particle\n");
  EXPECT_FALSE(measured_cost(folder.path()));
  folder.write("log.bondlab", "Loop time of 0.5 on 1 procs for 10 steps with 3 atoms\n");
  const auto cost = measured_cost(folder.path());
  ASSERT_TRUE(cost);
  EXPECT_EQ(cost->ns_per_bond_and_step(), 0);
  EXPECT_EQ(cost_text(*cost), "10 steps, 3 particles, 0 bonds");
}

}  // namespace
}  // namespace bondlab
