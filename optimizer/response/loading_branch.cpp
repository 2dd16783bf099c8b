// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/loading_branch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "response/response.h"

namespace bondlab {

namespace {

constexpr double reached = 0.98;  // share of the end; the curve has a point every few steps

const std::vector<double> &raw_column(const Curve &curve, const std::string &name) {
  const auto found = std::find(curve.names.begin(), curve.names.end(), name);
  if (found == curve.names.end())
    throw ResponseError(ResponseCause::missing_column,
                        fmt::format("the curve has no column '{}'; it has: {}", name,
                                    fmt::join(curve.names, ", ")));
  return curve.columns.at(static_cast<std::size_t>(found - curve.names.begin()));
}

}  // namespace

const std::vector<double> &finite_column(const Curve &curve, const std::string &name) {
  const auto &column = raw_column(curve, name);
  const std::size_t samples = raw_column(curve, "time").size();
  if (column.size() != samples)
    throw ResponseError(
        ResponseCause::bad_data,
        fmt::format("column '{}' has {} samples, 'time' has {}", name, column.size(), samples));
  for (std::size_t i = 0; i < column.size(); ++i)
    if (!std::isfinite(column[i]))
      throw ResponseError(ResponseCause::bad_data,
                          fmt::format("column '{}' holds {} at sample {}", name, column[i], i + 1));
  return column;
}

void require_monotonic_time(const Curve &curve) {
  const auto &time = finite_column(curve, "time");
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1]))
      throw ResponseError(
          ResponseCause::time_not_monotonic,
          fmt::format("time does not grow from sample {} ({:g} s) to sample {} ({:g} s)", i,
                      time[i - 1], i + 1, time[i]));
}

std::size_t find_peak(const std::vector<double> &load) {
  if (load.empty()) throw ResponseError(ResponseCause::no_load, "the curve has no samples");
  const auto top = std::max_element(load.begin(), load.end());
  const double peak = *top;
  if (!(peak > 0)) throw ResponseError(ResponseCause::no_load, "the specimen never carried load");
  const double lowest_after = *std::min_element(top, load.end());
  if (lowest_after > (1 - minimum_drop_after_peak) * peak)
    throw ResponseError(
        ResponseCause::test_not_finished,
        fmt::format("the load fell by only {:.1f} % behind its peak ({:.0f} % needed): the test "
                    "stopped before the specimen failed",
                    100 * (1 - lowest_after / peak), 100 * minimum_drop_after_peak));
  return static_cast<std::size_t>(top - load.begin());
}

double greatest_until(const std::vector<double> &load, double end, const std::string &variable,
                      double wanted) {
  const double greatest = load.empty() ? 0 : *std::max_element(load.begin(), load.end());
  if (!(greatest > 0))
    throw ResponseError(ResponseCause::no_load, "the specimen never carried load");
  const bool fell = load.back() < (1 - minimum_drop_after_peak) * greatest;
  if (!fell && end < reached * wanted)
    throw ResponseError(ResponseCause::test_not_finished,
                        fmt::format("the test ended at {:.3g}, before {} ({:.3g}) and before the "
                                    "load fell",
                                    end, variable, wanted));
  return greatest;
}

SampleWindow loading_window(const std::vector<double> &load, std::size_t peak, double lower,
                            double upper) {
  SampleWindow window;
  const double high = upper * load[peak], low = lower * load[peak];
  window.last = 0;
  while (window.last < peak && load[window.last] < high) ++window.last;
  window.first = window.last;
  while (window.first > 0 && load[window.first - 1] >= low) --window.first;
  if (window.size() < minimum_window_samples)
    throw ResponseError(
        ResponseCause::window_too_small,
        fmt::format(
            "{} samples between {:.0f} and {:.0f} % of the peak, {} needed: sample the curve "
            "more often",
            window.size(), 100 * lower, 100 * upper, minimum_window_samples));
  return window;
}

LineFit fit_line(const std::vector<double> &x, const std::vector<double> &y, SampleWindow window) {
  const double n = static_cast<double>(window.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = window.first; i < window.last; ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double sxx = 0, sxy = 0, syy = 0;  // about the means: strains of 1e-4 must not cancel
  const double rounding = std::numeric_limits<double>::epsilon() * std::fabs(mean_x);
  for (std::size_t i = window.first; i < window.last; ++i) {
    const double dx = x[i] - mean_x, dy = y[i] - mean_y;
    sxx += dx * dx;
    sxy += dx * dy;
    syy += dy * dy;
  }
  if (!(sxx > 100 * n * rounding * rounding))  // what rounding alone leaves of a constant
    throw ResponseError(ResponseCause::implausible,
                        "the strain does not change in the regression window");
  LineFit fit;
  fit.slope = sxy / sxx;
  fit.intercept = mean_y - fit.slope * mean_x;
  if (window.size() > 2) {
    fit.slope_error = std::sqrt(std::max(0.0, syy - fit.slope * sxy) / ((n - 2) * sxx));
    fit.intercept_error = fit.slope_error * std::sqrt(sxx / n + mean_x * mean_x);
  }
  return fit;
}

double relative_imbalance(const std::vector<double> &a, const std::vector<double> &b,
                          SampleWindow window) {
  double worst = 0, mean = 0;
  for (std::size_t i = window.first; i < window.last; ++i) {
    worst = std::max(worst, std::fabs(a[i] - b[i]));
    mean += (std::fabs(a[i]) + std::fabs(b[i])) / (2.0 * static_cast<double>(window.size()));
  }
  return mean > 0 ? worst / mean : 0.0;
}

double kinetic_share(const Curve &curve, SampleWindow window) {
  const auto &kinetic = finite_column(curve, "kinetic_energy");
  const auto &strain = finite_column(curve, "strain_energy");
  double worst = 0;
  for (std::size_t i = window.first; i < window.last; ++i) {
    if (!(strain[i] > 0))
      throw ResponseError(
          ResponseCause::implausible,
          fmt::format("the strain energy at sample {} is {:g} J", i + 1, strain[i]));
    worst = std::max(worst, kinetic[i] / strain[i]);
  }
  return worst;
}

SampleWindow last_part(SampleWindow window, double share) {
  const auto kept = static_cast<std::size_t>(share * static_cast<double>(window.size()));
  return {window.last - std::min(kept, window.size()), window.last};
}

}  // namespace bondlab
