// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/evaluator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refine/emulator_for_tests.h"

namespace bondlab {
namespace {

using testing::granite_law;
using testing::granite_study;
using testing::GraniteEmulator;

struct Bench {
  Study study = granite_study();
  GraniteEmulator model;
  ParameterSpace space{study.parameters};
  Evaluator evaluator{study, space, model};
  TransformedPoint at(double u) const {
    return space.to_transformed(space.from_unit_cube({u, u, u}));
  }
};

TEST(Evaluator, GivesTheFiguresOfTheCurves) {
  Bench bench;
  const auto point = bench.at(0.4);
  bench.evaluator.run({point}, {0, 1, 2, 3}, "design");
  const auto x = bench.space.to_physical(point).x;
  const auto f = granite_law(x[0], x[1], x[2]);
  const double expected[] = {f.E, f.nu, f.UCS, f.sigma_t};
  for (std::size_t t = 0; t < 4; ++t)
    EXPECT_NEAR(bench.evaluator.value(point, t).value / expected[t], 1, 1e-9)
        << bench.study.targets[t].name;
}

TEST(Evaluator, OneBatchForAllAndNothingTwice) {
  Bench bench;
  const std::vector<TransformedPoint> points{bench.at(0.2), bench.at(0.5), bench.at(0.2)};
  bench.evaluator.run(points, {0, 1, 2},
                      "design");  // three targets of one test, two different points
  EXPECT_EQ(bench.model.batches, 1);
  EXPECT_EQ(bench.model.runs, 2);
  bench.evaluator.run(points, {0, 1, 2, 3}, "design");  // the other test only
  EXPECT_EQ(bench.model.batches, 2);
  EXPECT_EQ(bench.model.runs, 4);
  bench.evaluator.run(points, {3}, "design");
  EXPECT_EQ(bench.model.batches, 2);
  EXPECT_EQ(bench.model.repeated, 0);
  EXPECT_EQ(bench.evaluator.counts().forward, 4);
  EXPECT_EQ(bench.evaluator.points().size(), 2u);
}

TEST(Evaluator, PackingsAreKeptApartAndOutOfTheLedger) {
  Bench bench;
  bench.model.packing_scatter = 0.05;
  const auto point = bench.at(0.5);
  bench.evaluator.run({point}, std::vector<int>{0, 1, 2}, {2}, "packings");
  EXPECT_EQ(bench.model.batches, 1);
  EXPECT_EQ(bench.model.runs, 3);
  EXPECT_NE(bench.evaluator.value(point, 2, 0).value, bench.evaluator.value(point, 2, 1).value);
  bench.evaluator.run({bench.at(0.7)}, {2}, "packings", 1);  // on another packing only
  EXPECT_EQ(bench.evaluator.ledger().size(), 1u);
  EXPECT_EQ(bench.evaluator.ledger()[0].responses.count("UCS"), 1u);
  EXPECT_EQ(bench.evaluator.ledger()[0].responses.count("sigma_t"), 0u);
}

TEST(Evaluator, FailedRunIsAValueWithItsReason) {
  Bench bench;
  bench.model.fail = [](const ForwardRequest &request) {
    return request.test == "ucs" ? FailureCause::lost_atoms : FailureCause::none;
  };
  const auto point = bench.at(0.5);
  bench.evaluator.run({point}, {0, 3}, "design");
  EXPECT_FALSE(bench.evaluator.value(point, 0).had());
  EXPECT_NE(bench.evaluator.value(point, 0).why.find("planted failure"), std::string::npos);
  EXPECT_TRUE(bench.evaluator.value(point, 3).had());
  EXPECT_FALSE(bench.evaluator.complete(point, {0, 3}));
  EXPECT_TRUE(bench.evaluator.complete(point, {3}));
  EXPECT_EQ(bench.evaluator.counts().failed, 1);
}

TEST(Evaluator, PointThatWasNotRunSaysSo) {
  Bench bench;
  EXPECT_EQ(bench.evaluator.value(bench.at(0.5), 0).why, "not run");
  EXPECT_EQ(bench.evaluator.outcome(bench.at(0.5), "ucs"), nullptr);
}

}  // namespace
}  // namespace bondlab
