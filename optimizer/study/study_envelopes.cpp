// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the section [[envelopes]] of the study file: straight lines through one response of several
// tests.
#include <algorithm>
#include <set>

#include "base/units.h"
#include "study/study_sections.h"

namespace bondlab {

namespace {

constexpr std::size_t kFewest = 3;  // a line through two points has no error

// The value a test gives a deck variable before any parameter does, SI; nothing when it is a word or
// a response.
std::optional<double> value_in(const TestEntry &test, const std::string &name) {
  if (test.definition.responses.count(name)) return std::nullopt;
  const auto fixed = test.variables.find(name);
  if (fixed != test.variables.end())
    return fixed->second.is_word() ? std::nullopt : std::optional<double>(fixed->second.number);
  const auto in_deck = test.definition.deck_defaults.find(name);
  const auto declared = test.definition.variables.find(name);
  if (in_deck == test.definition.deck_defaults.end() ||
      declared == test.definition.variables.end())
    return std::nullopt;
  try {
    return to_si(std::stod(in_deck->second), declared->second.unit);
  } catch (const std::exception &) {
    return std::nullopt;
  }
}

// The unit of the response in a test, "" after an error.
std::string response_unit(TomlTable &table, const TestEntry &test, const std::string &name) {
  const auto response = test.definition.responses.find(name);
  if (response != test.definition.responses.end()) return response->second.unit;
  std::vector<std::string> known;
  for (const auto &[known_name, definition] : test.definition.responses)
    known.push_back(known_name);
  if (!known.empty() && !name.empty())
    table.error("response",
                unknown_name("the test '" + test.name + "' has no response", name, known));
  return "";
}

// What the line is over, a response of the test or a deck variable: known, a number, of the
// strength's dimension.
bool check_over(TomlTable &table, const TestEntry &test, const std::string &name,
                const std::string &unit) {
  const std::string other = "' has another dimension than the response; an angle of friction needs the same (" +
                            join(allowed_units(unit)) + ")";
  const auto response = test.definition.responses.find(name);
  if (response != test.definition.responses.end()) {
    if (same_dimension(response->second.unit, unit)) return true;
    table.error("over", "the response '" + name + other);
    return false;
  }
  const auto declared = test.definition.variables.find(name);
  if (declared == test.definition.variables.end()) {
    std::vector<std::string> known;
    for (const auto &[known_name, variable] : test.definition.variables)
      if (variable.choices.empty() && same_dimension(variable.unit, unit))
        known.push_back(known_name);
    for (const auto &[known_name, definition] : test.definition.responses)
      if (same_dimension(definition.unit, unit)) known.push_back(known_name);
    table.error("over", unknown_name("the test '" + test.name + "' has no variable or response", name, known));
    return false;
  }
  if (declared->second.choices.empty() && same_dimension(declared->second.unit, unit)) return true;
  table.error("over", "the deck variable '" + name + other);
  return false;
}

}  // namespace

void read_envelopes(TomlTable &top, Study &study) {
  for (const toml::table *entry : top.tables("envelopes")) {
    TomlTable table(*entry, "[[envelopes]]", top.file(), top.errors());
    EnvelopeEntry envelope;
    envelope.place = table.place();
    envelope.name = read_name(table, study.envelopes);
    envelope.tests = table.words("tests", true);
    envelope.response = table.text("response", true);
    envelope.over = table.text("over", true);
    const std::optional<std::string> unit = read_unit(table, false);
    table.finish();
    std::string si_unit;
    std::set<double> different;
    const std::set<std::string> named(envelope.tests.begin(), envelope.tests.end());
    bool computed = false;  // the abscissae are known only after the runs
    bool good = table.has("tests") && table.has("response") && table.has("over");
    for (const std::string &name : envelope.tests) {
      const TestEntry *test = find_entry(study.tests, name);
      if (!test) {
        table.error("tests", unknown_name("there is no test", name, names_of(study.tests)));
        good = false;
      }
      if (!good) continue;
      const std::string of_test = response_unit(table, *test, envelope.response);
      good = !of_test.empty() && check_over(table, *test, envelope.over, of_test);
      if (const auto value = value_in(*test, envelope.over)) different.insert(*value);
      else computed = true;
      si_unit = of_test;
    }
    if (good && !computed && different.size() < kFewest)
      table.error("tests", "a line with its errors needs tests at three different '" +
                               envelope.over + "' or more; these have " +
                               std::to_string(different.size()));
    if (good && computed && named.size() < kFewest)
      table.error("tests", "a line with its errors needs three different tests or more; here are " +
                               std::to_string(named.size()));
    envelope.unit = table.has("unit") && unit ? *unit : si_unit;
    if (good && !same_dimension(envelope.unit, si_unit))
      table.error("unit", "the unit '" + envelope.unit + "' isn't one of the response; allowed here: " +
                              join(allowed_units(si_unit)));
    study.envelopes.push_back(envelope);
  }
}

}  // namespace bondlab
