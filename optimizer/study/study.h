// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a study as data: what is tested, what may vary, what was measured, what is to be fitted.
// Method: read_study() reads the TOML file, the test.toml of every virtual test it names and the
// data folder, checks all
//   of it, and either returns a Study that needs no further checks or throws UserErrors with
//   everything that is wrong. Nothing is run or written. The format is documented in study.md.
// Units: every number here is in SI; `unit` members say only how a person wants it shown.
// Failure: UserErrors (StudyErrors), each with file:line:column, the value given and the values
// allowed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/user_error.h"
#include "specimen/container.h"
#include "specimen/insertion.h"
#include "specimen/size_distribution.h"
#include "study/measurement.h"
#include "study/test_definition.h"

namespace bondlab {

using StudyErrors = UserErrors;

using SpecimenShape = ContainerShape;
enum class Scale { linear, logarithmic };

struct SpecimenEntry {
  std::string name;
  SpecimenShape shape = SpecimenShape::rectangle;
  Dimensions size;      // m; those the shape has, and its notch
  double thickness =
      1;             // m; of 2D specimens (rectangle, disc): mass pi R^2 t rho, forces in newtons
  double r_min = 0;               // m; smallest particle radius
  double r_ratio = 1.66;          // largest over smallest radius
  std::string sizes = "uniform";  // a size distribution of the generator; its values:
  double r_median = 0, r_spread = 0;  // m, 1; log-normal
  std::vector<SizeClass> classes;     // discrete
  double d10 = 0, d50 = 0, d90 = 0;   // m; d10-d50-d90
  std::string method = "expansion";   // a way of packing
  long tries = default_tries;         // of method insertion
  double density = 2600;          // kg/m3; of the particles
  std::uint64_t seed = 1;
  Place place;
  int dimensions() const { return is_flat(shape) ? 2 : 3; }
};

// The value of a deck variable: a number in SI, or a word ("weibull").
struct DeckValue {
  double number = 0;
  std::string word;  // not empty: the value is this word
  bool is_word() const { return !word.empty(); }
  std::string text() const;  // canonical: what the deck gets and what is hashed
};

struct TestEntry {
  std::string name;      // unique in the study; ForwardRequest::test
  std::string test;      // as written: folder in inputs/, or a path from the study file
  std::string specimen;  // name of a SpecimenEntry
  int ranks = 1;
  double wall_limit = 0;                       // s
  std::map<std::string, DeckValue> variables;  // fixed deck variables
  TestDefinition definition;
  Place place;
};

struct Parameter {
  std::string name;
  std::string unit;             // to show it in
  double lower = 0, upper = 0;  // SI
  std::optional<double> start;  // SI, inside the bounds; absent: the middle in transformed space
  Scale scale = Scale::linear;
  std::vector<std::string> sets;  // deck variables that take its value
  std::string source;             // where the bounds come from, may be empty
  Place place;
};

// Where a figure comes from: a response of one test, or the line of an envelope through several.
struct FigureSource {
  std::string test;      // name of a TestEntry; empty: from an envelope
  std::string envelope;  // name of an EnvelopeEntry; empty: from a test
  std::string response;  // name in the test's definition; of an envelope: one of envelope_figures()
};

struct Target : FigureSource {
  std::string name;
  std::string unit;      // to show it in
  double value = 0;      // SI
  double sd = 0;         // SI, > 0
  std::string source, sd_source;
  Place place;
};

struct FitEntry {
  std::string name;
  std::vector<std::string> targets;    // names; fitted
  std::vector<std::string> predicted;  // names; computed and reported, not fitted
  Place place;
};

// A straight line value = c + over tan(phi) through one response of several tests.
struct EnvelopeEntry {
  std::string name;
  std::vector<std::string> tests;  // names of TestEntry; three or more
  std::string response;            // of each of them
  std::string over;                // another response of each, or a numeric deck variable, of the
                                   // same dimension
  std::string unit;                // to show c in
  Place place;
};

struct FitOptions {
  int lhs_points = 12;
  int max_iterations = 8;
  std::uint64_t seed = 1;
  double difference_step =
      0.03;               // relative to a parameter's value; at least 0.02, below it is noise
  double prior_sd = 1.5;  // of the prior in transformed (logit) space, centred at 0
  int packings = 3;       // other packings the result is checked on
  int jobs = 0;           // runs at a time; 0: cores / ranks
  int max_failed = 3;     // forward runs that may fail before a fit gives up
};

// A response by the name that published tables give it, and how close a simulation has to come.
struct PublishedQuantity : FigureSource {
  std::string name;
  std::string unit;            // to show it in
  double tolerance = 0;        // SI, or a share of the published value
  bool relative = true;
  bool judged = true;          // else only reported
  // Published exponents of a power law, by parameter or specimen size; then only these are fitted,
  // with one constant a group of cases.
  std::map<std::string, double> exponents;
  Place place;
};

// One row of a published table: a parameter set and what its authors got with it.
struct PublishedCase {
  std::string name;
  std::vector<double> values;                // in the order of Study::parameters, SI
  std::map<std::string, double> expected;    // by the name of a PublishedQuantity, SI
  std::map<std::string, double> expected_sd; // where it was published
  std::string group;                         // cases of one material; may be empty
  int packings = 0;                          // 0: the study's case_packings
  bool heavy = false;                        // only run when asked for
  std::map<std::string, double> sizes;       // m, 1; what its specimens have instead of the study's
  // Tests made for a case with specimens of its own: the study's test -> the case's, which is a
  // TestEntry as well, named "test@case".
  std::map<std::string, std::string> own_tests;
  std::string source;
  Place place;
  const std::string &test(const std::string &of_study) const {
    const auto own = own_tests.find(of_study);
    return own == own_tests.end() ? of_study : own->second;
  }
};

struct Assumption {
  std::string text;
  std::string source;
};

struct Study {
  std::string name, title;
  std::filesystem::path file;  // as given by the user
  std::string source_text;     // the file, for the report
  std::vector<SpecimenEntry> specimens;
  std::vector<TestEntry> tests;
  std::vector<Parameter> parameters;
  std::vector<Target> targets;
  std::vector<FitEntry> fits;
  std::vector<EnvelopeEntry> envelopes;
  FitOptions options;
  std::vector<PublishedQuantity> quantities;
  std::vector<PublishedCase> cases;
  int case_packings = 5;        // packings each case is run on
  bool relative_cases = false;  // show figures over those of the group's first case, too
  std::vector<Assumption> assumptions;
  std::vector<std::string> notes;
  std::optional<DataFolder> data;

  // Look-ups by name; a name that isn't there is a UserError that lists the names that are.
  const SpecimenEntry &specimen(const std::string &name) const;
  const TestEntry &test(const std::string &name) const;
  const Parameter &parameter(const std::string &name) const;
  const Target &target(const std::string &name) const;
  const FitEntry &fit(const std::string &name) const;
  const EnvelopeEntry &envelope(const std::string &name) const;
};

// What the line of an envelope gives: "cohesion" in the unit of its response, "friction_angle" in rad.
const std::vector<std::string> &envelope_figures();

// The tests whose runs a figure needs, each once.
std::vector<std::string> tests_of(const Study &study, const FigureSource &source);

// The SI unit of a figure of a study that read_study() accepted.
std::string unit_of(const Study &study, const FigureSource &source);

// "UCS of test ucs", "cohesion of envelope peak".
std::string source_text(const FigureSource &source);

Study read_study(const std::filesystem::path &file);

// The deck variables that the parameters set in one test: values in the order of study.parameters,
// SI. Variables the test doesn't have are left out, so that one parameter list serves tests with
// different decks.
std::map<std::string, double> deck_variables(const Study &study, const std::string &test,
                                             const std::vector<double> &values);

}  // namespace bondlab
