// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/run_quality.h"

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
  if (figure == "first_cracks") return "first cracks from the centre over the radius";
  return "";
}

}  // namespace bondlab
