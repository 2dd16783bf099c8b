// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/verdict.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "report/example_for_tests.h"

namespace bondlab {
namespace {

TEST(Verdict, NamesWhatIsMetAndWhatIsMissedAndByHowMuch) {
  TestFolder folder;
  const ReportInput input = example::make(folder.path());
  EXPECT_EQ(targets_sentence(input.fits[0]),
            "E, nu and UCS are met (at most 0.7\u00a0% off). Predicted, not fitted: sigma_t is "
            "missed: 15.87\u00a0MPa simulated against "
            "9.5\u00a0MPa measured (+67\u00a0%).");
  EXPECT_EQ(headline(input), targets_sentence(input.fits[0]));
}

TEST(Verdict, TheFitsOwnWordsComeFirst) {
  ReportInput input;
  EXPECT_EQ(headline(input), "No fit has been finished yet.");
  input.fits.emplace_back();
  input.fits[0].verdict = "All is well.";
  EXPECT_EQ(headline(input), "All is well.");
}

TEST(Verdict, ATargetThatFailedIsNotCalledMissedByANumber) {
  ReportFit fit;
  fit.targets.push_back(
      example::target("UCS", "ucs", "uniaxial.peak_stress", "MPa", 138.8, 6.9, no_number, true));
  fit.targets[0].why_missing = "the load never fell";
  EXPECT_EQ(targets_sentence(fit), "UCS could not be simulated (the load never fell).");
}

TEST(Verdict, CountsTheParameterSetsThatMeetAllTargets) {
  TestFolder folder;
  ReportInput input = example::make(folder.path());
  EXPECT_EQ(all_met_sentence(input, input.fits[1]),
            "Of the 25\u00a0parameter sets run with all of E, nu, UCS and sigma_t, none meets them "
            "together.");
  input.points[0].responses = {{"E", 41.5}, {"nu", 0.23}, {"UCS", 138.8}, {"sigma_t", 9.7}};
  EXPECT_NE(all_met_sentence(input, input.fits[1]).find(", 1 meets them together."),
            std::string::npos);
  input.points.clear();
  EXPECT_EQ(all_met_sentence(input, input.fits[1]), "");
}

}  // namespace
}  // namespace bondlab
