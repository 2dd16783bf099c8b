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

}  // namespace

Plot envelope_plot(const std::vector<StrengthEnvelope> &envelopes) {
  Plot plot;
  plot.name = "envelopes";
  plot.title = "Strength envelopes";
  plot.width = 520, plot.height = 420;
  plot.sentence = "Each point is one test; the lines are least squares, value = c + over tan(phi).";
  double largest_over = 0;
  std::string over;
  for (const StrengthEnvelope &envelope : envelopes) {
    over += over.find(words_of(envelope.over)) == std::string::npos
                ? (over.empty() ? "" : ", ") + words_of(envelope.over)
                : "";
    for (const EnvelopePoint &point : envelope.points)
      largest_over = std::max(largest_over, point.over);
  }
  PlotPanel panel;
  const std::string unit = envelopes.empty() ? "Pa" : envelopes.front().unit;
  panel.x.label = fmt::format("{} ({})", over, unit);
  panel.y.label = fmt::format("strength ({})", unit);
  panel.x.from_zero = panel.y.from_zero = true;
  for (std::size_t k = 0; k < envelopes.size(); ++k) {
    const StrengthEnvelope &envelope = envelopes[k];
    const char *colour = kColours[k % std::size(kColours)];
    PlotSeries points, line;
    points.look = Look::points, points.colour = line.colour = colour;
    for (const EnvelopePoint &point : envelope.points) {
      points.x.push_back(from_si(point.over, unit));
      points.y.push_back(from_si(point.value, unit));
    }
    points.label = envelope.name;
    if (envelope.line) {
      const double slope = std::tan(envelope.line->friction_angle * 3.14159265358979323846 / 180);
      points.label += fmt::format(": c {:.3g} {}, phi {:.3g}\u00b0", from_si(envelope.line->cohesion, unit),
                                  unit, envelope.line->friction_angle);
      for (const double x : {0.0, largest_over}) {
        line.x.push_back(from_si(x, unit));
        line.y.push_back(from_si(envelope.line->cohesion + slope * x, unit));
      }
      panel.series.push_back(line);
    }
    panel.series.push_back(points);
  }
  plot.panels.push_back(panel);
  return plot;
}

}  // namespace bondlab
