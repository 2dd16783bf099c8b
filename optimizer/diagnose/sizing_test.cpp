// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/sizing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/straight_model_for_tests.h"

namespace bondlab::diagnose {
namespace {

class SizeSearch : public ::testing::Test {
 protected:
  template <class Units>
  Sized search(Units units, double first, double largest = 1e9) {
    return search_size(
        [&](double size) {
          tried.push_back(size);
          return units(size);
        },
        first, 20, largest);
  }
  std::vector<double> tried;
};

TEST_F(SizeSearch, OneRunWhereTheFirstSizeIsRight) {
  const auto found = search([](double size) { return 10 * size; }, 1.8);
  EXPECT_EQ(tried.size(), 1u);
  EXPECT_EQ(found.size, 1.8);
  EXPECT_EQ(found.units, 18);
}

TEST_F(SizeSearch, FollowsAPowerLaw) {
  const auto found = search([](double size) { return 5 * size * size; }, 0.7);
  EXPECT_NEAR(found.units, 20, 5);
  EXPECT_LE(tried.size(), 4u);
}

// Bonds that yield at a stress which they never see: nothing below a size, much above it.
TEST_F(SizeSearch, GoesPastAThreshold) {
  const auto found = search([](double size) { return size < 2 ? 0.1 : 15 + 4 * (size - 2); }, 0.8);
  EXPECT_NEAR(found.units, 20, 5);
  EXPECT_GE(found.size, 2);
}

TEST_F(SizeSearch, ComesDownFromASizeThatIsFarTooLarge) {
  const auto found = search([](double size) { return 40 * size; }, 5);
  EXPECT_NEAR(found.units, 20, 5);
}

TEST_F(SizeSearch, LargestSizeThereIsWithTheUnitsThatItHas) {
  const auto found = search([](double size) { return 3 * size; }, 1, 2.5);
  EXPECT_EQ(found.size, 2.5);
  EXPECT_EQ(found.units, 7.5);
}

TEST_F(SizeSearch, NearestOfFourWhereNoneIsRight) {
  const auto found = search([](double size) { return size < 3 ? 2.0 : 30.0; }, 1);
  EXPECT_EQ(tried.size(), 4u);
  EXPECT_LT(tried.back(), 3);
  EXPECT_EQ(found.units, 30);  // 10 off, and 2 is 18 off
}

// The straight model's strengths scatter by 0.0245 over eight packings, its slopes not at all.
class NoiseUnits : public StraightModelTest {
 protected:
  NoiseUnits() {
    EmulatorPlan plan{8, 6, 0.12};
    studied = std::make_unique<StudyModel>(
        given, read_effects(inputs / "effects"),
        [this](const Study &) {
          auto straight = std::make_unique<StraightModel>();
          straight->default_gap = gap;
          return straight;
        },
        plan);
    studied->start(series);
    studied->add_effects();
  }
  // Twelve specimens of one strength, `sd` to either side of it.
  MeasuredSeries measured(const std::string &test, double sd) const {
    MeasuredSeries out;
    out.probed = {test, test, {{CurvePart::peak, "log peak"}}};
    out.replicates.resize(12, 1);
    for (Eigen::Index i = 0; i < 12; ++i) out.replicates(i, 0) = i % 2 == 0 ? sd : -sd;
    return out;
  }
  static constexpr double packings = 0.0245;
  std::unique_ptr<StudyModel> studied;
};

TEST_F(NoiseUnits, SpecimensThatScatterMoreThanPackingsWidenTheirRowsOnly) {
  ASSERT_EQ(studied->engine().rows(), 2);
  const auto wider = wider_than_packings(
      *studied, {measured("ucs", 4 * packings), measured("brazilian", packings)});
  ASSERT_EQ(wider.size(), 2);
  EXPECT_GT(wider(0), 3);
  EXPECT_LT(wider(0), 5.5);
  EXPECT_LT(wider(1), 2);
  const auto one = wider_than_packings(*studied, {measured("ucs", 4 * packings)});
  EXPECT_EQ(one(1), 1) << "not measured";
}

TEST_F(NoiseUnits, TwiceTheScatterTakesTwiceTheStated) {
  const Evidence plan = plan_evidence(*studied, 4), wide = widened(plan, Eigen::Vector2d(2, 3));
  EXPECT_NEAR(wide.series[0].stated(0, 0), 4 * plan.series[0].stated(0, 0), 1e-12);
  EXPECT_NEAR(wide.series[1].stated(0, 0), 9 * plan.series[1].stated(0, 0), 1e-12);
  EXPECT_EQ(plan.series[0].planned, 4);
  EXPECT_EQ(plan.series[0].replicates.size(), 0);
}

}  // namespace
}  // namespace bondlab::diagnose
