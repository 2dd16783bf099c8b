// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/check.h"

#include "response/response.h"

namespace bondlab {

void check_response_functions(const Study &study) {
  ErrorCollector errors;
  const auto known = response_functions();
  for (const auto &test : study.tests)
    for (const auto &entry : test.definition.responses) {
      const auto &response = entry.second;
      if (is_response_function(response.function)) continue;
      const std::string nearest = nearest_word(response.function, known);
      errors.add(response.place, "the response '" + response.name + "' comes from '" +
                                     response.function +
                                     "', which isn't a function of this program" +
                                     (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
                                     " (allowed: " + join(known) + ")");
    }
  errors.throw_if_any();
}

}  // namespace bondlab
