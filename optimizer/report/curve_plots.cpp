// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/curve_plots.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "report/number_text.h"
#include "response/loading_branch.h"
#include "response/response.h"

namespace bondlab {
namespace {

constexpr std::size_t most_points = 1500;
constexpr double pi = 3.14159265358979323846;

AxisUnit suited(double largest, std::initializer_list<AxisUnit> units) {
  AxisUnit best = *units.begin();
  for (const AxisUnit &unit : units)
    if (largest >= unit.factor) best = unit;
  return best;
}

double largest(const std::vector<double> &values) {
  double result = 0;
  for (const double value : values)
    if (std::isfinite(value)) result = std::max(result, std::fabs(value));
  return result;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double &value : values) value *= factor;
  return values;
}

PlotSeries series(std::string label, Look look, const char *colour, std::vector<double> x,
                  std::vector<double> y) {
  thin_out(x, y, most_points);
  PlotSeries result;
  result.label = std::move(label), result.look = look, result.colour = colour;
  result.x = std::move(x), result.y = std::move(y);
  return result;
}

const ReportTarget *target_with(const std::vector<ReportTarget> &targets, const ReportRunFiles &run,
                                const char *function) {
  for (const ReportTarget &target : targets)
    if (target.test == run.test && target.function == function && std::isfinite(target.measured))
      return &target;
  return nullptr;
}

// A horizontal band measured +- sd across the plot; `to_axis` turns the target's SI value into the
// axis' number.
template <class F>
PlotSeries measured_band(const ReportTarget &target, double left, double right, F &&to_axis) {
  const double sd = std::isfinite(target.sd) ? target.sd : 0;
  PlotSeries band;
  band.look = Look::band, band.colour = "band";
  band.label =
      target.name + " measured: " + plus_minus(target.measured, target.sd) + " " + target.unit;
  band.x = {left, right};
  band.y.assign(2, to_axis(to_si(target.measured - sd, target.unit)));
  band.high.assign(2, to_axis(to_si(target.measured + sd, target.unit)));
  return band;
}

void add_broken_bonds(PlotPanel &panel, const Curve &curve, const std::vector<double> &x) {
  if (!curve.has("broken_bonds")) return;
  PlotSeries broken =
      series("broken bonds (right axis)", Look::line, "series-5", x, curve.column("broken_bonds"));
  broken.right_axis = true;
  broken.weight = 0.8;
  panel.series.push_back(std::move(broken));
  panel.right.label = "broken bonds";
  panel.right.from_zero = true;
  panel.right.whole_numbers = true;
}

PlotSeries level(std::string label, const char *colour, double left, double right, double height) {
  return series(std::move(label), Look::dashed, colour, {left, right}, {height, height});
}

std::pair<double, double> span_of(const std::vector<double> &x) {
  const auto ends = std::minmax_element(x.begin(), x.end());
  return x.empty() ? std::make_pair(0.0, 1.0) : std::make_pair(*ends.first, *ends.second);
}

Plot stress_strain(const Curve &curve, const ReportRunFiles &run,
                   const std::vector<ReportTarget> &targets,
                   const std::vector<ReportMeasuredCurve> &measured) {
  const std::vector<double> &stress = curve.column("axial_stress");
  const std::vector<double> axial = scaled(curve.column("strain_axial"), 100);
  std::vector<double> lateral;
  if (curve.has("strain_lateral")) lateral = scaled(curve.column("strain_lateral"), -100);
  const AxisUnit unit =
      suited(largest(stress), {{"Pa", 1}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}});
  const std::vector<double> y = scaled(stress, 1 / unit.factor);
  const auto right = span_of(axial), left = lateral.empty() ? right : span_of(lateral);
  const double low = std::min({right.first, left.first, 0.0}),
               high = std::max(right.second, left.second);

  Plot plot;
  PlotPanel panel;
  panel.x.label = "strain (%): axial to the right, lateral to the left";
  panel.y.label = std::string("axial stress (") + unit.name + ")";
  panel.y.from_zero = true;
  if (const ReportTarget *strength = target_with(targets, run, "uniaxial.peak_stress"))
    panel.series.push_back(
        measured_band(*strength, low, high, [&](double si) { return si / unit.factor; }));
  add_broken_bonds(panel, curve, axial);
  for (const ReportMeasuredCurve &m : measured) {
    const auto column = [&](const char *name) {
      const auto at = std::find(m.names.begin(), m.names.end(), name);
      const auto i = static_cast<std::size_t>(at - m.names.begin());
      return at == m.names.end() || i >= m.columns.size() ? std::vector<double>{} : m.columns[i];
    };
    if (m.test != run.test || column("axial_stress").empty()) continue;
    const std::vector<double> load = scaled(column("axial_stress"), 1 / unit.factor);
    panel.series.push_back(series("measured: " + m.label, Look::line, "series-3",
                                  scaled(column("strain_axial"), 100), load));
    panel.series.push_back(
        series("", Look::line, "series-3", scaled(column("strain_lateral"), -100), load));
  }
  panel.series.push_back(series("axial", Look::line, "series-1", axial, y));
  if (!lateral.empty())
    panel.series.push_back(series("lateral", Look::line, "series-4", lateral, y));
  std::string marks;
  try {
    const std::size_t peak = find_peak(stress);
    const LineFit line =
        fit_line(curve.column("strain_axial"), stress, loading_window(stress, peak));
    const double start = -line.intercept / line.slope,
                 end = (0.95 * stress[peak] - line.intercept) / line.slope;
    panel.series.push_back(series("tangent E = " + format_quantity(line.slope, "GPa"), Look::dashed,
                                  "series-2", {100 * start, 100 * end},
                                  {0, 0.95 * stress[peak] / unit.factor}));
    panel.series.push_back(
        level("peak = " + significant(y[peak]) + " " + unit.name, "ink", low, high, y[peak]));
    marks =
        " The dashed lines are the tangent by regression over 40 to 60 % of the peak, and the "
        "peak.";
  } catch (const ResponseError &error) {
    marks = std::string(" No tangent is drawn: ") + error.what() + ".";
  }
  plot.sentence =
      "Axial stress against the strains of the gauge section, and the number of broken bonds." +
      marks;
  plot.panels.push_back(std::move(panel));
  return plot;
}

Plot force_displacement(const Curve &curve, const ReportRunFiles &run,
                        const std::vector<ReportTarget> &targets,
                        const std::vector<ReportMeasuredCurve> &measured) {
  const std::vector<double> force = platen_force(curve);
  const std::vector<double> &way = curve.column("displacement");
  const AxisUnit unit = force_unit(largest(force)), length = way_unit(largest(way));
  const double to_axis = 1 / length.factor;
  const std::vector<double> x = scaled(way, to_axis), y = scaled(force, 1 / unit.factor);
  const auto [low, high] = span_of(x);

  Plot plot;
  PlotPanel panel;
  // `displacement` is the closing where two platens close, and the drive's way in the other tests
  const bool closes = run.kind == "brazilian" || run.kind == "uniaxial_compression" || run.kind == "creep";
  panel.x.label = std::string(closes ? "closing of the platens (" : "displacement (") +
                  length.name + ")";
  panel.y.label = std::string("force (") + unit.name + ")";
  panel.y.from_zero = true;
  const auto diameter = run.variables.find("diameter"), thickness = run.variables.find("thickness");
  const ReportTarget *strength = target_with(targets, run, "brazilian.tensile_strength");
  std::string sentence =
      closes ? "Force of the platens against their closing, and the number of broken bonds."
             : "Force (mean of both sides) against the displacement of the drive, and the number of "
               "broken bonds.";
  if (strength && diameter != run.variables.end() && thickness != run.variables.end()) {
    const double area = pi * diameter->second * thickness->second / 2;
    panel.series.push_back(
        measured_band(*strength, low, high, [&](double si) { return si * area / unit.factor; }));
    sentence += " The band is the force that gives the measured strength by 2P/(\u03c0Dt).";
  }
  add_broken_bonds(panel, curve, x);
  for (const ReportMeasuredCurve &m : measured) {
    const auto at = [&](const char *name) {
      return std::find(m.names.begin(), m.names.end(), name) - m.names.begin();
    };
    const auto way_at = static_cast<std::size_t>(at("displacement"));
    const auto force_at = static_cast<std::size_t>(std::min(at("force"), at("force_top")));
    if (m.test != run.test || way_at >= m.columns.size() || force_at >= m.columns.size()) continue;
    panel.series.push_back(series("measured: " + m.label, Look::line, "series-3",
                                  scaled(m.columns[way_at], to_axis),
                                  scaled(m.columns[force_at], 1 / unit.factor)));
  }
  panel.series.push_back(series("force", Look::line, "series-1", x, y));
  if (!y.empty()) {
    const double peak = y[peak_index(y)];
    panel.series.push_back(
        level("peak = " + significant(peak) + " " + unit.name, "ink", low, high, peak));
  }
  plot.sentence = sentence;
  plot.panels.push_back(std::move(panel));
  return plot;
}

}  // namespace

AxisUnit force_unit(double largest) {
  return suited(largest, {{"N", 1}, {"kN", 1e3}, {"MN", 1e6}});
}

AxisUnit way_unit(double largest) {
  return largest < 1e-4 ? AxisUnit{"µm", 1e-6} : AxisUnit{"mm", 1e-3};
}

bool is_stress_strain(const Curve &curve) {
  return curve.has("axial_stress") && curve.has("strain_axial");
}

std::vector<double> platen_force(const Curve &curve) {
  const std::vector<double> &top = curve.column("force_top"),
                            &bottom = curve.column("force_bottom");
  std::vector<double> mean(top.size());
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (top[i] + bottom[i]) / 2;
  return mean;
}

std::size_t peak_index(const std::vector<double> &load) {
  return load.empty()
             ? 0
             : static_cast<std::size_t>(std::max_element(load.begin(), load.end()) - load.begin());
}

Plot curve_plot(const Curve &curve, const ReportRunFiles &run,
                const std::vector<ReportTarget> &targets,
                const std::vector<ReportMeasuredCurve> &measured) {
  Plot plot = is_stress_strain(curve) ? stress_strain(curve, run, targets, measured)
                                      : force_displacement(curve, run, targets, measured);
  plot.width = 540, plot.height = 420;
  if (!curve.complete) plot.sentence += " The curve is not complete: the run ended early.";
  return plot;
}

}  // namespace bondlab
