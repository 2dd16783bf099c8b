// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/anchored_prober.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "diagnose/additive_model_for_tests.h"
#include "diagnose/bench_case.h"
#include "diagnose/row_selection.h"
#include "diagnose/straight_model_for_tests.h"

namespace bondlab::diagnose {
namespace {

class Anchored : public EmulatedModelTest {
 protected:
  // Two and a half times the sizes that are run, where the logarithm of the peak has bent on.
  ModelPoint far() const { return with(engine.start(), "bond_gap", 5); }
  double engine_peak(const ModelPoint &at, double amplitude) const {
    const double now = gap * (1 + amplitude * switch_on("bond_gap"));
    return std::log(engine.physical(at)[sigma_c] * (1 + now / gap_scale)) + 3.5 * by_packing;
  }
};

TEST_F(Anchored, HasTheEnginesRowsAtItsAnchor) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto anchored = emulated.anchored(far(), Anchoring::whole);
  ASSERT_TRUE(anchored);
  const double right = engine_peak(far(), 5);
  EXPECT_GT(std::abs(emulated.probe({far()}).front()(ucs_peak) - right), 0.01);
  EXPECT_NEAR(anchored->probe({far()}).front()(ucs_peak), right, 1e-9);
}

TEST_F(Anchored, TakesTheWayFromThereFromTheEmulator) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto anchored = emulated.anchored(far(), Anchoring::whole);
  ASSERT_TRUE(anchored);
  const auto further = moved(with(engine.start(), "bond_gap", 5.5), sigma_c, 0.1);
  const auto a = anchored->probe({far(), further}), e = emulated.probe({far(), further});
  EXPECT_LT((a[1] - a[0] - (e[1] - e[0])).norm(), 1e-12);
  EXPECT_GT((a[1] - a[0]).norm(), 0.01);
}

TEST_F(Anchored, DoubtIsThatOfTheRunsThere) {
  model.chaos = 0.02;
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto anchored = emulated.anchored(far(), Anchoring::whole);
  ASSERT_TRUE(anchored);
  // Noise at the anchor and at the centre, eight packings, widened by 7/5.
  const double expected = model.chaos * std::sqrt(2.0 / 8 * 7 / 5);
  const double found = std::sqrt(anchored->uncertainty(far())(ucs_peak, ucs_peak));
  EXPECT_GT(found, 0.4 * expected);
  EXPECT_LT(found, 2 * expected);
  EXPECT_GT(emulated.uncertainty(far())(ucs_peak, ucs_peak), 4 * found * found)
      << "the emulator goes on straight with the noise of its knots";
}

TEST_F(Anchored, PlanSaysOnHowManyPackings) {
  plan.anchors = 5;
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  model.batches.clear();
  emulated.anchored(far(), Anchoring::whole);
  ASSERT_EQ(model.batches.size(), 1u);
  EXPECT_EQ(model.batches.front().size(), 2u * 5);  // tests times packings
}

// Rough: those that effects are switched on on. The rest is added where it is worth it.
TEST_F(Anchored, RoughlyTakesFewPackingsAndWhollyTheRest) {
  plan.differences = 5;
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto runs = [&](Anchoring how) {
    const int before = engine.runs();
    emulated.anchored(far(), how);
    return engine.runs() - before;
  };
  EXPECT_EQ(runs(Anchoring::rough), 2 * 5);
  EXPECT_EQ(runs(Anchoring::whole), 2 * (8 - 5));
}

// Thirteen series: seven packings are 91 runs.
TEST_F(Anchored, TakesNoMoreThanAHundredRuns) {
  std::vector<ProbedSeries> many;
  for (int i = 0; i < 13; ++i) {
    many.push_back(series[static_cast<std::size_t>(i % 2)]);
    many.back().name += std::to_string(i);
  }
  ForwardProber wide(study, effects, model, many, {0, 1, 2, 3, 4, 5, 6, 7});
  plan.differences = 4;
  EmulatedProber emulated(wide, catalogue, wide.start(), plan);
  model.batches.clear();
  emulated.anchored(far(), Anchoring::whole);
  ASSERT_EQ(model.batches.size(), 1u);
  std::set<int> packings;
  for (const auto &request : model.batches.front()) packings.insert(request.packing);
  EXPECT_EQ(packings.size(), 7u);
}

TEST_F(Anchored, NoneWhereTheEngineGivesNoRows) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  model.failing = "brazilian";
  EXPECT_EQ(emulated.anchored(far(), Anchoring::whole), nullptr);
  RowSelection some(emulated, {ucs_peak});
  EXPECT_EQ(some.anchored(far(), Anchoring::whole), nullptr);
}

TEST_F(Anchored, SelectionOfRowsIsAnchoredAlike) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  RowSelection some(emulated, {brazilian_peak, ucs_peak});
  const auto anchored = some.anchored(far(), Anchoring::whole);
  ASSERT_TRUE(anchored);
  const auto rows = anchored->probe({far()}).front();
  ASSERT_EQ(rows.size(), 2);
  EXPECT_NEAR(rows(1), engine_peak(far(), 5), 1e-9);
}

// Large effects in twos, on a model that adds up what each does alone.
TEST(DiagnoseAnchored, PairsThatActOnEachOtherAreNamedWhereTheModelIsMadeRight) {
  Bench bench(bench_series({}), 4);
  const std::vector<std::vector<std::size_t>> pairs = {
      {rheology::norton_creep, rheology::frame_compliance},
      {rheology::frame_compliance, rheology::platen_friction},
      {rheology::norton_creep, rheology::pressure_dependence},
      {rheology::softening, rheology::missing_bonds},
      {rheology::tension_compression, rheology::end_parallelism}};
  int added = 0, anchored = 0, cases = 0;
  for (std::uint64_t number = 0; number < 4; ++number)
    for (const auto &pair : pairs) {
      const auto run = bench.run({pair, 40, {}, 1}, number);
      auto &setup = bench.setup(bench.rock_of(number));
      const auto both = [&](bool may) {
        AdditiveModel model(setup.laboratory, setup.laboratory.nominal(), may);
        const auto d =
            diagnose(model, run.evidence, {bench_catalogue(), bench_parameters(), setup.null},
                     setup.laboratory.nominal());
        return d.verdict == Verdict::two && d.effects.size() == 2 &&
               std::min(d.effects[0].effect, d.effects[1].effect) == std::min(pair[0], pair[1]) &&
               std::max(d.effects[0].effect, d.effects[1].effect) == std::max(pair[0], pair[1]);
      };
      added += both(false);
      anchored += both(true);
      ++cases;
    }
  EXPECT_GE(anchored, 0.7 * cases);
  EXPECT_LE(added, 0.5 * cases);  // so the test sees the difference
}

// Counts how often it is made right.
class Counted : public AdditiveModel {
 public:
  using AdditiveModel::AdditiveModel;
  std::unique_ptr<Prober> anchored(const ModelPoint &point, Anchoring how) override {
    ++(how == Anchoring::rough ? rough : whole);
    return AdditiveModel::anchored(point, how);
  }
  int rough = 0, whole = 0;
};

// Two effects at once: one alone leaves something, which few runs of the engine show as well.
TEST(DiagnoseAnchored, OnlyWhatCanStillBeRightIsMadeRightWholly) {
  Bench bench(bench_series({}), 4);
  int rough = 0, whole = 0;
  for (std::uint64_t number = 0; number < 8; ++number) {
    const auto run =
        bench.run({{rheology::norton_creep, rheology::frame_compliance}, 6, {}, 1}, number);
    auto &setup = bench.setup(bench.rock_of(number));
    Counted model(setup.laboratory, setup.laboratory.nominal(), true);
    diagnose(model, run.evidence, {bench_catalogue(), bench_parameters(), setup.null},
             setup.laboratory.nominal());
    rough += model.rough, whole += model.whole;
  }
  EXPECT_GE(whole, 8);
  EXPECT_LE(whole, 0.42 * rough) << whole << " of " << rough;
}

}  // namespace
}  // namespace bondlab::diagnose
