// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/envelope_plot.h"

#include <gtest/gtest.h>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "report/example_for_tests.h"

namespace bondlab {
namespace {

ReportEnvelope envelope() {
  ReportEnvelope e;
  e.name = "peak", e.response = "tau", e.over = "sigma_n", e.unit = "MPa";
  e.tests = {"a", "b", "c"};
  e.over_values = {2, 5, 11}, e.values = {10, 13, 19};  // 8 + x
  e.cohesion = 8, e.friction_angle = 45;
  return e;
}

// Value of a straight series at x.
double at(const PlotSeries &line, double x) {
  return line.y.at(0) +
         (line.y.at(1) - line.y.at(0)) / (line.x.at(1) - line.x.at(0)) * (x - line.x.at(0));
}

TEST(EnvelopePlot, DrawsPointsAndLineFromTheAxisOn) {
  const Plot plot = envelope_plot({envelope()});
  const auto &series = plot.panels.at(0).series;
  ASSERT_EQ(series.size(), 2u) << "nothing was measured";
  EXPECT_EQ(series[0].x, (std::vector<double>{0, 11}));
  EXPECT_NEAR(at(series[0], 5), 13, 1e-12);
  EXPECT_EQ(series[1].y, (std::vector<double>{10, 13, 19}));
  EXPECT_EQ(plot.sentence.find("measured"), std::string::npos);
}

TEST(EnvelopePlot, DashesWhatWasMeasured) {
  ReportEnvelope e = envelope();
  e.measured_cohesion = 9, e.measured_friction_angle = 45;
  auto series = envelope_plot({e}).panels.at(0).series;
  ASSERT_EQ(series.size(), 3u);
  EXPECT_EQ(series[2].look, Look::dashed);
  EXPECT_NEAR(at(series[2], 0), 9, 1e-12);
  EXPECT_NEAR(at(series[2], 4), 13, 1e-12);
  EXPECT_EQ(series[2].label, "peak measured: c 9 MPa, phi 45\u00b0");
  e.measured_friction_angle = no_number;  // the cohesion alone: a point on the axis
  series = envelope_plot({e}).panels.at(0).series;
  EXPECT_EQ(series.at(2).look, Look::rings);
  EXPECT_EQ(series[2].x, std::vector<double>{0});
  EXPECT_EQ(series[2].y, std::vector<double>{9});
  e.measured_cohesion = no_number,
  e.measured_friction_angle = 45;  // the angle alone: through our middle
  series = envelope_plot({e}).panels.at(0).series;
  EXPECT_NEAR(at(series.at(2), 6), 14, 1e-12);
  EXPECT_NEAR(at(series.at(2), 0), 8, 1e-12);
}

TEST(EnvelopePlot, TakesEnvelopesInOtherUnitsToTheFirstOnes) {
  ReportEnvelope other = envelope();
  other.unit = "kPa", other.name = "residual";
  other.over_values = {2000, 5000, 11000}, other.values = {1000, 4000, 10000},
  other.cohesion = -1000;
  const auto series = envelope_plot({envelope(), other}).panels.at(0).series;
  ASSERT_EQ(series.size(), 4u);
  EXPECT_EQ(series[3].y, (std::vector<double>{1, 4, 10}));
  EXPECT_NEAR(at(series[2], 5), 4, 1e-12);
}

TEST(EnvelopePlot, SaysWhatIsMissing) {
  ReportEnvelope e = envelope();
  e.cohesion = e.friction_angle = no_number;
  e.left_out = {"c: it crashed"}, e.why_none = "2 different abscissae";
  const Plot plot = envelope_plot({e});
  EXPECT_EQ(plot.panels.at(0).series.size(), 1u);
  EXPECT_NE(plot.sentence.find(
                "Left out of peak: c: it crashed. No line for peak: 2 different abscissae."),
            std::string::npos);
}

TEST(EnvelopePlot, StandsOnTheFitsPage) {
  TestFolder folder;
  ReportInput input = example::make(folder.path());
  EXPECT_EQ(read_text_file(write_report(input, folder.path())).find("Strength envelopes"),
            std::string::npos);
  input.fits.front().envelopes.push_back(envelope());
  const std::string page = read_text_file(write_report(input, folder.path()));
  EXPECT_NE(page.find("Strength envelopes"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "pictures" / "envelopes.svg"));
}

}  // namespace
}  // namespace bondlab
