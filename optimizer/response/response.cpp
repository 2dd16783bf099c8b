// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/response.h"

#include <fmt/format.h>

#include <cmath>

#include "response/bending.h"
#include "response/brazilian.h"
#include "response/cantilever.h"
#include "response/impact.h"
#include "response/programme.h"
#include "response/shear.h"
#include "response/uniaxial.h"

namespace bondlab {

namespace {

using Function = double (*)(const Curve &, const ResponseContext &);

const std::map<std::string, Function> &registry() {
  static const std::map<std::string, Function> functions = {
      {"bending.flexural_modulus", bending::flexural_modulus},
      {"bending.flexural_modulus_slender", bending::flexural_modulus_slender},
      {"bending.flexural_strength", bending::flexural_strength},
      {"bending.kinetic_share", bending::kinetic_share},
      {"bending.platen_imbalance", bending::platen_imbalance},
      {"bending.toughness", bending::toughness},
      {"brazilian.kinetic_share", brazilian::kinetic_share},
      {"brazilian.platen_imbalance", brazilian::platen_imbalance},
      {"brazilian.tensile_strength", brazilian::tensile_strength},
      {"cantilever.compliance", cantilever::compliance},
      {"cantilever.kinetic_share", cantilever::kinetic_share},
      {"cantilever.modulus", cantilever::modulus},
      {"cantilever.modulus_slender", cantilever::modulus_slender},
      {"cantilever.platen_imbalance", cantilever::platen_imbalance},
      {"cantilever.strength", cantilever::strength},
      {"impact.absorbed_energy", impact::absorbed_energy},
      {"impact.broken_share", impact::broken_share},
      {"impact.contact_time", impact::contact_time},
      {"impact.largest_share", impact::largest_share},
      {"impact.passing_share", impact::passing_share},
      {"impact.peak_force", impact::peak_force},
      {"programme.creep_rate", programme::creep_rate},
      {"programme.hold_platen_imbalance", programme::hold_platen_imbalance},
      {"programme.hold_kinetic_share", programme::hold_kinetic_share},
      {"programme.relaxed_share", programme::relaxed_share},
      {"programme.unloading_modulus", programme::unloading_modulus},
      {"shear.dilation", shear::dilation},
      {"shear.kinetic_share", shear::kinetic_share},
      {"shear.normal_stress_at_peak", shear::normal_stress_at_peak},
      {"shear.normal_stress_at_residual", shear::normal_stress_at_residual},
      {"shear.peak_strength", shear::peak_strength},
      {"shear.strength_within_shear", shear::strength_within_shear},
      {"shear.platen_imbalance", shear::platen_imbalance},
      {"shear.residual_strength", shear::residual_strength},
      {"uniaxial.bonds", uniaxial::bonds},
      {"uniaxial.greatest_kinetic_energy", uniaxial::greatest_kinetic_energy},
      {"uniaxial.greatest_strain_energy", uniaxial::greatest_strain_energy},
      {"uniaxial.kinetic_share", uniaxial::kinetic_share},
      {"uniaxial.peak_strain", uniaxial::peak_strain},
      {"uniaxial.peak_strain_platen", uniaxial::peak_strain_platen},
      {"uniaxial.peak_stress", uniaxial::peak_stress},
      {"uniaxial.platen_imbalance", uniaxial::platen_imbalance},
      {"uniaxial.poisson_gauge", uniaxial::poisson_gauge},
      {"uniaxial.strength_within_strain", uniaxial::strength_within_strain},
      {"uniaxial.tangent_modulus_gauge", uniaxial::tangent_modulus_gauge},
      {"uniaxial.tangent_modulus_machine", uniaxial::tangent_modulus_machine},
      {"uniaxial.tangent_modulus_platen", uniaxial::tangent_modulus_platen},
  };
  return functions;
}

/// The functions that judge a run instead of measuring the material, by family.
const std::multimap<std::string, std::string> &quality_registry() {
  static const std::multimap<std::string, std::string> functions = {
      {"cantilever", "kinetic_share"},
      {"cantilever", "platen_imbalance"},
      {"programme", "hold_platen_imbalance"},
      {"programme", "hold_kinetic_share"},
      {"shear", "kinetic_share"},
      {"shear", "platen_imbalance"},
      {"uniaxial", "kinetic_share"},
      {"uniaxial", "platen_imbalance"},
      {"uniaxial", "tangent_modulus_platen"},
      {"uniaxial", "peak_strain"},
      {"bending", "kinetic_share"},
      {"bending", "platen_imbalance"},
      {"brazilian", "kinetic_share"},
      {"brazilian", "platen_imbalance"},
  };
  return functions;
}

}  // namespace

const char *to_string(ResponseCause cause) {
  switch (cause) {
    case ResponseCause::unknown_function:
      return "unknown_function";
    case ResponseCause::missing_column:
      return "missing_column";
    case ResponseCause::missing_variable:
      return "missing_variable";
    case ResponseCause::bad_data:
      return "bad_data";
    case ResponseCause::time_not_monotonic:
      return "time_not_monotonic";
    case ResponseCause::no_load:
      return "no_load";
    case ResponseCause::test_not_finished:
      return "test_not_finished";
    case ResponseCause::window_too_small:
      return "window_too_small";
    case ResponseCause::implausible:
      return "implausible";
  }
  return "unknown";
}

ResponseError::ResponseError(ResponseCause cause, const std::string &sentence)
    : std::runtime_error(sentence), cause_(cause) {}

double ResponseContext::positive(const std::string &name) const {
  const auto found = variables.find(name);
  if (found == variables.end())
    throw ResponseError(
        ResponseCause::missing_variable,
        fmt::format("the response needs the deck variable '{}', which the run does not have",
                    name));
  if (!(found->second > 0) || !std::isfinite(found->second))
    throw ResponseError(
        ResponseCause::missing_variable,
        fmt::format("the deck variable '{}' is {:g}; it must be positive", name, found->second));
  return found->second;
}

double evaluate(const std::string &function, const Curve &curve, const ResponseContext &context) {
  const auto found = registry().find(function);
  if (found == registry().end())
    throw ResponseError(ResponseCause::unknown_function,
                        fmt::format("no response function '{}'; there are: {}", function,
                                    fmt::join(response_functions(), ", ")));
  return found->second(curve, context);
}

std::vector<std::string> response_functions() {
  std::vector<std::string> names;
  for (const auto &entry : registry()) names.push_back(entry.first);
  return names;
}

bool is_response_function(const std::string &function) { return registry().count(function) > 0; }

std::map<std::string, double> quality_figures(const std::string &function, const Curve &curve,
                                              const ResponseContext &context) {
  std::map<std::string, double> figures;
  const std::string family = function.substr(0, function.find('.'));
  const auto range = quality_registry().equal_range(family);
  for (auto entry = range.first; entry != range.second; ++entry) {
    try {
      figures[entry->second] = evaluate(family + "." + entry->second, curve, context);
    } catch (const ResponseError &) {
      // A figure that the curve cannot carry is absent; the response itself reports why.
    }
  }
  return figures;
}

}  // namespace bondlab
