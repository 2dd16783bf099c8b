// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/case_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/curve_plots.h"

namespace bondlab {
namespace {

constexpr std::size_t most_points = 600;
constexpr double fallen = 1.0 / 3;

struct Line {
  std::string test;
  std::size_t of_case = 0;
  std::vector<double> way, force;
};

bool has_columns(const Curve &curve) {
  return curve.has("displacement") && curve.has("force_top") && curve.has("force_bottom");
}

// Samples before the force has fallen for good; behind that only fragments ring.
std::size_t drawn(const std::vector<double> &force) {
  const double peak = force.empty() ? 0 : force[peak_index(force)];
  std::size_t last = force.size();
  while (last > 0 && force[last - 1] < fallen * peak) --last;
  return std::min(force.size(), last + 1);
}

double largest(const std::vector<const Line *> &lines, std::vector<double> Line::*column) {
  double result = 0;
  for (const Line *line : lines)
    for (const double value : line->*column)
      if (std::isfinite(value)) result = std::max(result, std::abs(value));
  return result;
}

void scale(std::vector<double> &values, double factor) {
  for (double &value : values) value *= factor;
}

PlotPanel panel_of(const std::string &test, const std::vector<const Line *> &lines,
                   const std::vector<std::string> &cases, std::vector<bool> &named) {
  static const std::array<const char *, 5> colours = {"series-1", "series-2", "series-3",
                                                      "series-4", "ink"};
  const AxisUnit force = force_unit(largest(lines, &Line::force)),
                 way = way_unit(largest(lines, &Line::way));
  PlotPanel panel;
  panel.x.label = fmt::format("{}: displacement ({})", test, way.name);
  panel.y.label = fmt::format("force ({})", force.name);
  panel.x.from_zero = panel.y.from_zero = true;
  for (const Line *line : lines) {
    PlotSeries series;
    series.x = line->way, series.y = line->force;
    scale(series.x, 1 / way.factor), scale(series.y, 1 / force.factor);
    thin_out(series.x, series.y, most_points);
    series.colour = colours[line->of_case % colours.size()];
    series.look = line->of_case < colours.size() ? Look::line : Look::dashed;
    if (!named[line->of_case]) series.label = cases[line->of_case];
    named[line->of_case] = true;
    panel.series.push_back(std::move(series));
  }
  return panel;
}

std::size_t place_of(std::vector<std::string> &names, const std::string &name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

}  // namespace

std::optional<Plot> case_plot(const std::string &title, const std::vector<CaseCurve> &runs) {
  std::vector<std::string> cases, tests;
  std::vector<Line> lines;
  for (const CaseCurve &run : runs) {
    if (!run.curve || !has_columns(*run.curve)) continue;
    const std::size_t of_case = place_of(cases, run.name);
    if (of_case >= most_cases_drawn) continue;
    place_of(tests, run.test);
    Line line{run.test, of_case, run.curve->column("displacement"), platen_force(*run.curve)};
    const std::size_t count = drawn(line.force);
    line.way.resize(count), line.force.resize(count);
    lines.push_back(std::move(line));
  }
  if (lines.empty()) return {};

  Plot plot;
  plot.name = "curves";
  plot.title = title;
  plot.sentence = fmt::format(
      "Mean force of both platens against the displacement, a line a case, its first packing{}.",
      cases.size() > most_cases_drawn
          ? fmt::format("; the first {} of {} cases", most_cases_drawn, cases.size())
          : "");
  plot.columns = tests.size() > 1 ? 2 : 1;
  const auto rows = (tests.size() + 1) / 2;
  plot.width = tests.size() > 1 ? 900 : 560;
  plot.height = 300 * static_cast<double>(rows) + 90;
  std::vector<bool> named(cases.size(), false);
  for (const std::string &test : tests) {
    std::vector<const Line *> of_test;
    for (const Line &line : lines)
      if (line.test == test) of_test.push_back(&line);
    plot.panels.push_back(panel_of(test, of_test, cases, named));
  }
  return plot;
}

}  // namespace bondlab
