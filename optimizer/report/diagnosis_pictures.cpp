// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/diagnosis_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/html.h"

namespace bondlab::diagnose {

namespace {

constexpr int least_left = 150, letter = 7, top = 44, cell_width = 62, cell_height = 20,
              between = 30;
constexpr double full_colour = 6;  // noise units

struct Cell {
  double sum = 0;
  int count = 0;
  double score() const { return sum / std::sqrt(static_cast<double>(count)); }
};

// White at none, red above, blue below.
std::string colour(double score) {
  const double share = std::clamp(std::abs(score) / full_colour, 0.0, 1.0);
  const int other = static_cast<int>(255 - 175 * share), own = static_cast<int>(255 - 40 * share);
  return score > 0 ? fmt::format("rgb({},{},{})", own, other, other)
                   : fmt::format("rgb({},{},{})", other, other, own);
}

std::string label(double x, double y, const char *anchor, const std::string &text) {
  return fmt::format(
      "<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"{}\" font-size=\"12\">{}</text>", x, y, anchor,
      html_text(text));
}

const std::vector<std::string> along = {"strain_axial", "strain_platen", "displacement"},
                               across = {"axial_stress", "force_top"};

const std::vector<double> *first_of(const Curve &c, const std::vector<std::string> &names) {
  for (const auto &name : names)
    if (c.has(name)) return &c.column(name);
  return nullptr;
}

// "axial stress (Pa)" of the column that is drawn.
std::string axis(const Curve &c, const std::vector<std::string> &names) {
  for (const auto &name : names) {
    if (!c.has(name)) continue;
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    const auto at = std::find(c.names.begin(), c.names.end(), name) - c.names.begin();
    const std::string unit = c.units.at(static_cast<std::size_t>(at));
    return unit == "1" ? words : fmt::format("{} ({})", words, unit);
  }
  return "";
}

std::string polyline(const Curve &c, double x_most, double y_most, const char *style) {
  const auto *x = first_of(c, along);
  const auto *y = first_of(c, across);
  if (!x || !y) return "";
  std::string points;
  for (std::size_t i = 0; i < x->size(); ++i)
    points += fmt::format("{:.1f},{:.1f} ", 40 + 420 * std::clamp((*x)[i] / x_most, 0.0, 1.0),
                          260 - 240 * std::clamp((*y)[i] / y_most, 0.0, 1.0));
  return fmt::format("<polyline fill=\"none\" {} points=\"{}\"/>", style, points);
}

}  // namespace

std::string curve_picture(const ShownSeries &s) {
  double x_most = 0, y_most = 0;
  const auto widen = [&](const Curve &c) {
    if (const auto *x = first_of(c, along))
      for (const double v : *x) x_most = std::max(x_most, v);
    if (const auto *y = first_of(c, across))
      for (const double v : *y) y_most = std::max(y_most, v);
  };
  for (const auto &c : s.measured) widen(c);
  widen(s.before), widen(s.after);
  if (!(x_most > 0) || !(y_most > 0)) return "";
  const Curve *shown = first_of(s.before, across) ? &s.before : &s.after;
  for (const auto &c : s.measured)
    if (!first_of(*shown, across)) shown = &c;
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 480 290\" width=\"480\">"
      "<path d=\"M40 20V260H460\" stroke=\"#888\" fill=\"none\"/>";
  for (const auto &c : s.measured)
    svg += polyline(c, x_most, y_most, "stroke=\"#999\" stroke-width=\"1\"");
  svg += polyline(s.before, x_most, y_most,
                  "stroke=\"#c33\" stroke-width=\"2\" stroke-dasharray=\"6 3\"");
  svg += polyline(s.after, x_most, y_most, "stroke=\"#17a\" stroke-width=\"2\"");
  svg += fmt::format(
      "<text x=\"460\" y=\"280\" text-anchor=\"end\" font-size=\"12\">{}, to {:.3g}</text>"
      "<text x=\"44\" y=\"16\" font-size=\"12\">{}, to {:.3g}</text></svg>",
      axis(*shown, along), x_most, axis(*shown, across), y_most);
  return svg;
}

std::string where_picture(const StudyDiagnosis &d) {
  std::vector<std::string> series;
  std::vector<CurvePart> parts;
  const auto place = [](auto &list, const auto &value) {
    const auto found = std::find(list.begin(), list.end(), value);
    if (found == list.end()) list.push_back(value);
  };
  for (const auto &row : d.rows) place(series, row.series), place(parts, row.part);
  if (series.empty()) return "";
  std::sort(parts.begin(), parts.end());
  const auto &before = d.diagnosis.before.residual, &after = d.diagnosis.after.residual;
  const auto count = static_cast<Eigen::Index>(d.rows.size());
  if (before.size() != count || after.size() != count) return "";
  const int columns = static_cast<int>(parts.size()), block = columns * cell_width + between;
  std::size_t longest = 0;
  for (const auto &name : series) longest = std::max(longest, name.size());
  const int left = std::max(least_left, letter * static_cast<int>(longest) + 12);
  const int width = left + 2 * block,
            height = top + static_cast<int>(series.size()) * cell_height + 8;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\">", width,
      height);
  for (std::size_t i = 0; i < series.size(); ++i)
    svg += label(left - 8, top + (static_cast<double>(i) + 0.7) * cell_height, "end", series[i]);
  for (int side = 0; side < 2; ++side) {
    const auto &residual = side == 0 ? before : after;
    std::map<std::pair<std::size_t, std::size_t>, Cell> cells;
    for (Eigen::Index row = 0; row < count; ++row) {
      const auto &key = d.rows[static_cast<std::size_t>(row)];
      const auto i = std::find(series.begin(), series.end(), key.series) - series.begin();
      const auto j = std::find(parts.begin(), parts.end(), key.part) - parts.begin();
      auto &cell = cells[{static_cast<std::size_t>(i), static_cast<std::size_t>(j)}];
      cell.sum += residual(row), ++cell.count;
    }
    const int x0 = left + side * block;
    svg += label(x0, 14, "start", side == 0 ? "best fit before" : "after");
    for (std::size_t j = 0; j < parts.size(); ++j)
      svg += label(x0 + (static_cast<double>(j) + 0.5) * cell_width, top - 8, "middle",
                   to_string(parts[j]));
    for (const auto &[at, cell] : cells) {
      const double x = x0 + static_cast<double>(at.second) * cell_width,
                   y = top + static_cast<double>(at.first) * cell_height;
      svg += fmt::format(
          "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" fill=\"{}\" "
          "stroke=\"#ccc\"/>",
          x, y, cell_width, cell_height, colour(cell.score()));
      svg += label(x + 0.5 * cell_width, y + 0.7 * cell_height, "middle",
                   fmt::format("{:+.1f}", cell.score()));
    }
  }
  return svg + "</svg>";
}

}  // namespace bondlab::diagnose
