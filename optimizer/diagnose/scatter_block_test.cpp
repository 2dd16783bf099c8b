// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/scatter_block.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "refine/emulator_for_tests.h"

namespace bondlab::diagnose {
namespace {

constexpr double strength_sd = 0.1;

// Two series of compression and one Brazilian, forty packings; some packings break early, so that
// the distribution has a tail.
class Scatter : public ::testing::Test {
 protected:
  double draw(RandomStream &random) const {
    const double x = strength_sd * random.normal();
    return random.uniform() < 0.1 ? x - 2 * strength_sd : x;
  }
  ScatterTest test(double times, std::uint64_t seed, double sensors = 0, Eigen::Index count = 6) {
    RandomStream random(seed, 7);
    const std::vector<std::string> tests = {"ucs", "ucs", "brazilian"};
    Eigen::MatrixXd packings(40, 6);
    std::vector<MeasuredSeries> series;
    for (std::size_t i = 0; i < tests.size(); ++i) {
      MeasuredSeries s;
      s.probed = {"series", tests[i], {{CurvePart::slope, "slope"}, {CurvePart::peak, "log peak"}}};
      s.replicates.resize(count, 2);
      s.sensors = Eigen::Vector2d(0, sensors * sensors);
      for (Eigen::Index r = 0; r < count; ++r) {
        const double factor = i == 2 ? times : 1;
        s.replicates.row(r) << 50 * random.normal(),
            5 + factor * draw(random) + sensors * random.normal();
      }
      for (Eigen::Index p = 0; p < packings.rows(); ++p)
        packings.row(p).segment(2 * static_cast<Eigen::Index>(i), 2) << random.normal(),
            7 + draw(random);
      series.push_back(s);
    }
    return scatter_test(study, series, packings, seed);
  }
  double alarms(double times, int cases, double sensors = 0) {
    int alarms = 0;
    for (int i = 0; i < cases; ++i)
      alarms += test(times, 100 + static_cast<std::uint64_t>(i), sensors).p < 0.01;
    return static_cast<double>(alarms) / cases;
  }
  Study study = [] {
    Study out = testing::granite_study();
    for (auto &test : out.tests) test.definition.name = test.name;
    return out;
  }();
};

// Nominal 1 %; of 200 cases 5 have a chance of 5 %.
TEST_F(Scatter, SpecimensLikePackingsAreNoAlarm) {
  EXPECT_LE(alarms(1, 200), 5.0 / 200);
  EXPECT_LE(alarms(1, 200, 2 * strength_sd), 5.0 / 200) << "sensors' noise is known";
}

TEST_F(Scatter, WiderOnesAreSeenWhereTheyAre) {
  EXPECT_GE(alarms(4, 60), 0.9);
  const auto found = test(5, 3);
  ASSERT_EQ(found.blocks.size(), 3u);
  ASSERT_NE(found.worst(), nullptr);
  EXPECT_NE(found.worst()->name.find("brazilian"), std::string::npos);
  EXPECT_GT(found.worst()->ratio, 9);
  EXPECT_LT(found.worst()->ratio, 49);
}

TEST_F(Scatter, NarrowerOnesToo) {
  const auto found = test(0.02, 3);
  EXPECT_LT(found.p, 0.01);
  EXPECT_LT(found.worst()->ratio, 0.1);
}

// Eighteen variances of six; packings' own is no bias.
TEST_F(Scatter, RatioIsOneInTheMean) {
  double mean = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    mean += test(1, 1000 + seed).blocks.back().ratio / 200;
  EXPECT_NEAR(mean, 1, 0.07);
}

TEST_F(Scatter, SameSeedGivesTheSame) { EXPECT_EQ(test(2, 9).p, test(2, 9).p); }

TEST_F(Scatter, OneSpecimenOrATargetTellsNothing) {
  const auto none = test(1, 1, 0, 1);
  EXPECT_TRUE(none.blocks.empty());
  EXPECT_EQ(none.worst(), nullptr);
  EXPECT_EQ(none.p, 1);
}

}  // namespace
}  // namespace bondlab::diagnose
