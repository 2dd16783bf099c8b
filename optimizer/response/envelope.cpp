// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/envelope.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "base/units.h"
#include "response/loading_branch.h"
#include "response/response.h"

namespace bondlab {

namespace {

constexpr std::size_t kFewest = 3;
constexpr double kDegrees = 180 / 3.14159265358979323846;

}  // namespace

EnvelopeLine envelope_line(const std::vector<EnvelopePoint> &points) {
  std::set<double> different;
  std::vector<double> x, y;
  for (const EnvelopePoint &point : points) {
    different.insert(point.over);
    x.push_back(point.over);
    y.push_back(point.value);
  }
  if (different.size() < kFewest)
    throw ResponseError(ResponseCause::window_too_small,
                        fmt::format("{} different abscissae, {} needed for a line with its errors",
                                    different.size(), kFewest));
  const LineFit fit = fit_line(x, y, {0, x.size()});
  EnvelopeLine line;
  line.cohesion = fit.intercept;
  line.cohesion_error = fit.intercept_error;
  line.friction_angle = kDegrees * std::atan(fit.slope);
  line.friction_angle_error = kDegrees * fit.slope_error / (1 + fit.slope * fit.slope);
  return line;
}

StrengthEnvelope envelope_of(const EnvelopeEntry &entry, const Study &study,
                     const std::map<std::string, const ForwardOutcome *> &outcomes) {
  StrengthEnvelope envelope;
  envelope.name = entry.name, envelope.unit = entry.unit;
  envelope.response = entry.response, envelope.over = entry.over;
  for (const std::string &name : entry.tests) {
    const auto found = outcomes.find(name);
    if (found == outcomes.end()) {
      envelope.left_out.push_back(name + ": not run");
      continue;
    }
    const ForwardOutcome &outcome = *found->second;
    if (!outcome.ok) {
      envelope.left_out.push_back(name + ": " + outcome.failure.message);
      continue;
    }
    try {
      const auto &responses = study.test(name).definition.responses;
      const auto figure = [&](const std::string &response) {
        return evaluate(responses.at(response).function, outcome.curve, {outcome.deck_variables});
      };
      const double over = responses.count(entry.over) ? figure(entry.over)
                                                      : outcome.deck_variables.at(entry.over);
      envelope.points.push_back({name, over, figure(entry.response)});
    } catch (const ResponseError &error) {
      envelope.left_out.push_back(name + ": " + error.what());
    }
  }
  try {
    envelope.line = envelope_line(envelope.points);
  } catch (const ResponseError &error) {
    envelope.why_none = error.what();
  }
  return envelope;
}

double envelope_figure(const StrengthEnvelope &envelope, const std::string &figure) {
  if (!envelope.left_out.empty())
    throw ResponseError(ResponseCause::window_too_small,
                        fmt::format("the envelope '{}' lacks the point of {}", envelope.name,
                                    fmt::join(envelope.left_out, "; of ")));
  if (!envelope.line)
    throw ResponseError(ResponseCause::window_too_small,
                        "the envelope '" + envelope.name + "' has no line: " + envelope.why_none);
  return figure == "cohesion" ? envelope.line->cohesion : envelope.line->friction_angle / kDegrees;
}

std::string envelope_text(const StrengthEnvelope &envelope) {
  if (!envelope.line) return "none: " + envelope.why_none;
  const EnvelopeLine &line = *envelope.line;
  return fmt::format("c {:.4g} +- {:.2g} {}, phi {:.4g} +- {:.2g} degrees ({} tests)",
                     from_si(line.cohesion, envelope.unit),
                     from_si(line.cohesion_error, envelope.unit), envelope.unit,
                     line.friction_angle, line.friction_angle_error, envelope.points.size());
}

}  // namespace bondlab
