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
    worse.cross.before = 150, worse.cross.after = 178;
    take_back(worse);
    EXPECT_EQ(worse.diagnosis.verdict, Verdict::not_in_catalogue);
    EXPECT_TRUE(worse.diagnosis.effects.empty());
    ASSERT_EQ(worse.advice.size(), 1u);
    EXPECT_NE(worse.advice.front().find("nearest was right"), std::string::npos);
  }
}

TEST_F(NotAlone, NameStandsWhereSeriesHeldOutInTurnAreAsTheyWere) {
  out.cross.before = 139, out.cross.after = 145;
  take_back(out);
  EXPECT_EQ(out.diagnosis.verdict, Verdict::one);
  EXPECT_TRUE(out.advice.empty());
}

}  // namespace
}  // namespace bondlab::diagnose
