// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_advice.h"

#include <gtest/gtest.h>

namespace bondlab::diagnose {
namespace {

class NotAlone : public ::testing::Test {
 protected:
  NotAlone() {
    out.catalogue.resize(2);
    out.catalogue[0].name = "right", out.catalogue[1].name = "rival";
    NamedEffect named;
    named.effect = 0;
    out.diagnosis.verdict = Verdict::one;
    out.diagnosis.effects = {named};
    out.diagnosis.tried = {{{0}, {1.0}, 0}, {{1}, {0.5}, 14}};
    out.holdout = "shear";
  }
  Verdict judged(double before, double after, int rows) {
    out.by_series = {{"ucs", false, 9, 1, 7}, {"shear", true, before, after, rows}};
    give_not_alone(out);
    return out.diagnosis.verdict;
  }
  StudyDiagnosis out;
};

TEST_F(NotAlone, NameThatHelpsStands) { EXPECT_EQ(judged(4.5, 1.1, 2), Verdict::one); }

TEST_F(NotAlone, NameStandsWhereItDoesNotTouchTheSeriesHeldOut) {
  EXPECT_EQ(judged(0.95, 1.02, 6), Verdict::one);
}

// Six rows: chi squared from 0.5 to 9.4, where chance leaves up to 16.
TEST_F(NotAlone, NameStandsWhereTheSeriesHeldOutLiesWithinItsNoise) {
  EXPECT_EQ(judged(0.3, 1.25, 6), Verdict::one);
}

TEST_F(NotAlone, NameThatMakesItWorseIsOneOfASet) {
  EXPECT_EQ(judged(1.0, 3.0, 1), Verdict::set);
  ASSERT_EQ(out.diagnosis.effects.size(), 2u);
  EXPECT_EQ(out.diagnosis.effects[1].effect, 1u);
  EXPECT_NE(out.advice.front().find("'right' was best"), std::string::npos);
}

TEST_F(NotAlone, NameThatLeavesAGapAsItIsIsOneOfASet) {
  EXPECT_EQ(judged(4.5, 4.6, 1), Verdict::set);
}

TEST_F(NotAlone, WithoutARivalItIsNotInTheCatalogue) {
  out.diagnosis.tried.pop_back();
  EXPECT_EQ(judged(4.5, 8.1, 1), Verdict::not_in_catalogue);
  EXPECT_TRUE(out.diagnosis.effects.empty());
}

TEST_F(NotAlone, NameThatSeriesHeldOutInTurnAreWorseWithIsNotGiven) {
  for (const auto verdict : {Verdict::one, Verdict::set, Verdict::two}) {
    StudyDiagnosis worse = out;
    worse.diagnosis.verdict = verdict;
    worse.cross.before = 150, worse.cross.after = 178, worse.cross.floor = 110;
    take_back(worse);
    EXPECT_EQ(worse.diagnosis.verdict, Verdict::not_in_catalogue);
    EXPECT_TRUE(worse.diagnosis.effects.empty());
    ASSERT_EQ(worse.advice.size(), 1u);
    EXPECT_NE(worse.advice.front().find("nearest was right"), std::string::npos);
  }
}

TEST_F(NotAlone, NameStandsWhereSeriesHeldOutInTurnAreAsTheyWere) {
  out.cross.before = 139, out.cross.after = 145, out.cross.floor = 70;
  take_back(out);
  EXPECT_EQ(out.diagnosis.verdict, Verdict::one);
  EXPECT_TRUE(out.advice.empty());
}

TEST_F(NotAlone, ScatterBeyondTheAlarmIsAPlaceAndNoName) {
  out.diagnosis.false_alarm = 0.01;
  out.scatter = {{{"brazilian, scatter", 1.1, 0.6}, {"ucs, scatter", 6.25, 0.0005}}, 0.02};
  add_scatter(out);
  EXPECT_TRUE(out.diagnosis.where.empty());
  out.scatter.p = 0.001;
  add_scatter(out);
  ASSERT_EQ(out.diagnosis.where.size(), 1u);
  EXPECT_EQ(out.diagnosis.where.front().name, "ucs, scatter");
  EXPECT_NEAR(out.diagnosis.where.front().score, 3.29, 0.01);
  ASSERT_EQ(out.advice.size(), 1u);
  EXPECT_NE(out.advice.front().find("scatter 2.50 times"), std::string::npos);
  EXPECT_NE(out.advice.front().find("strength_scatter"), std::string::npos);
  EXPECT_EQ(out.diagnosis.verdict, Verdict::one);
  out.scatter.blocks[1].ratio = 0.1;
  add_scatter(out);
  EXPECT_NEAR(out.diagnosis.where.back().score, -3.29, 0.01);
  EXPECT_NE(out.advice.back().find("too coarse"), std::string::npos);
}

TEST_F(NotAlone, NameStandsWhereSeriesHeldOutInTurnLieWithinTheirNoise) {
  out.cross.before = 69, out.cross.after = 81, out.cross.floor = 72;
  take_back(out);
  EXPECT_EQ(out.diagnosis.verdict, Verdict::one);
  EXPECT_TRUE(out.advice.empty());
}

}  // namespace
}  // namespace bondlab::diagnose
