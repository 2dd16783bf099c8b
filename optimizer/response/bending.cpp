// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/bending.h"

#include <fmt/format.h>

#include <cmath>

#include "response/beam_section.h"
#include "response/loading_branch.h"

namespace bondlab::bending {

namespace {

std::vector<double> mean_load(const Curve &curve) {
  const auto &top = finite_column(curve, "force_top");
  const auto &bottom = finite_column(curve, "force_bottom");
  std::vector<double> mean(top.size());
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5 * (top[i] + bottom[i]);
  return mean;
}

double peak_load(const Curve &curve) {
  require_monotonic_time(curve);
  const auto load = mean_load(curve);
  return load[find_peak(load)];
}

double stiffness(const Curve &curve) {  // N/m
  require_monotonic_time(curve);
  const auto load = mean_load(curve);
  const auto window = loading_window(load, find_peak(load));
  const double slope = fit_line(finite_column(curve, "deflection"), load, window).slope;
  if (!(slope > 0))
    throw ResponseError(ResponseCause::implausible,
                        fmt::format("the load falls with the deflection, by {:g} N/m", slope));
  return slope;
}

void require_near(double value, double standard, const char *what) {
  if (std::fabs(value / standard - 1) > 0.1)
    throw ResponseError(
        ResponseCause::implausible,
        fmt::format("{} is {:.3f}; the formula for K_IC is for {:.2f}", what, value, standard));
}

}  // namespace

double e399_shape(double x) {
  return 3 * std::sqrt(x) * (1.99 - x * (1 - x) * (2.15 - 3.93 * x + 2.7 * x * x)) /
         (2 * (1 + 2 * x) * std::pow(1 - x, 1.5));
}

double senrbb_shape(double x) {
  return 12.7527 * std::sqrt(x) * std::sqrt(1 + 19.646 * std::pow(x, 4.5)) / std::pow(1 - x, 0.25);
}

double flexural_strength(const Curve &curve, const ResponseContext &context) {
  const BeamSection s = beam_section(context);
  // M c/I with M = F S/4 and c = d/2
  return peak_load(curve) * context.positive("span") / 4 * (s.depth / 2) / s.inertia();
}

double flexural_modulus_slender(const Curve &curve, const ResponseContext &context) {
  const BeamSection s = beam_section(context);
  return stiffness(curve) * std::pow(context.positive("span"), 3) / (48 * s.inertia());
}

double flexural_modulus(const Curve &curve, const ResponseContext &context) {
  const BeamSection s = beam_section(context);
  const double span = context.positive("span"), nu = context.positive("poisson");
  const double bending = std::pow(span, 3) / (48 * s.inertia());
  const double shear = span * 2 * (1 + nu) / (4 * s.shear_factor(nu) * s.area());
  return stiffness(curve) * (bending + shear);
}

double toughness(const Curve &curve, const ResponseContext &context) {
  const BeamSection s = beam_section(context);
  const double span = context.positive("span"), x = context.positive("notch_depth") / s.depth;
  if (x < 0.2 || x > 0.8)
    throw ResponseError(ResponseCause::implausible,
                        fmt::format("the notch is {:.3f} of the depth; K_IC needs 0.2 to 0.8", x));
  if (s.round) {
    require_near(span / s.depth, 3.33, "span over diameter");
    return 0.25 * span / s.depth * senrbb_shape(x) * peak_load(curve) / std::pow(s.depth, 1.5);
  }
  require_near(span / s.depth, 4, "span over depth");
  return peak_load(curve) * span / (s.breadth * std::pow(s.depth, 1.5)) * e399_shape(x);
}

double platen_imbalance(const Curve &curve, const ResponseContext &) {
  require_monotonic_time(curve);
  const auto load = mean_load(curve);
  return relative_imbalance(finite_column(curve, "force_top"), finite_column(curve, "force_bottom"),
                            loading_window(load, find_peak(load)));
}

double kinetic_share(const Curve &curve, const ResponseContext &) {
  require_monotonic_time(curve);
  const auto load = mean_load(curve);
  return bondlab::kinetic_share(curve, loading_window(load, find_peak(load)));
}

}  // namespace bondlab::bending
