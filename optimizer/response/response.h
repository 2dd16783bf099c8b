// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: turn one curve of a virtual test into one macro-quantity (E, nu, UCS, splitting strength
//   ...), by name.
// Method: a test.toml names the function (`from = "uniaxial.peak_stress"`), the registry finds it.
//   Each kind of test has one file in this room (uniaxial, brazilian); a new kind of test adds a
//   file and its lines in response.cpp.
// Units: SI throughout (Pa, N, m, s, strain as a ratio).
// Failure: ResponseError with a cause that can be counted and a sentence for a person. A curve that
//   cannot carry a quantity (test not finished, too few samples) gives an error and never a number.
//   Doubts that do not spoil the number itself (the platens' forces differ) are quality figures:
//   functions of their own in the same registry.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "forward/forward_model.h"

namespace bondlab {

enum class ResponseCause {
  unknown_function,    ///< no function of that name is registered
  missing_column,      ///< the curve lacks a column the function reads
  missing_variable,    ///< a deck variable (diameter, thickness ...) is absent or not positive
  bad_data,            ///< a NaN or infinity, or columns of different length
  time_not_monotonic,  ///< time goes back or stands still
  no_load,             ///< the specimen never carried load
  test_not_finished,   ///< the load never fell behind its peak: the peak may lie ahead
  window_too_small,    ///< too few samples between 40 and 60 % of the peak for a regression
  implausible          ///< a number came out that no test can give, e.g. a negative modulus
};

/// The cause as one word, for logs and counts, e.g. "test_not_finished".
const char *to_string(ResponseCause cause);

class ResponseError : public std::runtime_error {
 public:
  ResponseError(ResponseCause cause, const std::string &sentence);
  ResponseCause cause() const { return cause_; }

 private:
  ResponseCause cause_;
};

/// What a response may need besides the curve: the deck variables of the run, SI.
struct ResponseContext {
  std::map<std::string, double> variables;

  /// A variable that must be there and positive (a length, a thickness).
  double positive(const std::string &name) const;
};

/// The quantity `function` of `curve`.
double evaluate(const std::string &function, const Curve &curve, const ResponseContext &context);

/// Registered names, sorted, to be printed where an unknown one is refused.
std::vector<std::string> response_functions();

bool is_response_function(const std::string &function);

/// Quality figures of a run, by the family of a response function: name -> value. Empty when the
/// family has none. Family is the part before the dot ("uniaxial"). Never throws: a figure that
/// cannot be had is left out.
std::map<std::string, double> quality_figures(const std::string &function, const Curve &curve,
                                              const ResponseContext &context);

}  // namespace bondlab
