// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/run_quality.h"

#include <fmt/format.h>

#include <filesystem>

#include "response/brazilian.h"
#include "response/response.h"

namespace bondlab {

std::map<std::string, double> run_quality(const TestEntry &test, const ForwardOutcome &outcome) {
  std::map<std::string, double> figures;
  if (!outcome.ok) return figures;
  const ResponseContext context{outcome.deck_variables};
  bool splits = false;
  for (const auto &[name, response] : test.definition.responses) {
    figures.merge(quality_figures(response.function, outcome.curve, context));
    splits = splits || response.function.rfind("brazilian.", 0) == 0;
  }
  if (!splits) return figures;
  try {
    const auto events =
        read_broken_bonds(std::filesystem::path(outcome.run_directory) / test.definition.events);
    figures["first_cracks"] = brazilian::first_cracks(outcome.curve, events, context);
  } catch (const ResponseError &) {
  } catch (const UserError &) {  // no list of broken bonds
  }
  return figures;
}

std::string quality_words(const std::string &figure) {
  if (figure == "platen_imbalance") return "difference of the forces at the two ends";
  if (figure == "kinetic_share") return "kinetic over strain energy";
  if (figure == "hold_platen_imbalance") return "difference of the forces at the two ends, hold";
  if (figure == "hold_kinetic_share") return "kinetic over strain energy, hold";
  if (figure == "first_cracks") return "first cracks from the centre over the radius";
  return "";
}

std::string quality_warning(const std::string &figure, double value) {
  const bool hold = figure.rfind("hold_", 0) == 0;
  const std::string what = hold ? figure.substr(5) : figure;
  if (what == "platen_imbalance") {
    if (value <= noticeable_imbalance) return "";
    return fmt::format(
        "the forces on the two platens differ by up to {:.0f} % {}: the loading is not "
        "quasi-static, a slower platen is advisable",
        100 * value, hold ? "at the end of the hold" : "between 40 and 60 % of the peak");
  }
  if (what == "kinetic_share") {
    if (value <= noticeable_kinetic_share) return "";
    return fmt::format(
        "the kinetic energy is up to {:.2g} of the strain energy {}: the loading is not "
        "quasi-static (1e-3 is good practice), a slower platen is advisable",
        value, hold ? "at the end of the hold" : "between 40 and 60 % of the peak");
  }
  if (what == "first_cracks" && value > cracks_anywhere)
    return fmt::format(
        "the first cracks are {:.2f} radii from the centre: the disc began to break at its "
        "platens, and 2P/(pi D t) holds for a crack that begins in the middle",
        value);
  return "";
}

}  // namespace bondlab
