// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/palette.h"

namespace bondlab {
namespace {

constexpr double font_size = 12, character_width = 6.9, legend_row = 19;

// A gnuplot string constant. Single quotes: no escapes, no command substitution; a quote inside is
// doubled.
std::string quoted(const std::string &text) {
  std::string result = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += ' ';
    else if (c == '\'')
      result += "''";
    else if (c == '>' && result.size() > 2 && result.compare(result.size() - 2, 2, "]]") == 0)
      result += " >";  // "]]>" may not stand in XML text, and gnuplot doesn't escape '>'
    else
      result += c;
  }
  return result + "'";
}

std::string comment(const std::string &text) {
  std::string result = text;
  for (char &c : result)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return result;
}

std::string number(double value) { return fmt::format("{:.10g}", value); }

bool drawable(const PlotSeries &series, std::size_t i) {
  if (i >= series.x.size() || i >= series.y.size()) return false;
  if (series.look == Look::band && (i >= series.high.size() || !std::isfinite(series.high[i])))
    return false;
  return std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
}

bool drawable(const PlotSeries &series) {
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (drawable(series, i)) return true;
  return false;
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void take(double value) { low = std::min(low, value), high = std::max(high, value); }
  bool empty() const { return !(low <= high); }
};

Range padded(Range range, const PlotAxis &axis) {
  if (range.empty()) range = axis.logarithmic ? Range{0.1, 10} : Range{0, 1};
  if (axis.from_zero) range.take(0);
  const bool sits_on_zero = axis.from_zero && range.low == 0;
  if (axis.logarithmic) {
    if (range.low <= 0) range.low = range.high > 0 ? range.high * 1e-6 : 0.1;
    if (range.high <= range.low) range = {range.low / 2, range.low * 2};
    const double pad = std::pow(range.high / range.low, 0.05);
    range = {range.low / pad, range.high * pad};
  } else {
    double span = range.high - range.low;
    if (span <= 0) span = range.high != 0 ? std::fabs(range.high) : 1;
    range = {sits_on_zero ? 0 : range.low - 0.04 * span, range.high + 0.06 * span};
  }
  if (axis.low) range.low = *axis.low;
  if (axis.high) range.high = *axis.high;
  if (!(range.low < range.high))
    range.high = range.low + (range.low != 0 ? std::fabs(range.low) : 1);
  return range;
}

Range range_of(const PlotPanel &panel, char which) {
  Range range;
  const PlotAxis &axis = which == 'x' ? panel.x : which == 'y' ? panel.y : panel.right;
  for (const PlotSeries &series : panel.series) {
    if (which != 'x' && series.right_axis != (which == 'r')) continue;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!drawable(series, i)) continue;
      for (const double value : which == 'x' ? std::vector<double>{series.x[i]}
                                : series.look == Look::band
                                    ? std::vector<double>{series.y[i], series.high[i]}
                                    : std::vector<double>{series.y[i]})
        if (!axis.logarithmic || value > 0) range.take(value);
    }
  }
  return padded(range, axis);
}

// Round places inside the range, about one each `pitch` pixels. On a logarithmic axis the coarsest
// of a few series of round numbers that gives three of them, since a range such as 15 to 45 holds
// no power of ten.
std::vector<double> ticks_in(Range range, const PlotAxis &axis, double pixels, double pitch) {
  std::vector<double> ticks;
  if (axis.logarithmic) {
    const int first = static_cast<int>(std::floor(std::log10(range.low))),
              last = static_cast<int>(std::floor(std::log10(range.high)));
    const int stride =
        std::max(1, static_cast<int>((last - first) / std::max(2.0, pixels / pitch)));
    for (const std::vector<double> &digits :
         {std::vector<double>{1}, {1, 3}, {1, 2, 5}, {1, 1.5, 2, 3, 5, 7}}) {
      ticks.clear();
      for (int power = first; power <= last; power += stride)
        for (const double digit : digits) {
          const double tick = digit * std::pow(10, power);
          if (tick >= range.low && tick <= range.high) ticks.push_back(tick);
        }
      if (ticks.size() >= 3) return ticks;
    }
    ticks.clear();
  }
  const double wanted = (range.high - range.low) / std::max(2.0, pixels / pitch);
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= 0.999 * wanted) step = factor * power;
  if (axis.whole_numbers) step = std::max(1.0, step);
  const double first = std::ceil(range.low / step - 1e-9);
  for (int i = 0; i < 100 && (first + i) * step <= range.high + 1e-9 * step; ++i)
    ticks.push_back((first + i) * step);
  return ticks;
}

std::string style_of(const PlotSeries &s) {
  const std::string colour = fmt::format("lc rgb \"{}\"", light(s.colour));
  const std::string width = number(1.7 * s.weight), size = number(0.5 * s.weight);
  switch (s.look) {
    case Look::line:
      return "with lines lw " + width + " " + colour;
    case Look::dashed:
      return "with lines lw " + number(1.3 * s.weight) + " dt (6,4) " + colour;
    case Look::steps:
      return "with steps lw " + width + " " + colour;
    case Look::points:
      return "with points pt 7 ps " + size + " " + colour;
    case Look::rings:
      return "with points pt 6 lw 1.2 ps " + number(0.75 * s.weight) + " " + colour;
    case Look::crosses:
      return "with points pt 2 lw 1.3 ps " + number(0.8 * s.weight) + " " + colour;
    case Look::band:
      return "with filledcurves fs solid 1.0 noborder " + colour;
  }
  return "";
}

double sample_width(Look look) {
  return look == Look::points || look == Look::rings || look == Look::crosses ? 12 : 24;
}

struct LegendEntry {
  PlotSeries series;
  double x = 0;
  int row = 0;
};

std::vector<LegendEntry> legend_of(const Plot &plot) {
  std::vector<LegendEntry> entries;
  std::vector<const PlotSeries *> all;
  for (const PlotPanel &panel : plot.panels)
    for (const PlotSeries &series : panel.series)
      if (drawable(series)) all.push_back(&series);
  double x = 12;
  int row = 0;
  for (const PlotSeries *series : all) {
    if (series->label.empty()) continue;
    const bool known = std::any_of(entries.begin(), entries.end(), [&](const LegendEntry &e) {
      return e.series.label == series->label;
    });
    if (known) continue;
    std::size_t characters = 0;
    for (const char c : series->label) characters += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    const double need =
        sample_width(series->look) + 6 + character_width * static_cast<double>(characters) + 14;
    if (x > 12 && x + need > plot.width) x = 12, ++row;
    LegendEntry entry;
    entry.series.label = series->label;
    entry.series.look = series->look;
    entry.series.colour = series->colour;
    entry.series.weight = series->weight;
    entry.x = x;
    entry.row = row;
    entries.push_back(entry);
    x += need;
  }
  return entries;
}

// Legend samples and words, at fixed places of the whole picture; `undo` takes them off again for
// the next panels.
void write_legend(std::string &out, std::string &undo, const Plot &plot,
                  const std::vector<LegendEntry> &entries) {
  const auto at = [&](double x, double y) {
    return fmt::format("screen {}, screen {}", number(x / plot.width), number(1 - y / plot.height));
  };
  int tag = 0;
  for (const LegendEntry &entry : entries) {
    const double y = 14 + legend_row * entry.row;
    ++tag;
    const std::string colour = fmt::format("lc rgb \"{}\"", light(entry.series.colour));
    switch (entry.series.look) {
      case Look::band:
        out += fmt::format(
            "set object {} rectangle from {} to {} fc rgb \"{}\" fs solid noborder\n", tag,
            at(entry.x, y + 5), at(entry.x + 24, y - 5), light(entry.series.colour));
        break;
      case Look::points:
      case Look::rings:
      case Look::crosses: {
        const char *point = entry.series.look == Look::points  ? "7"
                            : entry.series.look == Look::rings ? "6"
                                                               : "2";
        out += fmt::format("set label {} '' at {} point pt {} ps 0.8 {}\n", 100 + tag,
                           at(entry.x + 6, y), point, colour);
        undo += fmt::format("unset label {}\n", 100 + tag);
        break;
      }
      default:
        out += fmt::format("set arrow {} from {} to {} nohead lw 2 {} {}\n", tag, at(entry.x, y),
                           at(entry.x + 24, y), entry.series.look == Look::dashed ? "dt (6,4)" : "",
                           colour);
    }
    out += fmt::format("set label {} {} at {} left noenhanced textcolor rgb \"{}\"\n", tag,
                       quoted(entry.series.label),
                       at(entry.x + sample_width(entry.series.look) + 6, y), light("ink"));
    undo += fmt::format("unset label {}\n", tag);
  }
  undo += "unset arrow\nunset object\n";
}

std::string axis_lines(const char *name, const PlotAxis &axis, Range range, bool labels,
                       double pixels, double pitch) {
  std::string out =
      fmt::format("set {}range [{}:{}]\n", name, number(range.low), number(range.high));
  out += axis.logarithmic ? fmt::format("set logscale {}\n", name)
                          : fmt::format("unset logscale {}\n", name);
  std::string places;
  for (const double tick : ticks_in(range, axis, pixels, pitch))
    places += (places.empty() ? "" : ", ") + number(tick);
  out += fmt::format("set {}tics nomirror scale 0.5 textcolor rgb \"{}\" format {} ({})\n", name,
                     light("quiet"), labels ? "'%g'" : "''", places);
  out += fmt::format("set {}label {} noenhanced textcolor rgb \"{}\"\n", name,
                     labels ? quoted(axis.label) : "''", light("ink"));
  return out;
}

}  // namespace

bool PlotPanel::has_right_axis() const {
  return std::any_of(series.begin(), series.end(),
                     [](const PlotSeries &s) { return s.right_axis && drawable(s); });
}

void thin_out(std::vector<double> &x, std::vector<double> &y, std::size_t limit) {
  const std::size_t count = std::min(x.size(), y.size());
  if (count <= limit || limit < 4) return;
  std::vector<double> few_x{x.front()}, few_y{y.front()};
  const std::size_t buckets = (limit - 2) / 2;
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::size_t first = 1 + b * (count - 2) / buckets,
                      last = 1 + (b + 1) * (count - 2) / buckets;
    std::size_t low = first, high = first;
    for (std::size_t i = first; i < last; ++i) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
    }
    for (const std::size_t i : {std::min(low, high), std::max(low, high)}) {
      if (i != low && i != high) continue;
      few_x.push_back(x[i]), few_y.push_back(y[i]);
      if (low == high) break;
    }
  }
  few_x.push_back(x[count - 1]), few_y.push_back(y[count - 1]);
  x = std::move(few_x), y = std::move(few_y);
}

std::string plot_data(const Plot &plot) {
  std::string out = "# bondlab-plot 1\n# " + comment(plot.title) + ": " + comment(plot.sentence) +
                    "\n# columns: x, y (and the upper edge of a band); one block a series\n";
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    const PlotPanel &panel = plot.panels[p];
    for (const PlotSeries &series : panel.series) {
      if (!drawable(series)) continue;
      out += fmt::format("# panel {}: x = {}; y = {}; series: {}\n", p + 1, comment(panel.x.label),
                         comment(series.right_axis ? panel.right.label : panel.y.label),
                         comment(series.label));
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!drawable(series, i)) continue;
        out += number(series.x[i]) + "\t" + number(series.y[i]);
        if (series.look == Look::band) out += "\t" + number(series.high[i]);
        out += "\n";
      }
      out += "\n\n";
    }
  }
  return out;
}

std::string plot_script(const Plot &plot) {
  const std::vector<LegendEntry> legend = legend_of(plot);
  const int legend_rows = legend.empty() ? 0 : legend.back().row + 1;
  const int columns = std::max(1, plot.columns);
  const int rows = std::max<int>(1, (static_cast<int>(plot.panels.size()) + columns - 1) / columns);
  const bool right = std::any_of(plot.panels.begin(), plot.panels.end(),
                                 [](const PlotPanel &p) { return p.has_right_axis(); });
  const double top = 12 + legend_row * legend_rows, margin_left = 66, margin_bottom = 56,
               margin_right = right ? 62 : 16;
  const double cell_width =
      plot.shared_axes ? (plot.width - margin_left - margin_right) / columns : plot.width / columns;
  const double cell_height =
      plot.shared_axes ? (plot.height - top - margin_bottom) / rows : (plot.height - top) / rows;

  std::string out =
      "# Draws " + plot.name + ".svg from " + plot.name + ".tsv: gnuplot " + plot.name + ".gp\n";
  out += fmt::format(
      "set encoding utf8\nset terminal svg size {},{} fixed font \"sans-serif,{}\" background rgb "
      "\"{}\"\n",
      number(plot.width), number(plot.height), number(font_size), light("paper"));
  out += fmt::format(
      "set output \"{}.svg\"\nset minussign\nset datafile separator \"\\t\"\nunset key\n",
      plot.name);
  out += fmt::format("set border 3 lw 1 lc rgb \"{}\"\nset grid lw 1 lt 1 dt 1 lc rgb \"{}\"\n",
                     light("rule"), light("grid"));
  out += "set multiplot\n";
  std::string undo;
  write_legend(out, undo, plot, legend);

  std::size_t index = 0;
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    const PlotPanel &panel = plot.panels[p];
    const int row = static_cast<int>(p) / columns, column = static_cast<int>(p) % columns;
    const double x0 = plot.shared_axes ? margin_left + column * cell_width + 5
                                       : column * cell_width + margin_left;
    const double x1 = plot.shared_axes ? margin_left + (column + 1) * cell_width - 5
                                       : (column + 1) * cell_width - margin_right;
    const double y0 = top + row * cell_height + (plot.shared_axes ? 5 : 8);
    const double y1 = top + (row + 1) * cell_height - (plot.shared_axes ? 5 : margin_bottom);
    out += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin "
        "at screen {}\n",
        number(x0 / plot.width), number(x1 / plot.width), number(1 - y0 / plot.height),
        number(1 - y1 / plot.height));
    const bool bottom_labels = !plot.shared_axes || p + columns >= plot.panels.size();
    out += axis_lines("x", panel.x, range_of(panel, 'x'), bottom_labels, x1 - x0, 58);
    out += axis_lines("y", panel.y, range_of(panel, 'y'), !plot.shared_axes || column == 0, y1 - y0,
                      34);
    if (panel.has_right_axis()) {
      out += axis_lines("y2", panel.right, range_of(panel, 'r'), true, y1 - y0, 34) +
             "set border 11\n";
    } else if (right) {
      out += "unset y2tics\nset y2label ''\nset border 3\n";
    }
    std::string lines;
    for (const PlotSeries &series : panel.series) {
      if (!drawable(series)) continue;
      lines += fmt::format("{}\"{}.tsv\" index {} using {} axes x1{} {} notitle",
                           lines.empty() ? "" : ", \\\n  ", plot.name, index++,
                           series.look == Look::band ? "1:2:3" : "1:2",
                           series.right_axis ? "y2" : "y1", style_of(series));
    }
    if (lines.empty()) {
      out += fmt::format(
          "set label 999 'no data' at graph 0.5, graph 0.5 center textcolor rgb \"{}\"\nplot NaN "
          "notitle\nunset label 999\n",
          light("quiet"));
    } else {
      out += "plot " + lines + "\n";
    }
    if (p == 0) out += undo;
  }
  return out + "unset multiplot\nunset output\n";
}

}  // namespace bondlab
