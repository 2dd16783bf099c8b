// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/diagnosis_pictures.h"

#include <gtest/gtest.h>

#include <regex>

namespace bondlab::diagnose {
namespace {

Curve curve(const std::vector<std::string> &names, const std::vector<std::string> &units) {
  Curve out;
  out.names = names, out.units = units;
  for (std::size_t i = 0; i < names.size(); ++i) out.columns.push_back({0, 1, 2});
  return out;
}

bool holds(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}

TEST(DiagnosisPictures, AxesSayWhatIsDrawnAndInWhichUnit) {
  ShownSeries series;
  series.before = curve({"strain_axial", "axial_stress"}, {"1", "Pa"});
  std::string svg = curve_picture(series);
  EXPECT_TRUE(holds(svg, ">strain axial, to 2<")) << svg;
  EXPECT_TRUE(holds(svg, ">axial stress (Pa), to 2<")) << svg;
  // A run that failed leaves the measured curves.
  series.before = Curve();
  series.measured = {curve({"displacement", "force_top"}, {"m", "N"})};
  svg = curve_picture(series);
  EXPECT_TRUE(holds(svg, ">displacement (m), to 2<")) << svg;
  EXPECT_TRUE(holds(svg, ">force top (N), to 2<")) << svg;
  series.measured.clear();
  EXPECT_EQ(curve_picture(series), "");
  series.after = curve({"displacement", "force_top"}, {"m", "N"});
  EXPECT_TRUE(holds(curve_picture(series), ">force top (N), to 2<"));
}

// Names are set right-aligned at x; some 6 of its 12 points a letter.
TEST(DiagnosisPictures, LongNamesOfSeriesFitIntoTheMap) {
  for (const std::string &name : {std::string("ucs"), std::string(40, 'w')}) {
    StudyDiagnosis d;
    d.rows = {{"uniaxial_compression", name, CurvePart::slope, "row"}};
    d.diagnosis.before.residual = d.diagnosis.after.residual = Eigen::VectorXd::Constant(1, 2.0);
    const std::string svg = where_picture(d);
    std::smatch at;
    ASSERT_TRUE(std::regex_search(svg, at, std::regex("x=\"([0-9]+)\"[^>]*end[^>]*>" + name)))
        << svg;
    EXPECT_GE(std::stod(at[1]), 6.5 * static_cast<double>(name.size()));
    EXPECT_TRUE(holds(svg, "+2.0"));
  }
}

}  // namespace
}  // namespace bondlab::diagnose
