// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/feasibility.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "refine/emulator_for_tests.h"

namespace bondlab {
namespace {

const std::vector<std::string> strengths{"UCS", "sigma_t"};

LedgerPoint point(double ucs, double sigma_t) {
  LedgerPoint ledger;
  ledger.responses = {{"UCS", ucs * 1e6}, {"sigma_t", sigma_t * 1e6}};
  return ledger;
}

Finding about(const std::vector<Finding> &findings, const std::vector<std::string> &targets) {
  const auto found = std::find_if(findings.begin(), findings.end(),
                                  [&](const Finding &f) { return f.targets == targets; });
  if (found != findings.end()) return *found;
  ADD_FAILURE() << "no finding about " << targets.front();
  return {};
}

TEST(Feasibility, RatioOutsideTheSpanOfAllRunsIsUnreachableThoughEachAloneIsReached) {
  const Study study = testing::granite_study();  // 138.8 and 9.5 MPa, 5 % each
  const auto findings =
      judge_feasibility(study, strengths, {point(80, 9), point(100, 11.5), point(145, 17)});
  EXPECT_EQ(about(findings, {"UCS"}).kind, FindingKind::reachable);
  EXPECT_EQ(about(findings, {"sigma_t"}).kind, FindingKind::reachable);
  const auto ratio = about(findings, strengths);
  EXPECT_EQ(ratio.kind, FindingKind::unreachable_ratio);
  EXPECT_NEAR(ratio.low, 145.0 / 17, 1e-9);
  EXPECT_NEAR(ratio.high, 80.0 / 9, 1e-9);
  EXPECT_EQ(ratio.points, 3);
  for (const std::string words : {"between 8.53 and 8.89 over all 3 parameter sets",
                                  "measured: 14.6", "No parameter set within the bounds",
                                  "each alone is within reach", "property of the model"})
    EXPECT_NE(ratio.text.find(words), std::string::npos) << words << " not in: " << ratio.text;
}

TEST(Feasibility, RatioWithinTwoSdOfTheSpanIsReachable) {
  const Study study = testing::granite_study();  // ratio 14.6, 2 sd are 14 % of it: 12.5
  auto findings = judge_feasibility(study, strengths, {point(80, 9), point(150, 11.9)});
  EXPECT_EQ(about(findings, strengths).kind, FindingKind::reachable);
  findings = judge_feasibility(study, strengths, {point(80, 9), point(150, 12.1)});
  EXPECT_EQ(about(findings, strengths).kind, FindingKind::unreachable_ratio);
}

TEST(Feasibility, TargetOutsideTheSpanIsUnreachableAndSpoilsNoRatio) {
  const Study study = testing::granite_study();
  const auto findings = judge_feasibility(study, strengths, {point(40, 9.5), point(100, 9.8)});
  EXPECT_EQ(about(findings, {"UCS"}).kind, FindingKind::unreachable_target);
  EXPECT_NE(about(findings, {"UCS"}).text.find("No parameter set within the bounds reached it"),
            std::string::npos);
  EXPECT_TRUE(std::none_of(findings.begin(), findings.end(), [](const Finding &f) {
    return f.kind == FindingKind::unreachable_ratio;
  }));
}

TEST(Feasibility, RatioThatHardlyMovesIsTheReasonThoughATargetIsUnreachableAlone) {
  const Study study = testing::granite_study();
  const auto findings = judge_feasibility(study, strengths, {point(80, 16), point(145, 28)});
  EXPECT_EQ(about(findings, {"sigma_t"}).kind, FindingKind::unreachable_target);
  const auto ratio = about(findings, strengths);
  EXPECT_EQ(ratio.kind, FindingKind::unreachable_ratio);
  EXPECT_EQ(ratio.text.find("each alone"), std::string::npos) << ratio.text;
}

TEST(Feasibility, TargetsOfUnlikeDimensionHaveNoRatio) {
  const Study study = testing::granite_study();
  LedgerPoint ledger = point(100, 10);
  ledger.responses["nu"] = 0.2;
  const auto findings = judge_feasibility(study, {"nu", "UCS"}, {ledger});
  EXPECT_EQ(findings.size(), 2u);
}

TEST(Feasibility, PointsWithoutBothFiguresAreNoEvidenceForTheRatio) {
  const Study study = testing::granite_study();
  LedgerPoint half;
  half.responses["UCS"] = 140e6;
  EXPECT_EQ(about(judge_feasibility(study, strengths, {half, point(140, 10)}), strengths).points,
            1);
  const auto none = judge_feasibility(study, strengths, {half});
  EXPECT_EQ(none.size(), 1u);  // UCS alone
}

}  // namespace
}  // namespace bondlab
