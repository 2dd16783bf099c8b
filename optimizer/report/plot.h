// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a line or scatter plot as data, and the gnuplot script and data file that draw it.
// Method: one Plot is a grid of panels with explicit axis ranges; the script places every panel and
//   the legend at fixed pixels, because gnuplot's own legend overlaps data or is cut when its guess
//   of the text width is wrong. The data go into a TSV file beside the script (one block a series),
//   so that a reader can draw the plot again or anew. Words of the user enter the script only
//   inside single quotes, where gnuplot runs no commands.
// Units: pixels for the layout; data as the axis labels say.
// Failure: none; series without a finite point are left out and an empty panel says "no data".
// Limits: at most one right-hand axis a panel.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bondlab {

enum class Look { line, dashed, steps, points, rings, crosses, band };

struct PlotSeries {
  std::string label;  // in the legend; empty: not there
  Look look = Look::line;
  const char *colour = "series-1";  // role in the palette
  std::vector<double> x, y;
  std::vector<double> high;  // band: upper edge, y is the lower one
  bool right_axis = false;
  double weight = 1;  // of lines and points
};

struct PlotAxis {
  std::string label;
  bool logarithmic = false;
  std::optional<double> low, high;  // absent: from the data
  bool from_zero = false;           // the range includes 0
  bool whole_numbers = false;       // counts: no ticks between
};

struct PlotPanel {
  PlotAxis x, y, right;
  std::vector<PlotSeries> series;
  bool has_right_axis() const;
};

struct Plot {
  std::string name;      // file name without suffix
  std::string title;     // heading
  std::string sentence;  // what it shows, in one plain sentence
  double width = 520, height = 380;
  int columns = 1;
  bool shared_axes = false;       // tick labels only at the left and the bottom of the grid
  std::vector<PlotPanel> panels;  // row by row
};

std::string plot_data(const Plot &plot);    // TSV
std::string plot_script(const Plot &plot);  // reads NAME.tsv, writes NAME.svg

// At most `limit` points that keep every peak: of each bucket its lowest and highest point, in
// order.
void thin_out(std::vector<double> &x, std::vector<double> &y, std::size_t limit);

}  // namespace bondlab
