// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/case_plots.h"

#include <gtest/gtest.h>

namespace bondlab {
namespace {

Curve curve(std::vector<double> force) {
  Curve out;
  out.names = {"time", "displacement", "force_top", "force_bottom"};
  out.columns.resize(4);
  for (std::size_t i = 0; i < force.size(); ++i) {
    const auto t = static_cast<double>(i);
    const double row[] = {t, 1e-4 * t, force[i] + 1, force[i] - 1};
    for (std::size_t c = 0; c < 4; ++c) out.columns[c].push_back(row[c]);
  }
  return out;
}

TEST(CasePlot, HasAPanelATestAndALineACaseInOneUnitAPanel) {
  const Curve weak = curve({0, 300, 600, 500}), strong = curve({0, 1200, 2400, 2000});
  const auto plot = case_plot("beads", {{"ucs", "a", &weak}, {"shear", "a", &strong}, {"ucs", "b", &strong}});
  ASSERT_TRUE(plot);
  ASSERT_EQ(plot->panels.size(), 2u);
  const auto &ucs = plot->panels[0];
  EXPECT_EQ(ucs.y.label, "force (kN)");
  EXPECT_EQ(ucs.x.label, "ucs: displacement (mm)");
  ASSERT_EQ(ucs.series.size(), 2u);
  EXPECT_EQ(ucs.series[0].y, (std::vector<double>{0, 0.3, 0.6, 0.5}));
  EXPECT_NEAR(ucs.series[0].x[3], 0.3, 1e-12);
  EXPECT_STRNE(ucs.series[0].colour, ucs.series[1].colour);
  // each case once in the legend
  EXPECT_EQ(ucs.series[0].label, "a");
  EXPECT_EQ(ucs.series[1].label, "b");
  EXPECT_EQ(plot->panels[1].series.at(0).label, "");
  EXPECT_STREQ(plot->panels[1].series[0].colour, ucs.series[0].colour);
}

TEST(CasePlot, EndsWhereTheForceHasFallenForGood) {
  const Curve rings = curve({0, 100, 20, 90, 10, 5, 8, 3});
  const auto plot = case_plot("", {{"ucs", "a", &rings}});
  ASSERT_TRUE(plot);
  EXPECT_EQ(plot->panels.at(0).series.at(0).y, (std::vector<double>{0, 100, 20, 90, 10}));
}

TEST(CasePlot, LeavesOutWhatIsTooManyAndWhatHasNoForce) {
  const Curve good = curve({0, 1, 2, 1});
  Curve bare = good;
  bare.names = {"time", "a", "b", "c"};
  EXPECT_FALSE(case_plot("", {{"ucs", "a", &bare}, {"ucs", "b", nullptr}}));
  std::vector<CaseCurve> many;
  for (std::size_t i = 0; i < most_cases_drawn + 2; ++i)
    many.push_back({"ucs", "case " + std::to_string(i), &good});
  const auto plot = case_plot("", many);
  ASSERT_TRUE(plot);
  EXPECT_EQ(plot->panels.at(0).series.size(), most_cases_drawn);
  EXPECT_NE(plot->sentence.find("the first 10 of 12 cases"), std::string::npos);
  EXPECT_EQ(plot->panels[0].series[5].look, Look::dashed);  // colours come again
}

}  // namespace
}  // namespace bondlab
