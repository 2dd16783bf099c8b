// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/shear.h"

#include <algorithm>

#include "response/loading_branch.h"

namespace bondlab::shear {

namespace {

struct Branch {
  const std::vector<double> &stress;
  std::size_t peak;
};

Branch branch_of(const Curve &curve) {
  require_monotonic_time(curve);
  const auto &stress = finite_column(curve, "shear_stress");
  return {stress, find_peak(stress)};
}

// Mean over the last fifth of the displacement, which must lie behind the peak.
double mean_of_the_end(const Curve &curve, const char *column) {
  const Branch b = branch_of(curve);
  const auto &values = finite_column(curve, column);
  const auto &way = finite_column(curve, "displacement");
  const double from = way.back() - 0.2 * (way.back() - way.front());
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = b.peak; i < way.size(); ++i)
    if (way[i] >= from) sum += values[i], ++count;
  if (way[b.peak] > from || count < minimum_window_samples)
    throw ResponseError(ResponseCause::test_not_finished,
                        "the peak is in the last fifth of the displacement: shear further");
  return sum / static_cast<double>(count);
}

}  // namespace

double peak_strength(const Curve &curve, const ResponseContext &) {
  const Branch b = branch_of(curve);
  return b.stress[b.peak];
}

double strength_within_shear(const Curve &curve, const ResponseContext &context) {
  require_monotonic_time(curve);
  const auto &stress = finite_column(curve, "shear_stress");
  const double across = context.positive(context.positive("dim") < 2.5 ? "width" : "diameter");
  return greatest_until(stress, finite_column(curve, "displacement").back() / across, "max_shear",
                        context.positive("max_shear"));
}

double residual_strength(const Curve &curve, const ResponseContext &) {
  return mean_of_the_end(curve, "shear_stress");
}

double normal_stress_at_peak(const Curve &curve, const ResponseContext &) {
  return finite_column(curve, "normal_stress")[branch_of(curve).peak];
}

double normal_stress_at_residual(const Curve &curve, const ResponseContext &) {
  return mean_of_the_end(curve, "normal_stress");
}

double dilation(const Curve &curve, const ResponseContext &) {
  require_monotonic_time(curve);
  const auto &way = finite_column(curve, "displacement");
  const auto &lift = finite_column(curve, "lift");
  std::size_t start = 0;
  while (start + 1 < way.size() && way[start + 1] <= way.front()) ++start;
  return *std::max_element(lift.begin() + static_cast<std::ptrdiff_t>(start), lift.end()) -
         lift[start];
}

double platen_imbalance(const Curve &curve, const ResponseContext &) {
  const Branch b = branch_of(curve);
  return relative_imbalance(finite_column(curve, "force_top"), finite_column(curve, "force_bottom"),
                            loading_window(b.stress, b.peak));
}

double kinetic_share(const Curve &curve, const ResponseContext &) {
  const Branch b = branch_of(curve);
  return bondlab::kinetic_share(curve, loading_window(b.stress, b.peak));
}

}  // namespace bondlab::shear
