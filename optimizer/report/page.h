// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: put the report's words, tables and pictures into one HTML page that needs nothing else.
// Method: one function a section, each from ReportInput alone and empty when there is nothing to
//   show; a section that should have something and hasn't says why. No scripts, no links out of the
//   page. The page is well-formed XML too, so that other programs can read it.
// Units: as ReportInput.
// Failure: none.
#pragma once

#include <string>
#include <vector>

#include "report/html.h"
#include "report/report.h"

namespace bondlab {

struct PageFigures {
  Figure deviations;
  std::vector<Figure> tests;  // curve and specimen of each test
  std::vector<Figure> convergence;
  std::vector<Figure> conflict;
};

std::string page_html(const ReportInput &input, const PageFigures &figures);

// Sections; page.cpp puts them in order.
std::string result_section(const ReportInput &input, const PageFigures &figures);
std::string tests_section(const ReportInput &input, const PageFigures &figures);
std::string convergence_section(const ReportInput &input, const PageFigures &figures);
std::string tradeoff_section(const ReportInput &input, const PageFigures &figures);
std::string packings_section(const ReportInput &input);
std::string assumptions_section(const ReportInput &input);
std::string runs_section(const ReportInput &input);
std::string commands_section(const ReportInput &input);

}  // namespace bondlab
