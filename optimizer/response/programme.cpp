// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/programme.h"

#include <fmt/format.h>

#include <algorithm>

#include "response/loading_branch.h"

namespace bondlab::programme {

namespace {

enum Phase { holding = 2, keeping = 3, unloading = 4 };  // as fix drive numbers them

SampleWindow first_stretch(const Curve &curve, Phase phase, const char *name) {
  require_monotonic_time(curve);
  const auto &phases = finite_column(curve, "phase");
  SampleWindow stretch;
  while (stretch.first < phases.size() && phases[stretch.first] != phase) ++stretch.first;
  stretch.last = stretch.first;
  while (stretch.last < phases.size() && phases[stretch.last] == phase) ++stretch.last;
  if (stretch.size() == 0)
    throw ResponseError(ResponseCause::test_not_finished,
                        fmt::format("the run has no {}: none was asked for, or the specimen "
                                    "failed before it",
                                    name));
  if (stretch.size() < minimum_window_samples)
    throw ResponseError(ResponseCause::window_too_small,
                        fmt::format("{} samples during the {}, {} needed: sample the curve more "
                                    "often",
                                    stretch.size(), name, minimum_window_samples));
  return stretch;
}

// Where it is judged whether the run is at rest but for what it measures.
SampleWindow end_of_the_hold(const Curve &curve) {
  const auto &phases = finite_column(curve, "phase");
  const bool keeps = std::count(phases.begin(), phases.end(), static_cast<double>(keeping)) > 0;
  return last_part(keeps ? first_stretch(curve, keeping, "hold of the load")
                         : first_stretch(curve, holding, "hold of the displacement"),
                   1.0 / 3);
}

}  // namespace

double unloading_modulus(const Curve &curve, const ResponseContext &) {
  SampleWindow branch = first_stretch(curve, unloading, "unloading");
  const auto &stress = finite_column(curve, "axial_stress");
  const auto &strain = finite_column(curve, "strain_axial");
  const double high = stress[branch.first], low = stress[branch.last - 1];
  const double upper = high - 0.2 * (high - low), lower = low + 0.2 * (high - low);
  while (branch.size() > 0 && stress[branch.first] > upper) ++branch.first;
  while (branch.size() > 0 && stress[branch.last - 1] < lower) --branch.last;
  if (branch.size() < minimum_window_samples)
    throw ResponseError(ResponseCause::window_too_small,
                        fmt::format("{} samples in the middle of the unloading, {} needed",
                                    branch.size(), minimum_window_samples));
  const double modulus = fit_line(strain, stress, branch).slope;
  if (!(modulus > 0))
    throw ResponseError(ResponseCause::implausible,
                        fmt::format("the unloading modulus is {:g} Pa: not positive", modulus));
  return modulus;
}

double relaxed_share(const Curve &curve, const ResponseContext &) {
  const SampleWindow hold = first_stretch(curve, holding, "hold of the displacement");
  const auto &stress = finite_column(curve, "axial_stress");
  if (!(stress[hold.first] > 0))
    throw ResponseError(ResponseCause::no_load, "the specimen carried no load during the hold");
  return 1 - stress[hold.last - 1] / stress[hold.first];
}

double creep_rate(const Curve &curve, const ResponseContext &) {
  const SampleWindow all = first_stretch(curve, keeping, "hold of the load");
  const SampleWindow end = last_part(all, 1.0 / 3);
  if (end.size() < minimum_window_samples)
    throw ResponseError(ResponseCause::window_too_small,
                        fmt::format("{} samples in the last third of the hold, {} needed",
                                    end.size(), minimum_window_samples));
  return fit_line(finite_column(curve, "time"), finite_column(curve, "strain_axial"), end).slope;
}

double hold_platen_imbalance(const Curve &curve, const ResponseContext &) {
  return relative_imbalance(finite_column(curve, "force_top"), finite_column(curve, "force_bottom"),
                            end_of_the_hold(curve));
}

double hold_kinetic_share(const Curve &curve, const ResponseContext &) {
  return kinetic_share(curve, end_of_the_hold(curve));
}

}  // namespace bondlab::programme
