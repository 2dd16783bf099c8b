// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/cross_gap.h"

#include <gtest/gtest.h>

#include "diagnose/bench_case.h"

namespace bondlab::diagnose {
namespace {

CrossGap gap_of(Bench &bench, const BenchRun &run, std::uint64_t number) {
  auto &laboratory = bench.setup(bench.rock_of(number)).laboratory;
  return cross_gap(laboratory, laboratory, run.evidence, bench_catalogue(), run.diagnosis, 1);
}

TEST(CrossGap, RightEffectPredictsSeriesThatItWasNotFittedTo) {
  Bench bench(bench_series({}), 1);
  const auto run = bench.run({{rheology::norton_creep}, 15, {}, 1}, 1);
  ASSERT_EQ(run.diagnosis.verdict, Verdict::one);
  const auto gap = gap_of(bench, run, 1);
  EXPECT_GT(gap.closed(), 0.7);
  EXPECT_LT(gap.closed_by_placebo(), 0.1);
  EXPECT_GT(gap.before, gap.floor);
}

TEST(CrossGap, WrongEffectDoesNot) {
  Bench bench(bench_series({}), 1);
  auto run = bench.run({{rheology::norton_creep}, 15, {}, 1}, 1);
  auto &laboratory = bench.setup(bench.rock_of(1)).laboratory;
  const Whitening whitening(run.evidence);
  run.diagnosis.after =
      refit(laboratory, whitening, bench_catalogue(), run.diagnosis.model, {rheology::weibull});
  EXPECT_LT(gap_of(bench, run, 1).closed(), 0.4);
}

TEST(CrossGap, NothingNamedClosesNothing) {
  Bench bench(bench_series({}), 1);
  auto run = bench.run({{rheology::norton_creep}, 15, {}, 1}, 1);
  run.diagnosis.after = run.diagnosis.before;
  const auto gap = gap_of(bench, run, 1);
  EXPECT_NEAR(gap.before, gap.after, 1e-9 * gap.before);
  EXPECT_EQ(gap.placebo, 0);
}

}  // namespace
}  // namespace bondlab::diagnose
