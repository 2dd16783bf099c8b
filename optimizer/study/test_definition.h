// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what a virtual test's test.toml declares: its deck, the variables the optimiser may set, its
// outputs and responses. Method: read once per test folder with positions kept; the deck is
// searched for `variable NAME index DEFAULT` lines, and
//   every variable declared in test.toml must be there, so that the two files can't drift apart.
// Units: `unit` is what the deck's number is in; limits and values are SI here and converted when
// they go to the deck. Failure: errors go to the collector with file:line:column.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/user_error.h"

namespace bondlab {

struct DeckVariable {
  std::string name;
  std::string unit = "1";            // "" after an error in it
  std::optional<double> minimum;     // exclusive: `minimum = 0` means > 0
  std::optional<double> at_least;    // inclusive: `at_least = 0` means >= 0
  std::optional<double> maximum;     // inclusive
  std::vector<std::string> choices;  // not empty: a word of this list instead of a number
  std::string default_text;          // from the deck's `variable NAME index DEFAULT`
  std::string description;
  Place place;
};

struct ResponseDefinition {
  std::string name;
  std::string unit;
  std::string function;  // "uniaxial.peak_stress": file and function in response/
  Place place;
};

struct TestDefinition {
  std::string name;
  std::string description;
  std::filesystem::path folder;                   // absolute
  std::filesystem::path deck;                     // absolute
  std::map<std::string, DeckVariable> variables;  // what the optimiser may set
  std::map<std::string, std::string>
      deck_defaults;  // every `variable NAME index DEFAULT` of the deck
  std::map<std::string, ResponseDefinition> responses;
  std::string curve = "curve.tsv", events = "broken_bonds.tsv",
              particles = "particles_end.txt";  // names in the run directory
  std::vector<std::string> keep;                // further files of a run to keep
  std::vector<std::string> columns;             // the curve must have; empty: any
  std::vector<std::string> shapes;              // specimens it can hold; empty: any
};

// Reads FOLDER/test.toml and the deck it names. Errors are collected; what could be read is
// returned.
TestDefinition read_test_definition(const std::filesystem::path &folder, ErrorCollector &errors);

// Deck variables that the launcher fills in from the specimen; neither test.toml nor a study may
// set them.
const std::vector<std::string>
    &variables_from_specimen();  // specimen, its sizes (container.h), thickness

// The number the deck gets: the SI value in the variable's own unit.
double deck_number(const DeckVariable &variable, double value);

// A number for a deck variable, judged against minimum and maximum; "" when allowed, else what is
// wrong with it.
std::string why_not_allowed(const DeckVariable &variable, double value);

}  // namespace bondlab
