// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: where a target or a published quantity comes from: `test` and `response`, or `envelope` and
// one of its figures.
#include <algorithm>

#include "study/study_sections.h"

namespace bondlab {

namespace {

std::string unit_from_test(TomlTable &table, const Study &study, const FigureSource &source) {
  const TestEntry *test = find_entry(study.tests, source.test);
  if (!test && !source.test.empty())
    table.error("test", unknown_name("there is no test", source.test, names_of(study.tests)));
  if (!test || test->definition.responses.empty() || source.response.empty()) return "";
  const auto response = test->definition.responses.find(source.response);
  if (response != test->definition.responses.end()) return response->second.unit;
  std::vector<std::string> known;
  for (const auto &[name, definition] : test->definition.responses) known.push_back(name);
  table.error("response", unknown_name("the test '" + test->test + "' has no response",
                                       source.response, known));
  return "";
}

std::string unit_from_envelope(TomlTable &table, const Study &study, const FigureSource &source) {
  const EnvelopeEntry *envelope = find_entry(study.envelopes, source.envelope);
  if (!envelope) {
    table.error("envelope",
                unknown_name("there is no envelope", source.envelope, names_of(study.envelopes)));
    return "";
  }
  if (source.response.empty()) return "";
  const std::vector<std::string> &known = envelope_figures();
  if (std::find(known.begin(), known.end(), source.response) == known.end()) {
    table.error("response", unknown_name("the envelope '" + source.envelope + "' has no response",
                                         source.response, known));
    return "";
  }
  const TestEntry *test =
      envelope->tests.empty() ? nullptr : find_entry(study.tests, envelope->tests.front());
  if (!test || !test->definition.responses.count(envelope->response))
    return "";  // reported already
  return unit_of(study, source);
}

}  // namespace

std::string read_figure_source(TomlTable &table, const Study &study, FigureSource &source) {
  const bool of_envelope = table.has("envelope");
  source.envelope = table.text("envelope");
  source.test = table.text("test", !of_envelope);
  source.response = table.text("response", true);
  if (of_envelope && table.has("test")) {
    table.error("envelope",
                "a figure comes from one 'test' or from one 'envelope'; leave one of them out");
    return "";
  }
  return of_envelope ? unit_from_envelope(table, study, source)
                     : unit_from_test(table, study, source);
}

}  // namespace bondlab
