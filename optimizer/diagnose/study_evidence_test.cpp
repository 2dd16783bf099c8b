// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_evidence.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace bondlab::diagnose
