// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/envelope_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace bondlab {

namespace {

const char *const kColours[] = {"series-1", "series-2", "series-3", "series-4"};

std::string words_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

double mean(const std::vector<double> &values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Numbers of an envelope in the unit of the plot.
class Converter {
 public:
  Converter(const std::string &from, const std::string &to) : from_(from), to_(to) {}
  double operator()(double value) const { return from_si(to_si(value, from_), to_); }
  std::vector<double> operator()(std::vector<double> values) const {
    for (double &value : values) value = (*this)(value);
    return values;
  }

 private:
  std::string from_, to_;
};

PlotSeries line_through(double x, double y, double degrees, double largest_over) {
  const double slope = std::tan(to_si(degrees, "deg"));
  PlotSeries line;
  for (const double at : {0.0, largest_over}) {
    line.x.push_back(at);
    line.y.push_back(y + slope * (at - x));
  }
  return line;
}

std::string line_words(const Converter &in_unit, double c, double phi, const std::string &unit) {
  std::string words;
  if (std::isfinite(c)) words = fmt::format(" c {:.3g} {}", in_unit(c), unit);
  if (std::isfinite(phi))
    words += fmt::format("{} phi {:.3g}\u00b0", words.empty() ? "" : ",", phi);
  return words;
}

// What the study's targets say of it; nothing when there are none.
void add_measured(PlotPanel &panel, const ReportEnvelope &envelope, const Converter &in_unit,
                  const std::string &unit, double largest_over, const char *colour) {
  const bool cohesion = std::isfinite(envelope.measured_cohesion),
             angle = std::isfinite(envelope.measured_friction_angle);
  if (!cohesion && (!angle || envelope.values.empty())) return;
  PlotSeries measured;
  if (!angle)
    measured.x = {0}, measured.y = {in_unit(envelope.measured_cohesion)};
  else
    measured = line_through(cohesion ? 0 : in_unit(mean(envelope.over_values)),
                            in_unit(cohesion ? envelope.measured_cohesion : mean(envelope.values)),
                            envelope.measured_friction_angle, largest_over);
  measured.look = angle ? Look::dashed : Look::rings;
  measured.colour = colour;
  measured.label =
      envelope.name + " measured:" +
      line_words(in_unit, envelope.measured_cohesion, envelope.measured_friction_angle, unit);
  panel.series.push_back(measured);
}

// What the picture lacks, and why.
std::string missing_words(const ReportEnvelope &envelope) {
  std::string words;
  for (const std::string &test : envelope.left_out)
    words += fmt::format(" Left out of {}: {}.", envelope.name, test);
  if (!envelope.why_none.empty())
    words += fmt::format(" No line for {}: {}.", envelope.name, envelope.why_none);
  return words;
}

}  // namespace

Plot envelope_plot(const std::vector<ReportEnvelope> &envelopes) {
  Plot plot;
  plot.name = "envelopes";
  plot.title = "Strength envelopes";
  plot.width = 520, plot.height = 420;
  plot.sentence = "Each point is one test; the lines are least squares, value = c + over tan(phi)";
  PlotPanel panel;
  const std::string unit = envelopes.empty() ? "Pa" : envelopes.front().unit;
  double largest_over = 0;
  std::string over;
  bool any_measured = false;
  for (const ReportEnvelope &envelope : envelopes) {
    over += over.find(words_of(envelope.over)) == std::string::npos
                ? (over.empty() ? "" : ", ") + words_of(envelope.over)
                : "";
    for (const double value : Converter(envelope.unit, unit)(envelope.over_values))
      largest_over = std::max(largest_over, value);
    any_measured = any_measured || std::isfinite(envelope.measured_cohesion) ||
                   std::isfinite(envelope.measured_friction_angle);
  }
  plot.sentence += any_measured ? "; what was measured is dashed." : ".";
  for (const ReportEnvelope &envelope : envelopes) plot.sentence += missing_words(envelope);
  panel.x.label = fmt::format("{} ({})", over, unit);
  panel.y.label = fmt::format("strength ({})", unit);
  panel.x.from_zero = panel.y.from_zero = true;
  for (std::size_t k = 0; k < envelopes.size(); ++k) {
    const ReportEnvelope &envelope = envelopes[k];
    const Converter in_unit(envelope.unit, unit);
    const char *colour = kColours[k % std::size(kColours)];
    const bool has_line =
        std::isfinite(envelope.cohesion) && std::isfinite(envelope.friction_angle);
    if (has_line) {
      PlotSeries line =
          line_through(0, in_unit(envelope.cohesion), envelope.friction_angle, largest_over);
      line.colour = colour;
      panel.series.push_back(line);
    }
    PlotSeries points;
    points.look = Look::points, points.colour = colour;
    points.x = in_unit(envelope.over_values), points.y = in_unit(envelope.values);
    points.label = envelope.name;
    if (has_line)
      points.label += ":" + line_words(in_unit, envelope.cohesion, envelope.friction_angle, unit);
    panel.series.push_back(points);
    add_measured(panel, envelope, in_unit, unit, largest_over, colour);
  }
  plot.panels.push_back(panel);
  return plot;
}

}  // namespace bondlab
