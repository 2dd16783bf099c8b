// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/study.h"

#include <algorithm>
#include <cassert>

#include "base/units.h"

namespace bondlab {

std::string DeckValue::text() const { return is_word() ? word : canonical_number(number); }

template <class Entry>
static const Entry &by_name(const std::vector<Entry> &entries, const std::string &name,
                            const char *kind, const std::filesystem::path &file) {
  std::vector<std::string> names;
  for (const Entry &entry : entries) {
    if (entry.name == name) return entry;
    names.push_back(entry.name);
  }
  throw UserError({file.string(), 0, 0}, std::string("the study has no ") + kind + " '" + name +
                                             "'; it has: " + join(names));
}

const SpecimenEntry &Study::specimen(const std::string &name) const {
  return by_name(specimens, name, "specimen", file);
}
const TestEntry &Study::test(const std::string &name) const {
  return by_name(tests, name, "test", file);
}
const Parameter &Study::parameter(const std::string &name) const {
  return by_name(parameters, name, "parameter", file);
}
const Target &Study::target(const std::string &name) const {
  return by_name(targets, name, "target", file);
}
const FitEntry &Study::fit(const std::string &name) const {
  return by_name(fits, name, "fit", file);
}
const EnvelopeEntry &Study::envelope(const std::string &name) const {
  return by_name(envelopes, name, "envelope", file);
}

const std::vector<std::string> &envelope_figures() {
  static const std::vector<std::string> names{"cohesion", "friction_angle"};
  return names;
}

std::vector<std::string> tests_of(const Study &study, const FigureSource &source) {
  if (source.envelope.empty()) return {source.test};
  std::vector<std::string> tests;
  for (const std::string &name : study.envelope(source.envelope).tests)
    if (std::find(tests.begin(), tests.end(), name) == tests.end()) tests.push_back(name);
  return tests;
}

std::string unit_of(const Study &study, const FigureSource &source) {
  if (source.envelope.empty())
    return study.test(source.test).definition.responses.at(source.response).unit;
  if (source.response == "friction_angle") return "rad";
  const EnvelopeEntry &envelope = study.envelope(source.envelope);
  return study.test(envelope.tests.front()).definition.responses.at(envelope.response).unit;
}

std::string source_text(const FigureSource &source) {
  return source.response + (source.envelope.empty() ? " of test " + source.test
                                                    : " of envelope " + source.envelope);
}

std::map<std::string, double> deck_variables(const Study &study, const std::string &test,
                                             const std::vector<double> &values) {
  assert(values.size() == study.parameters.size());
  const TestEntry &entry = study.test(test);
  std::map<std::string, double> variables;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const std::string &variable : study.parameters[i].sets)
      if (entry.definition.variables.count(variable)) variables[variable] = values[i];
  return variables;
}

}  // namespace bondlab
