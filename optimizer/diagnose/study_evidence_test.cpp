// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_evidence.h"

#include <gtest/gtest.h>

#include <limits>

#include "refine/emulator_for_tests.h"

namespace bondlab::diagnose {
namespace {

TEST(StudyEvidence, LeavesOutFiguresOfEnvelopesAndNamesThem) {
  Study study = testing::granite_study();
  const auto rows = [](const Study &of) {
    std::size_t sum = 0;
    for (const MeasuredSeries &series : measured_series(of)) sum += series.probed.quantities.size();
    return sum;
  };
  ASSERT_EQ(rows(study), 4u);
  EXPECT_TRUE(targets_of_envelopes(study).empty());
  Target cohesion = testing::make_target("c_peak", "", "MPa", 12e6, 0.05);
  cohesion.envelope = "peak", cohesion.response = "cohesion";
  study.targets.push_back(cohesion);
  EXPECT_EQ(rows(study), 4u);
  EXPECT_EQ(targets_of_envelopes(study),
            std::vector<std::string>{"c_peak, cohesion of envelope peak"});
  study.data = DataFolder();  // curves are compared instead of targets
  EXPECT_TRUE(targets_of_envelopes(study).empty());
}

TEST(StudyEvidence, RowThatFewPackingsLackIsKept) {
  const std::vector<ProbedSeries> series = {
      {"shear", "shear", {{CurvePart::peak, "whole"}, {CurvePart::peak, "one"}}},
      {"ucs", "ucs", {{CurvePart::peak, "two"}, {CurvePart::peak, "still"}}}};
  Eigen::MatrixXd rows(10, 4);
  for (Eigen::Index p = 0; p < 10; ++p) rows.row(p) << p, p, p, 1;
  rows(4, 1) = rows(4, 2) = rows(5, 2) = std::numeric_limits<double>::quiet_NaN();
  const auto names = [](const std::vector<ProbedSeries> &of) {
    std::vector<std::string> out;
    for (const auto &s : of)
      for (const auto &q : s.quantities) out.push_back(q.name);
    return out;
  };
  EXPECT_EQ(names(that_scatter(series, rows)), std::vector<std::string>{"whole"});
  EXPECT_EQ(names(that_scatter(series, rows, 0.1)), (std::vector<std::string>{"whole", "one"}));
  EXPECT_EQ(names(that_scatter(series, rows, 0.2)),
            (std::vector<std::string>{"whole", "one", "two"}));
}

}  // namespace
}  // namespace bondlab::diagnose
