// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: run gnuplot on a plot and make of its SVG a picture that can stand in a page beside others.
// Method: script and data are written to the directory given and gnuplot is started there without a
//   shell and without the user's own settings (-d). Its SVG is tidied: own root element with title
//   and description, no empty groups, no version, element ids made unique by the plot's name
//   (several pictures share one page), colours as #rrggbb of the palette.
// Units: none.
// Failure: UserError when the program is missing, ends with an error (its words are given) or draws
//   nothing.
// Limits: written for gnuplot 5.4 and 5.2 (Debian 11 to 13).
#pragma once

#include <filesystem>
#include <string>

#include "report/plot.h"

namespace bondlab {

// Leaves NAME.gp, NAME.tsv and NAME.svg in `directory`; returns the tidied SVG.
std::string draw_plot(const Plot &plot, const std::filesystem::path &directory,
                      const std::string &program = "gnuplot");

std::string tidy_gnuplot_svg(const std::string &svg, const Plot &plot);

}  // namespace bondlab
