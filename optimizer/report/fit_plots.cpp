// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/fit_plots.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/units.h"
#include "report/number_text.h"

namespace bondlab {
namespace {

struct Phase {
  std::string label;
  Look look;
  const char *colour;
};

Phase phase_of(const std::string &phase) {
  if (phase == "design") return {"design (Latin hypercube)", Look::rings, "series-5"};
  if (phase == "noise") return {"noise (small steps, same point)", Look::crosses, "series-4"};
  if (phase == "refine") return {"refine (Levenberg-Marquardt)", Look::points, "series-1"};
  if (phase == "polish") return {"polish", Look::points, "series-3"};
  if (phase == "derivatives")
    return {"derivatives (steps about a point)", Look::crosses, "series-5"};
  return {phase, Look::crosses, "series-4"};
}

std::string axis_name(const std::string &name, const std::string &unit) {
  return unit.empty() || unit == "1" ? name : name + " (" + unit + ")";
}

// Series of one panel, one a phase, in the order in which the phases first appear.
class ByPhase {
 public:
  void add(const std::string &phase, double x, double y) {
    const Phase look = phase_of(phase);
    for (PlotSeries &s : series_)
      if (s.label == look.label) {
        s.x.push_back(x), s.y.push_back(y);
        return;
      }
    PlotSeries s;
    s.label = look.label, s.look = look.look, s.colour = look.colour;
    s.x = {x}, s.y = {y};
    series_.push_back(std::move(s));
  }
  void move_to(PlotPanel &panel) {
    for (PlotSeries &s : series_) panel.series.push_back(std::move(s));
  }

 private:
  std::vector<PlotSeries> series_;
};

PlotSeries make(std::string label, Look look, const char *colour, std::vector<double> x,
                std::vector<double> y) {
  PlotSeries s;
  s.label = std::move(label), s.look = look, s.colour = colour, s.x = std::move(x),
  s.y = std::move(y);
  return s;
}

PlotSeries band(std::string label, double left, double right, double low, double high) {
  PlotSeries s = make(std::move(label), Look::band, "band", {left, right}, {low, low});
  s.high = {high, high};
  return s;
}

const ReportTarget *find_target(const ReportFit &fit, const std::string &name) {
  for (const ReportTarget &target : fit.targets)
    if (target.name == name) return &target;
  return nullptr;
}

Conflict conflict_of(const ReportInput &input, const ReportTarget &above,
                     const ReportTarget &below) {
  Conflict conflict;
  conflict.above = above, conflict.below = below;
  for (const ReportPoint &point : input.points) {
    const auto a = point.responses.find(above.name), b = point.responses.find(below.name);
    if (a == point.responses.end() || b == point.responses.end() || !(b->second > 0) ||
        !(a->second > 0))
      continue;
    conflict.above_values.push_back(a->second);
    conflict.below_values.push_back(b->second);
    conflict.ratios.push_back(to_si(a->second, above.unit) / to_si(b->second, below.unit));
  }
  const double a = to_si(above.measured, above.unit), b = to_si(below.measured, below.unit);
  conflict.measured = a / b;
  conflict.measured_sd =
      conflict.measured * std::hypot(above.sd / above.measured, below.sd / below.measured);
  return conflict;
}

// Standard deviation of the logarithm: how little a ratio can be moved.
double log_scatter(const std::vector<double> &values) {
  double sum = 0, squares = 0;
  for (const double value : values)
    sum += std::log(value), squares += std::log(value) * std::log(value);
  const double n = static_cast<double>(values.size());
  return std::sqrt(std::max(0.0, squares / n - sum / n * sum / n));
}

}  // namespace

std::optional<Plot> misfit_plot(const ReportFit &fit) {
  PlotPanel panel;
  panel.x.label = "parameter sets tried";
  panel.x.from_zero = true;
  panel.y.label = "misfit (sum of squares, in sd)";
  ByPhase points;
  PlotSeries best = make("best so far", Look::steps, "ink", {}, {});
  double smallest = INFINITY, greatest = 0;
  double number = 0;
  for (const ReportStep &step : fit.history) {
    ++number;
    if (std::isfinite(step.misfit)) points.add(step.phase, number, step.misfit);
    if (std::isfinite(step.best_misfit))
      best.x.push_back(number), best.y.push_back(step.best_misfit);
    for (const double value : {step.misfit, step.best_misfit})
      if (std::isfinite(value) && value > 0)
        smallest = std::min(smallest, value), greatest = std::max(greatest, value);
  }
  if (best.x.empty() && !(greatest > 0)) return std::nullopt;
  panel.y.logarithmic = greatest > 0;
  panel.series.push_back(std::move(best));
  points.move_to(panel);
  Plot plot;
  plot.title = "Misfit: fit \u201c" + fit.name + "\u201d";
  plot.sentence =
      "Sum of the squared differences between simulated and measured values, each divided by the "
      "measured standard deviation, for " +
      counted(static_cast<long>(fit.history.size()), "parameter set", "parameter sets") +
      " (up to " + counted(fit.history.back().runs, "forward run", "forward runs") +
      "); the line is the best one so far.";
  plot.width = 540, plot.height = 340;
  plot.panels.push_back(std::move(panel));
  return plot;
}

std::optional<Plot> parameter_plot(const ReportFit &fit) {
  if (fit.history.empty() || fit.parameters.empty()) return std::nullopt;
  Plot plot;
  const double last = static_cast<double>(fit.history.size());
  for (std::size_t p = 0; p < fit.parameters.size(); ++p) {
    const ReportParameter &parameter = fit.parameters[p];
    PlotPanel panel;
    panel.x.label = "parameter sets tried";
    panel.x.from_zero = true;
    panel.y.label = axis_name(parameter.name, parameter.unit);
    panel.y.logarithmic = parameter.logarithmic && parameter.lower > 0;
    const double low = parameter.interval_lower, high = parameter.interval_upper;
    if (std::isfinite(low) && std::isfinite(high))
      panel.series.push_back(band("95 % interval of the result", 0, last, low, high));
    if (std::isfinite(parameter.lower))
      panel.series.push_back(
          make("bounds", Look::dashed, "quiet", {0, last}, {parameter.lower, parameter.lower}));
    if (std::isfinite(parameter.upper))
      panel.series.push_back(
          make("bounds", Look::dashed, "quiet", {0, last}, {parameter.upper, parameter.upper}));
    if (std::isfinite(parameter.value))
      panel.series.push_back(
          make("result", Look::line, "series-2", {0, last}, {parameter.value, parameter.value}));
    ByPhase points;
    double number = 0;
    for (const ReportStep &step : fit.history)
      if (++number; p < step.parameters.size()) points.add(step.phase, number, step.parameters[p]);
    points.move_to(panel);
    plot.panels.push_back(std::move(panel));
  }
  const int count = static_cast<int>(plot.panels.size());
  plot.columns = std::min(3, count);
  const int rows = (count + plot.columns - 1) / plot.columns;
  plot.title = "Parameters: fit \u201c" + fit.name + "\u201d";
  plot.sentence =
      "Where the fit looked: each point is a parameter set that was run, between the bounds it may "
      "not leave.";
  plot.width = count == 1 ? 540 : 1100;
  plot.height = 50 + 250 * rows;
  return plot;
}

std::optional<Plot> response_plot(const ReportInput &input) {
  if (input.fits.empty() || input.points.empty()) return std::nullopt;
  const ReportFit &fit = input.fits.front();
  Plot plot;
  const auto missing = [&](const ReportTarget &target) {
    return std::none_of(input.points.begin(), input.points.end(), [&](const ReportPoint &point) {
      return point.responses.count(target.name) > 0;
    });
  };
  std::size_t rows = 0;
  for (const ReportTarget &target : fit.targets) {
    if (missing(target)) continue;
    ++rows;
    for (std::size_t p = 0; p < fit.parameters.size(); ++p) {
      const ReportParameter &parameter = fit.parameters[p];
      PlotPanel panel;
      panel.x.label = axis_name(parameter.name, parameter.unit);
      panel.x.logarithmic = parameter.logarithmic && parameter.lower > 0;
      panel.y.label = axis_name(target.name, target.unit);
      ByPhase points;
      double left = INFINITY, right = -INFINITY;
      for (const ReportPoint &point : input.points) {
        const auto value = point.responses.find(target.name);
        if (value == point.responses.end() || p >= point.parameters.size()) continue;
        left = std::min(left, point.parameters[p]), right = std::max(right, point.parameters[p]);
        points.add(point.phase, point.parameters[p], value->second);
      }
      if (std::isfinite(target.measured)) {
        const double sd = std::isfinite(target.sd) ? target.sd : 0;
        if (std::isfinite(left))
          panel.series.push_back(
              band("measured \u00b1 sd", left, right, target.measured - sd, target.measured + sd));
      }
      points.move_to(panel);
      if (std::isfinite(parameter.value) && std::isfinite(target.simulated)) {
        PlotSeries result =
            make("result", Look::points, "series-2", {parameter.value}, {target.simulated});
        result.weight = 1.7;
        panel.series.push_back(std::move(result));
      }
      plot.panels.push_back(std::move(panel));
    }
  }
  if (rows == 0 || fit.parameters.empty()) return std::nullopt;
  // Panels of one row share the left axis only if they span the same values.
  for (std::size_t row = 0; row < rows; ++row) {
    double low = INFINITY, high = -INFINITY;
    for (std::size_t p = 0; p < fit.parameters.size(); ++p)
      for (const PlotSeries &s : plot.panels[row * fit.parameters.size() + p].series) {
        for (const double value : s.y) low = std::min(low, value), high = std::max(high, value);
        for (const double value : s.high) high = std::max(high, value);
      }
    const double pad = 0.06 * (high > low ? high - low : std::fabs(high) + 1e-300);
    for (std::size_t p = 0; p < fit.parameters.size(); ++p) {
      PlotAxis &axis = plot.panels[row * fit.parameters.size() + p].y;
      axis.low = low - pad, axis.high = high + pad;
    }
  }
  for (std::size_t p = 0; p < fit.parameters.size();
       ++p) {  // and those of one column the lower one
    double low = INFINITY, high = -INFINITY;
    for (std::size_t row = 0; row < rows; ++row)
      for (const PlotSeries &s : plot.panels[row * fit.parameters.size() + p].series)
        for (const double value : s.x) low = std::min(low, value), high = std::max(high, value);
    const bool logarithmic = plot.panels[p].x.logarithmic && low > 0;
    const double pad =
        high > low ? (logarithmic ? std::pow(high / low, 0.05) : 0.05 * (high - low)) : 0;
    for (std::size_t row = 0; row < rows && pad > 0; ++row) {
      PlotAxis &axis = plot.panels[row * fit.parameters.size() + p].x;
      axis.low = logarithmic ? low / pad : low - pad,
      axis.high = logarithmic ? high * pad : high + pad;
    }
  }
  plot.columns = static_cast<int>(fit.parameters.size());
  plot.shared_axes = true;
  plot.title = "Responses over the parameters";
  plot.sentence =
      "What each parameter does to each response: every parameter set that was run, on the packing "
      "of the fit, "
      "against the band that was measured.";
  plot.width = fit.parameters.size() == 1 ? 540 : 1100;
  plot.height = 76 + 165 * static_cast<double>(rows);
  return plot;
}

std::optional<Conflict> find_conflict(const ReportInput &input) {
  if (input.fits.empty()) return std::nullopt;
  const ReportFit &all = input.fits.size() > 1 ? input.fits[1] : input.fits.front();
  const auto usable = [](const Conflict &conflict) {
    return conflict.ratios.size() >= 3 && conflict.measured > 0;
  };
  for (const ReportFit *fit : {&all, &input.fits.front()})
    for (const ReportFinding &finding : fit->findings) {
      if (finding.kind != "unreachable_ratio" || finding.targets.size() != 2) continue;
      const ReportTarget *above = find_target(input.fits.front(), finding.targets[0]);
      const ReportTarget *below = find_target(input.fits.front(), finding.targets[1]);
      if (!above || !below) continue;
      Conflict conflict = conflict_of(input, *above, *below);
      if (usable(conflict)) return conflict;
    }
  const ReportTarget *worst = nullptr;
  const auto miss = [](const ReportTarget &t) { return std::fabs(t.simulated / t.measured - 1); };
  for (const ReportTarget &target : input.fits.front().targets)
    if (!target.met && std::isfinite(target.simulated) && (!worst || miss(target) > miss(*worst)))
      worst = &target;
  if (!worst) return std::nullopt;
  std::optional<Conflict> best;
  for (const ReportTarget &other : input.fits.front().targets) {
    if (other.name == worst->name || !same_dimension(other.unit, worst->unit)) continue;
    Conflict conflict = conflict_of(input, other, *worst);
    if (usable(conflict) && (!best || log_scatter(conflict.ratios) < log_scatter(best->ratios)))
      best = std::move(conflict);
  }
  return best;
}

Plot conflict_plot(const Conflict &conflict) {
  const ReportTarget &above = conflict.above, &below = conflict.below;
  const std::string ratio = above.name + " / " + below.name;
  Plot plot;
  PlotPanel plane;
  plane.x.label = axis_name(below.name, below.unit);
  plane.y.label = axis_name(above.name, above.unit);
  plane.x.from_zero = plane.y.from_zero = true;
  const double furthest =
      1.05 * std::max(below.measured, *std::max_element(conflict.below_values.begin(),
                                                        conflict.below_values.end()));
  const double highest =
      1.05 * std::max(above.measured, *std::max_element(conflict.above_values.begin(),
                                                        conflict.above_values.end()));
  const double slope = above.measured / below.measured;
  const double end = std::min(furthest, highest / slope);
  plane.series.push_back(
      make("measured ratio", Look::dashed, "series-2", {0, end}, {0, slope * end}));
  plane.series.push_back(make("parameter sets run", Look::points, "series-1", conflict.below_values,
                              conflict.above_values));
  PlotSeries rock = make("measured", Look::points, "series-2", {below.measured}, {above.measured});
  rock.weight = 1.8;
  plane.series.push_back(rock);

  PlotPanel list;
  list.x.label = "parameter set";
  list.x.from_zero = true;
  list.y.label = ratio;
  list.y.from_zero = true;
  std::vector<double> number(conflict.ratios.size());
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<double>(i + 1);
  const double right = static_cast<double>(number.size()) + 1;
  if (std::isfinite(conflict.measured_sd))
    list.series.push_back(band("measured \u00b1 sd", 0, right,
                               conflict.measured - conflict.measured_sd,
                               conflict.measured + conflict.measured_sd));
  list.series.push_back(make("measured ratio", Look::dashed, "series-2", {0, right},
                             {conflict.measured, conflict.measured}));
  list.series.push_back(
      make("parameter sets run", Look::points, "series-1", number, conflict.ratios));
  const auto ends = std::minmax_element(conflict.ratios.begin(), conflict.ratios.end());
  plot.title = "Which ratio " + ratio + " the model reaches";
  plot.sentence =
      counted(static_cast<long>(conflict.ratios.size()), "parameter set", "parameter sets") +
      " gave " + ratio + " between " + significant(*ends.first, 3) + " and " +
      significant(*ends.second, 3) + "; measured is " + significant(conflict.measured, 3) + ".";
  plot.columns = 2;
  plot.width = 1100, plot.height = 380;
  plot.panels = {std::move(plane), std::move(list)};
  return plot;
}

}  // namespace bondlab
