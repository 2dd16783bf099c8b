// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "diagnose/advice.h"
#include "diagnose/omnibus.h"

namespace bondlab::diagnose {
namespace {

constexpr int rows = 40;

EffectEntry entry(const std::string &name, double lowest, double largest) {
  EffectEntry e;
  e.name = name;
  e.lowest = lowest;
  e.largest = largest;
  return e;
}

// Two parameters, three effects: the third is a mix of the parameters.
struct Example {
  std::vector<EffectEntry> catalogue = {entry("a", 0, 10), entry("b", -10, 10),
                                        entry("inside the parameters", 0, 10)};
  Linearisation model;
  Example() {
    RandomStream random(3);
    model.jacobian.resize(rows, 2);
    model.traces.resize(rows, 3);
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < 2; ++j) model.jacobian(i, j) = random.normal();
      for (int k = 0; k < 2; ++k) model.traces(i, k) = random.normal();
    }
    model.traces.col(2) = 2 * model.jacobian.col(0) - model.jacobian.col(1);
  }
  Projection fitted() const { return Projection(model.jacobian); }
};

TEST(Score, FindsThePlantedAmplitudeWhateverTheParametersDo) {
  const Example e;
  const ScoreTable table(e.fitted(), e.model, e.catalogue);
  const Eigen::VectorXd residual =
      e.fitted().off(3 * e.model.traces.col(0) + 5 * e.model.jacobian.col(1));
  const auto best = table.scores(residual).front();
  EXPECT_EQ(best.effect, 0u);
  EXPECT_NEAR(best.amplitude, 3, 1e-9);
  EXPECT_NEAR(best.gain, residual.squaredNorm(), 1e-9);
}

TEST(Score, InadmissibleSignGainsNothing) {
  const Example e;
  const ScoreTable table(e.fitted(), e.model, e.catalogue);
  const Eigen::VectorXd residual = e.fitted().off(-3 * e.model.traces.col(0));
  for (const auto &score : table.scores(residual)) {
    if (score.effect == 0) {
      EXPECT_EQ(score.gain, 0);
    }
  }
  const Eigen::VectorXd other = e.fitted().off(-3 * e.model.traces.col(1));
  EXPECT_EQ(table.scores(other).front().effect, 1u);
}

TEST(Score, AmplitudeIsCutAtItsLargestAdmissibleSize) {
  Example e;
  e.catalogue[0].largest = 1;
  const ScoreTable table(e.fitted(), e.model, e.catalogue);
  const Eigen::VectorXd residual = e.fitted().off(3 * e.model.traces.col(0));
  for (const auto &score : table.scores(residual)) {
    if (score.effect == 0) {
      EXPECT_NEAR(score.amplitude, 1, 1e-12);
      EXPECT_NEAR(score.gain, residual.squaredNorm() * (1 - 4.0 / 9), 1e-9);
    }
  }
}

TEST(Score, EffectThatParametersCanDoIsHidden) {
  const Example e;
  const ScoreTable table(e.fitted(), e.model, e.catalogue);
  EXPECT_TRUE(table.hidden(2));
  EXPECT_FALSE(table.hidden(0));
}

TEST(Score, PairIsSolvedTogether) {
  const Example e;
  const ScoreTable table(e.fitted(), e.model, e.catalogue);
  const Eigen::VectorXd residual =
      e.fitted().off(3 * e.model.traces.col(0) - 2 * e.model.traces.col(1));
  const auto pairs = table.pairs(residual);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs.front().gain, residual.squaredNorm(), 1e-9);
}

// The chance is that of a normal number: compare with drawing data.
TEST(Score, ConfusionChanceIsThatOfDrawnData) {
  RandomStream random(5);
  const double cosine = 0.9, lambda = 6;
  int close = 0;
  const int draws = 20000;
  for (int i = 0; i < draws; ++i) {
    const double a = lambda + random.normal(), across = random.normal();
    const double b = cosine * a + std::sqrt(1 - cosine * cosine) * across;
    close += a * a - b * b < margin_needed;
  }
  EXPECT_NEAR(confusion_chance(cosine, lambda), static_cast<double>(close) / draws, 0.02);
  EXPECT_EQ(confusion_chance(1, 10), 1);
  EXPECT_LT(confusion_chance(0, 10), 1e-4);
}

// Two effects that look alike in the first rows and differ in one of two further tests.
TEST(Advice, ChoosesTheTestInWhichTheRivalsDiffer) {
  Example e;
  e.model.traces.col(1) = e.model.traces.col(0);
  for (int i = 30; i < rows; ++i) e.model.traces(i, 1) = -e.model.traces(i, 0);
  std::vector<bool> present(rows, false);
  TestOption same{"same", {}}, different{"different", {}};
  for (int i = 0; i < 20; ++i) present[static_cast<std::size_t>(i)] = true;
  for (int i = 20; i < 30; ++i) same.rows.push_back(i);
  for (int i = 30; i < rows; ++i) different.rows.push_back(i);
  const auto advice = advise(e.model, present, {same, different}, {0, 1}, {4, 4});
  EXPECT_EQ(advice.front().test, "different");
  EXPECT_TRUE(advice.front().enough);
  EXPECT_NEAR(advice.back().separation, 0, 1e-9);
  EXPECT_TRUE(advise(e.model, present, {same, different}, {0}, {4}).empty());
}

// Three tests of equal rows; a parameter that scales all rows drifts in the third.
TEST(Omnibus, ScoresAreStandardNormalAndADriftIsFoundWhereItIs) {
  Evidence evidence;
  const int count = 12;
  for (int s = 0; s < 3; ++s) {
    SeriesEvidence series;
    series.name = "s" + std::to_string(s);
    series.test = "t";
    series.conditions["rate"] = s;
    series.first = s * count;
    series.count = count;
    series.stated = Eigen::MatrixXd::Identity(count, count);
    series.simulated = Eigen::MatrixXd::Zero(count, count);
    for (int i = 0; i < count; ++i)
      evidence.rows.push_back(
          {"t", series.name, i < 6 ? CurvePart::slope : CurvePart::peak, "q" + std::to_string(i)});
    evidence.series.push_back(series);
  }
  const Whitening whitening(evidence);
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Ones(3 * count, 1);
  const Omnibus omnibus(evidence, whitening, {"E"}, jacobian);
  const Projection fitted(jacobian);
  const Omnibus::Prepared prepared(omnibus, fitted);
  RandomStream random(7);
  double mean = 0, square = 0;
  const int draws = 4000;
  for (int d = 0; d < draws; ++d) {
    Eigen::VectorXd noise(3 * count);
    for (auto &x : noise) x = random.normal();
    const double score = prepared.block_scores(fitted.off(noise)).front();
    mean += score / draws, square += score * score / draws;
  }
  EXPECT_NEAR(mean, 0, 0.05);
  EXPECT_NEAR(square, 1, 0.08);
  Eigen::VectorXd drift = Eigen::VectorXd::Zero(3 * count);
  drift.tail(count).setConstant(3);
  const auto found = prepared.largest(fitted.off(drift));
  EXPECT_FALSE(found.block);
  EXPECT_EQ(omnibus.drifts()[found.index].parameter, "E");
  EXPECT_EQ(omnibus.drifts()[found.index].over, "rate 2");
}

}  // namespace
}  // namespace bondlab::diagnose
