// SPDX-License-Identifier: GPL-2.0-or-later
//
// Single cases of the diagnosis on the closed-form laboratory; how often it is right is counted in
// benchmark_test.cpp.
#include "diagnose/diagnose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/bench_case.h"

namespace bondlab::diagnose {
namespace {

// One test of shear cannot tell friction after break from rolling resistance: at one normal stress
// both add a constant to the residual stress.
TEST(Diagnose, EffectsThatTheTestsCannotSeparateAreOfferedTogether) {
  Bench bench(bench_series({"ds_mid", "dt_mid"}), 1);
  const auto run = bench.run({{rheology::residual_friction}, 10, {}, 1}, 1);
  EXPECT_EQ(run.diagnosis.verdict, Verdict::set);
  EXPECT_TRUE(run.names(rheology::residual_friction));
  EXPECT_TRUE(run.names(rheology::rolling_resistance));
  for (const auto &effect : run.diagnosis.effects) EXPECT_LT(effect.margin, margin_needed);
}

TEST(Diagnose, SingleNameAlwaysHasItsMargin) {
  Bench bench(bench_series({"uc_mid_293K", "dt_mid"}), 1);
  int alone = 0, sets = 0;
  for (std::uint64_t number = 0; number < 24; ++number) {
    const auto run = bench.run({{rheology::frame_compliance}, 6, {}, 1}, number);
    alone += run.diagnosis.verdict == Verdict::one;
    sets += run.diagnosis.verdict == Verdict::set;
    if (run.diagnosis.verdict == Verdict::one) {
      EXPECT_GE(run.diagnosis.margin, margin_needed);
    }
  }
  // Its cosine with seating is 0.9 here: sometimes they can be told apart.
  EXPECT_GT(alone, 0);
  EXPECT_GT(sets, 0);
}

TEST(Diagnose, NamedEffectComesWithSizeMarginAndAnEmptyRest) {
  Bench bench(bench_series({}), 1);
  const auto run = bench.run({{rheology::norton_creep}, 15, {}, 1}, 1);
  const auto &d = run.diagnosis;
  ASSERT_EQ(d.verdict, Verdict::one);
  EXPECT_EQ(d.effects.front().effect, rheology::norton_creep);
  EXPECT_GT(d.margin, margin_needed);
  EXPECT_LT(d.effects.front().p, 0.01);
  const double size = run.truth.effects.size[rheology::norton_creep];
  EXPECT_NEAR(d.effects.front().size / size, 1, 0.4);
  EXPECT_LT(d.effects.front().low, d.effects.front().size);
  EXPECT_FALSE(d.where.empty());
  EXPECT_TRUE(d.remains.empty());
  EXPECT_NEAR(d.realised_gain, d.before.chi2 - d.after.chi2, 1e-9);
}

TEST(Diagnose, BothOfAPairHaveThePairsMargin) {
  Bench bench(bench_series({}), 1);
  const auto d =
      bench.run({{rheology::norton_creep, rheology::frame_compliance}, 15, {}, 1}, 1).diagnosis;
  ASSERT_EQ(d.verdict, Verdict::two);
  ASSERT_EQ(d.effects.size(), 2u);
  EXPECT_GT(d.margin, margin_needed);
  for (const auto &effect : d.effects) EXPECT_EQ(effect.margin, d.margin);
}

TEST(Diagnose, NothingMissingSaysWhatWouldHaveBeenSeen) {
  Bench bench(bench_series({}), 1);
  const auto run = bench.run({{}, 0, {}, 1}, 3);
  const auto &d = run.diagnosis;
  ASSERT_EQ(d.verdict, Verdict::nothing);
  EXPECT_TRUE(d.effects.empty());
  ASSERT_EQ(d.smallest_size.size(), bench_catalogue().size());
  // Planted at twice that size, the effect is seen.
  for (const std::size_t effect : {rheology::frame_compliance, rheology::weibull}) {
    BenchTruth truth = run.truth;
    truth.effects.size[effect] = 2 * d.smallest_size[effect];
    EXPECT_TRUE(bench.run({{effect}, 0, {}, 1}, truth, 3).names(effect))
        << rheology::effect_name(effect);
  }
}

TEST(Diagnose, SameDataGiveTheSameVerdictBitForBit) {
  Bench one(bench_series({}), 1), other(bench_series({}), 1);
  const auto a = one.run({{rheology::softening}, 12, {}, 1}, 5);
  const auto b = other.run({{rheology::softening}, 12, {}, 1}, 5);
  EXPECT_EQ(a.diagnosis.before.chi2, b.diagnosis.before.chi2);
  EXPECT_EQ(a.diagnosis.after.chi2, b.diagnosis.after.chi2);
  EXPECT_EQ(a.diagnosis.effects.size(), b.diagnosis.effects.size());
}

// A prober whose effect makes every run fail.
class Failing : public Prober {
 public:
  std::size_t parameters() const override { return 1; }
  std::size_t effects() const override { return 1; }
  double parameter_step(std::size_t) const override { return 0.01; }
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override {
    std::vector<Eigen::VectorXd> out;
    for (const auto &point : batch) {
      out.push_back(Eigen::VectorXd::Constant(4, point.z(0)));
      if (point.amplitude(0) != 0) out.back().setConstant(std::nan(""));
    }
    return out;
  }
};

TEST(Diagnose, EffectWhoseRunsFailIsDeadAndTheRestGoesOn) {
  Evidence evidence;
  SeriesEvidence series;
  series.name = series.test = "t";
  series.count = 4;
  series.replicates = Eigen::MatrixXd::Zero(2, 4);
  series.replicates.row(0) << 1.1, 0.9, 1.0, 1.05;
  series.replicates.row(1) << 0.9, 1.1, 1.0, 0.95;
  series.stated = 0.01 * Eigen::MatrixXd::Identity(4, 4);
  series.simulated = Eigen::MatrixXd::Zero(4, 4);
  for (int i = 0; i < 4; ++i) evidence.rows.push_back({"t", "t", CurvePart::slope, "q"});
  evidence.series.push_back(series);
  Failing prober;
  Refit base;
  const ModelPoint start{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1)};
  const auto model = fit_base(prober, Whitening(evidence), {EffectEntry()}, start, base);
  EXPECT_TRUE(base.ok);
  // A refit ends when less than 0.01 in chi squared is to be had: within a tenth of the sd.
  EXPECT_NEAR(base.point.z(0), 1, 0.1 * std::sqrt(base.covariance(0, 0)));
  EXPECT_TRUE(model.dead.front());
  EXPECT_EQ(model.traces.norm(), 0);
}

// A model that knows one effect's change less well than the others'.
class Doubtful : public Prober {
 public:
  Doubtful(Prober &exact, std::size_t effect, Eigen::MatrixXd doubt)
      : exact_(exact), effect_(static_cast<Eigen::Index>(effect)), doubt_(std::move(doubt)) {}
  std::size_t parameters() const override { return exact_.parameters(); }
  std::size_t effects() const override { return exact_.effects(); }
  double parameter_step(std::size_t i) const override { return exact_.parameter_step(i); }
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override {
    return exact_.probe(batch);
  }
  Eigen::MatrixXd uncertainty(const ModelPoint &point) override {
    return point.amplitude(effect_) == 0 ? Eigen::MatrixXd() : doubt_;
  }

 private:
  Prober &exact_;
  Eigen::Index effect_;
  Eigen::MatrixXd doubt_;
};

// Frame and seating leave much the same trace in these two tests. Where the frame's is known less
// well, seating is the likelier for that alone; the frame leaves less all the same.
TEST(Diagnose, EffectWhoseChangeIsKnownLessIsNotDismissedForThatAlone) {
  Bench bench(bench_series({"uc_mid_293K", "dt_mid"}), 1);
  int right = 0, sets = 0, others = 0;
  for (std::uint64_t number = 0; number < 24; ++number) {
    const auto run = bench.run({{rheology::frame_compliance}, 6, {}, 1}, number);
    if (run.diagnosis.verdict != Verdict::one || !run.names(rheology::frame_compliance)) continue;
    ++right;
    auto &setup = bench.setup(bench.rock_of(number));
    Eigen::MatrixXd doubt =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(run.evidence.rows.size()),
                              static_cast<Eigen::Index>(run.evidence.rows.size()));
    for (const auto &s : run.evidence.series)
      doubt.block(s.first, s.first, s.count, s.count) = 8 * s.stated / s.planned;
    Doubtful model(setup.laboratory, rheology::frame_compliance, doubt);
    const auto d =
        diagnose(model, run.evidence, {bench_catalogue(), bench_parameters(), setup.null},
                 setup.laboratory.nominal());
    const auto named = [&](std::size_t effect) {
      return std::any_of(d.effects.begin(), d.effects.end(),
                         [&](const NamedEffect &e) { return e.effect == effect; });
    };
    sets += d.verdict == Verdict::set && named(rheology::frame_compliance);
    others += d.verdict == Verdict::one && !named(rheology::frame_compliance);
  }
  EXPECT_GT(right, 3);
  EXPECT_GT(sets, 0);
  EXPECT_EQ(others, 0) << "of " << right;
}

}  // namespace
}  // namespace bondlab::diagnose
