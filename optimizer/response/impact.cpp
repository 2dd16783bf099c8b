// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/impact.h"

#include <algorithm>

#include "response/loading_branch.h"

namespace bondlab::impact {

namespace {

constexpr double pressing = 0.01;  // share of the peak force

// The last sample, once the ball has let go.
std::size_t end_of(const Curve &curve) {
  require_monotonic_time(curve);
  const auto &force = finite_column(curve, "force_top");
  const std::size_t peak = find_peak(force);
  if (force.back() > pressing * force[peak])
    throw ResponseError(ResponseCause::test_not_finished,
                        "the ball still presses at the end: make the run longer");
  return force.size() - 1;
}

}  // namespace

double peak_force(const Curve &curve, const ResponseContext &) {
  require_monotonic_time(curve);
  const auto &force = finite_column(curve, "force_top");
  return force[find_peak(force)];
}

double contact_time(const Curve &curve, const ResponseContext &context) {
  end_of(curve);
  const double limit = pressing * peak_force(curve, context);
  const auto &force = finite_column(curve, "force_top");
  const auto &time = finite_column(curve, "time");
  std::size_t first = 0, last = force.size() - 1;
  while (force[first] <= limit) ++first;
  while (force[last] <= limit) --last;
  return time[last] - time[first];
}

double absorbed_energy(const Curve &curve, const ResponseContext &) {
  const std::size_t end = end_of(curve);
  const auto &energy = finite_column(curve, "ball_energy");
  return energy.front() - energy[end];
}

double broken_share(const Curve &curve, const ResponseContext &) {
  const std::size_t end = end_of(curve);
  const double broken = finite_column(curve, "broken_bonds")[end];
  const double all = broken + finite_column(curve, "intact_bonds")[end];
  if (!(all > 0)) throw ResponseError(ResponseCause::implausible, "the specimen has no bonds");
  return broken / all;
}

double largest_share(const Curve &curve, const ResponseContext &) {
  return finite_column(curve, "largest_share")[end_of(curve)];
}

double passing_share(const Curve &curve, const ResponseContext &) {
  return finite_column(curve, "passing_share")[end_of(curve)];
}

}  // namespace bondlab::impact
