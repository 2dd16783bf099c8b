// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/brazilian.h"

#include <cmath>

#include "response/loading_branch.h"

namespace bondlab::brazilian {

namespace {

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

}  // namespace bondlab::brazilian
