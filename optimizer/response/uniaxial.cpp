// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/uniaxial.h"

#include <fmt/format.h>

#include <algorithm>

#include "response/loading_branch.h"

namespace bondlab::uniaxial {

namespace {

struct LoadingBranch {
  const std::vector<double> &stress;
  std::size_t peak;
};

LoadingBranch loading_branch(const Curve &curve) {
  require_monotonic_time(curve);
  const auto &stress = finite_column(curve, "axial_stress");
  return {stress, find_peak(stress)};
}

double tangent_modulus(const Curve &curve, const std::string &strain_name) {
  const auto branch = loading_branch(curve);
  const auto &strain = finite_column(curve, strain_name);
  const auto window = loading_window(branch.stress, branch.peak);
  const double modulus = fit_line(strain, branch.stress, window).slope;
  if (!(modulus > 0))
    throw ResponseError(
        ResponseCause::implausible,
        fmt::format("the tangent modulus by '{}' is {:g} Pa: not positive", strain_name, modulus));
  return modulus;
}

}  // namespace

double peak_stress(const Curve &curve, const ResponseContext &) {
  const auto branch = loading_branch(curve);
  return branch.stress[branch.peak];
}

double strength_within_strain(const Curve &curve, const ResponseContext &context) {
  require_monotonic_time(curve);
  const auto &stress = finite_column(curve, "axial_stress");
  return greatest_until(stress, finite_column(curve, "strain_machine").back(), "max_strain",
                        context.positive("max_strain"));
}

double peak_strain(const Curve &curve, const ResponseContext &) {
  const auto branch = loading_branch(curve);
  return finite_column(curve, "strain_axial")[branch.peak];
}

double peak_strain_platen(const Curve &curve, const ResponseContext &) {
  const auto branch = loading_branch(curve);
  return finite_column(curve, "strain_platen")[branch.peak];
}

double tangent_modulus_gauge(const Curve &curve, const ResponseContext &) {
  return tangent_modulus(curve, "strain_axial");
}

double tangent_modulus_platen(const Curve &curve, const ResponseContext &) {
  return tangent_modulus(curve, "strain_platen");
}

double tangent_modulus_machine(const Curve &curve, const ResponseContext &) {
  return tangent_modulus(curve, "strain_machine");
}

double poisson_gauge(const Curve &curve, const ResponseContext &) {
  const auto branch = loading_branch(curve);
  const auto &axial = finite_column(curve, "strain_axial");
  const auto &lateral = finite_column(curve, "strain_lateral");
  return fit_line(axial, lateral, loading_window(branch.stress, branch.peak)).slope;
}

double bonds(const Curve &curve, const ResponseContext &) {
  const auto &intact = finite_column(curve, "intact_bonds");
  const auto &broken = finite_column(curve, "broken_bonds");
  return intact.front() + broken.front();
}

double greatest_strain_energy(const Curve &curve, const ResponseContext &) {
  const auto &energy = finite_column(curve, "strain_energy");
  return *std::max_element(energy.begin(), energy.end());
}

double greatest_kinetic_energy(const Curve &curve, const ResponseContext &) {
  const auto &energy = finite_column(curve, "kinetic_energy");
  return *std::max_element(energy.begin(), energy.end());
}

double platen_imbalance(const Curve &curve, const ResponseContext &) {
  const auto branch = loading_branch(curve);
  const auto &top = finite_column(curve, "force_top");
  const auto &bottom = finite_column(curve, "force_bottom");
  return relative_imbalance(top, bottom, loading_window(branch.stress, branch.peak));
}

double kinetic_share(const Curve &curve, const ResponseContext &) {
  const auto branch = loading_branch(curve);
  return bondlab::kinetic_share(curve, loading_window(branch.stress, branch.peak));
}

}  // namespace bondlab::uniaxial
