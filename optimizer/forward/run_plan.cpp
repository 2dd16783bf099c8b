// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/run_plan.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "base/sha256.h"
#include "base/table_file.h"
#include "base/units.h"
#include "study/specimen_request.h"

namespace bondlab {

namespace fs = std::filesystem;

namespace {

void add_deck(Sha256 &hash, const fs::path &file, const fs::path &folder,
              std::set<fs::path> &seen) {
  if (!seen.insert(file.lexically_normal()).second) return;
  const std::string text = read_text_file(file);
  hash.add_field("file", text);
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    std::string command, name;
    if (!(words >> command >> name) || (command != "include" && command != "jump") ||
        name == "SELF")
      continue;
    const std::string variable = "${deck_dir}";
    if (name.rfind(variable, 0) == 0) name = folder.string() + name.substr(variable.size());
    const fs::path included = name;
    if (name.find('$') != std::string::npos || !included.is_absolute())
      throw UserError({file.string(), number, 0},
                      "the file '" + name + "' can't be found from a run's own folder; write " +
                          command + " ${deck_dir}/NAME below a line 'variable deck_dir index .'");
    std::error_code error;
    if (!fs::is_regular_file(included, error))
      throw UserError({file.string(), number, 0}, "there is no file '" + included.string() + "'");
    add_deck(hash, included, folder, seen);
  }
}

// A deck's default as a number in SI, when it is one.
std::optional<double> default_number(const std::string &text, const std::string &unit) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return to_si(value, unit.empty() ? "1" : unit);
}

// The specimen's dimensions under the names decks use, and its thickness across the plane of a
// test: of a cylinder loaded across its axis its height, of a prism its width.
std::map<std::string, double> deck_dimensions(const SpecimenEntry &specimen) {
  std::map<std::string, double> named;
  for (const NamedDimension &dimension : dimensions_of(specimen.shape))
    named[dimension.name] = specimen.size.*dimension.value;
  if (can_have_notch(specimen.shape)) {
    named["notch_depth"] = specimen.size.notch_depth;
    named["notch_width"] = specimen.size.notch_width;
  }
  if (is_flat(specimen.shape)) named["thickness"] = specimen.thickness;
  if (specimen.shape == SpecimenShape::cylinder) named["thickness"] = specimen.size.height;
  if (specimen.shape == SpecimenShape::prism) named["thickness"] = specimen.size.width;
  return named;
}

}  // namespace

std::string deck_hash(const fs::path &deck) {
  Sha256 hash;
  std::set<fs::path> seen;
  add_deck(hash, deck, deck.parent_path(), seen);
  return hash.hex();
}

RunPlan plan_run(const Study &study, const ForwardRequest &request) {
  const TestEntry &entry = study.test(request.test);
  const TestDefinition &definition = entry.definition;
  RunPlan plan;
  plan.test = entry.name;
  plan.virtual_test = definition.name;
  plan.deck = definition.deck;
  plan.deck_hash = deck_hash(definition.deck);
  plan.specimen = study.specimen(entry.specimen);
  plan.packing = request.packing;
  plan.ranks = entry.ranks;
  plan.wall_limit = entry.wall_limit;
  plan.curve = definition.curve;
  plan.events = definition.events;
  plan.particles = definition.particles;
  plan.columns = definition.columns;
  plan.keep = definition.keep;
  plan.wants_deck_dir = definition.deck_defaults.count("deck_dir") > 0;
  plan.wants_specimen = definition.deck_defaults.count("specimen") > 0;

  for (const auto &[name, text] : definition.deck_defaults) {
    const auto declared = definition.variables.find(name);
    if (const auto number = default_number(
            text, declared == definition.variables.end() ? "1" : declared->second.unit))
      plan.numeric[name] = *number;
  }
  const auto set_number = [&](const std::string &name, double value) {
    plan.numeric[name] = value;
    plan.variables[name] = canonical_number(deck_number(definition.variables.at(name), value));
  };
  for (const auto &[name, value] : entry.variables) {
    if (value.is_word())
      plan.variables[name] = value.word;
    else
      set_number(name, value.number);
  }
  for (const auto &[name, value] : request.variables) {
    const auto declared = definition.variables.find(name);
    if (declared == definition.variables.end()) {
      std::vector<std::string> known;
      for (const auto &[known_name, variable] : definition.variables) known.push_back(known_name);
      throw UserError("the test '" + entry.name + "' has no variable '" + name +
                      "'; known: " + join(known));
    }
    const std::string why = why_not_allowed(declared->second, value);
    if (!why.empty())
      throw UserError("the variable '" + name + "' of the test '" + entry.name + "' can't be " +
                      format_quantity(value, declared->second.unit, 6) + "; " + why);
    set_number(name, value);
    plan.varied.push_back(name);
  }
  for (const auto &[name, value] : deck_dimensions(plan.specimen)) {
    plan.numeric[name] = value;
    if (definition.deck_defaults.count(name)) plan.variables[name] = canonical_number(value);
  }
  return plan;
}

RunKey key_of(const RunPlan &plan, const std::string &engine_hash) {
  RunKey key;
  key.seed = plan.seed();
  Sha256 point;
  point.add_field("engine", engine_hash);
  point.add_field("deck", plan.deck_hash);
  point.add_field("ranks", std::to_string(plan.ranks));
  for (const auto &[name, text] : plan.variables) point.add_field("variable " + name, text);
  SpecimenRequest specimen = specimen_request(plan.specimen, 0);
  specimen.seed = 0;
  if (plan.wants_specimen) point.add_field("specimen", canonical_text(specimen));
  key.point = point.hex();
  Sha256 full;
  full.add_field("point", key.point);
  full.add_field("seed", std::to_string(key.seed));
  full.add_field("specimen file", plan.wants_specimen ? plan.specimen_file.hash : "");
  key.full = full.hex();
  return key;
}

std::string workload_of(const RunPlan &plan) {
  Sha256 hash;
  hash.add_field("deck", plan.deck_hash);
  hash.add_field("ranks", std::to_string(plan.ranks));
  for (const auto &[name, text] : plan.variables)
    if (std::find(plan.varied.begin(), plan.varied.end(), name) == plan.varied.end())
      hash.add_field("variable " + name, text);
  SpecimenRequest specimen = specimen_request(plan.specimen, 0);
  specimen.seed = 0;
  hash.add_field("specimen", canonical_text(specimen));
  return hash.hex();
}

}  // namespace bondlab
