// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/brazilian.h"

#include <algorithm>
#include <cmath>

#include "response/loading_branch.h"

namespace bondlab::brazilian {

namespace {

constexpr std::size_t kFewestCracks = 5;

std::vector<double> mean_force(const Curve &curve) {
  const auto &top = finite_column(curve, "force_top");
  const auto &bottom = finite_column(curve, "force_bottom");
  std::vector<double> mean(top.size());
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5 * (top[i] + bottom[i]);
  return mean;
}

}  // namespace

double tensile_strength(const Curve &curve, const ResponseContext &context) {
  require_monotonic_time(curve);
  const double diameter = context.positive("diameter"), thickness = context.positive("thickness");
  const auto load = mean_force(curve);
  return 2 * load[find_peak(load)] / (M_PI * diameter * thickness);
}

double platen_imbalance(const Curve &curve, const ResponseContext &) {
  require_monotonic_time(curve);
  const auto load = mean_force(curve);
  const auto window = loading_window(load, find_peak(load));
  return relative_imbalance(finite_column(curve, "force_top"), finite_column(curve, "force_bottom"),
                            window);
}

double kinetic_share(const Curve &curve, const ResponseContext &) {
  require_monotonic_time(curve);
  const auto load = mean_force(curve);
  return bondlab::kinetic_share(curve, loading_window(load, find_peak(load)));
}

double first_cracks(const Curve &curve, const std::vector<BrokenBond> &events,
                    const ResponseContext &context) {
  require_monotonic_time(curve);
  const double until = curve.column("time")[find_peak(mean_force(curve))];
  const auto before = static_cast<std::size_t>(std::count_if(
      events.begin(), events.end(), [&](const BrokenBond &bond) { return bond.time <= until; }));
  if (before == 0)
    throw ResponseError(ResponseCause::window_too_small, "no bond broke before the peak");
  const std::size_t first = std::min(before, std::max(kFewestCracks, before / 10));
  double sum = 0;
  for (std::size_t k = 0; k < first; ++k) sum += std::hypot(events[k].x, events[k].y);
  return sum / static_cast<double>(first) / (context.positive("diameter") / 2);
}

}  // namespace bondlab::brazilian
