// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/anchored_prober.h"

#include <gtest/gtest.h>

#include <cmath>

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
  const auto anchored = emulated.anchored(far());
  ASSERT_TRUE(anchored);
  const double right = engine_peak(far(), 5);
  EXPECT_GT(std::abs(emulated.probe({far()}).front()(ucs_peak) - right), 0.01);
  EXPECT_NEAR(anchored->probe({far()}).front()(ucs_peak), right, 1e-9);
}

TEST_F(Anchored, TakesTheWayFromThereFromTheEmulator) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto anchored = emulated.anchored(far());
  ASSERT_TRUE(anchored);
  const auto further = moved(with(engine.start(), "bond_gap", 5.5), sigma_c, 0.1);
  const auto a = anchored->probe({far(), further}), e = emulated.probe({far(), further});
  EXPECT_LT((a[1] - a[0] - (e[1] - e[0])).norm(), 1e-12);
  EXPECT_GT((a[1] - a[0]).norm(), 0.01);
}

TEST_F(Anchored, DoubtIsThatOfTheRunsThere) {
  model.chaos = 0.02;
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  const auto anchored = emulated.anchored(far());
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
  emulated.anchored(far());
  ASSERT_EQ(model.batches.size(), 1u);
  EXPECT_EQ(model.batches.front().size(), 2u * 5);  // tests times packings
}

TEST_F(Anchored, NoneWhereTheEngineGivesNoRows) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  model.failing = "brazilian";
  EXPECT_EQ(emulated.anchored(far()), nullptr);
  RowSelection some(emulated, {ucs_peak});
  EXPECT_EQ(some.anchored(far()), nullptr);
}

TEST_F(Anchored, SelectionOfRowsIsAnchoredAlike) {
  EmulatedProber emulated(engine, catalogue, engine.start(), plan);
  RowSelection some(emulated, {brazilian_peak, ucs_peak});
  const auto anchored = some.anchored(far());
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

}  // namespace
}  // namespace bondlab::diagnose
