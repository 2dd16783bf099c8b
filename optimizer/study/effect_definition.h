// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a candidate for a missing effect as data: one TOML file in inputs/effects/, so that a user
//   adds his own without a line of C++ where the decks already have the variables.
// Method: the file says what the effect is, how large it may be, which deck variables it sets and
//   how, where its trace is expected, what it is confused with and which test separates it; the
//   format is in inputs/effects/README.md. read_effects() reads a folder in the order of its file
//   names and checks all of it at once.
// Units: sizes in SI; `unit` says how a person wants them shown. A deck variable gets SI too and is
//   turned into the deck's own unit by deck_number().
// Failure: UserErrors with file:line:column, the value given and the values allowed.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/user_error.h"

namespace bondlab {

// What an effect of size s makes of a variable that is b without it.
enum class SetRule {
  set,            // s
  inverse,        // 1/s
  add,            // b + s
  scale,          // b (1 + s)
  scale_inverse,  // b / (1 + s)
  fixed,          // a number that goes with the effect, whatever the size
  word            // a word, whatever the size
};

struct EffectSetting {
  std::string variable;
  SetRule rule = SetRule::add;
  double value = 0;  // of `fixed`, SI
  std::string unless;  // a deck variable: above 0 it keeps the effect away from this one
  std::string word;
  Place place;
};

// What an error of measuring makes of a measured column; no deck variable does.
enum class MeasuringRule {
  scale,     // v (1 + s)
  saturate,  // never above (1 - s) of the largest of all specimens of the series
  drift      // v (1 + s r), r from 0 to 1 over the specimens in the order they were tested
};

struct MeasuringError {
  std::string columns;  // a column's name, or "loads": every stress and force
  std::string test;     // kind of test; empty: all
  MeasuringRule rule = MeasuringRule::scale;
  Place place;
};

struct EffectDefinition {
  std::string name, title, description;
  std::string kind;                               // bond, specimen, machine, conversion
  std::string size_name, unit;                    // the parameter that is its size
  double switch_on = 0, lowest = 0, largest = 0;  // SI
  std::vector<EffectSetting> sets;                // deck variables
  std::string scales_test;                        // kind of test whose stresses it scales by 1 + s
  std::vector<MeasuringError> measures;           // for data made by `bondlab hide`
  std::vector<std::string> expected;              // "uniaxial_compression: post-peak, up"
  std::vector<std::string> confused_with;         // names of effects
  std::string separating_test;                    // in words
  Place place;
};

EffectDefinition read_effect(const std::filesystem::path &file, ErrorCollector &errors);

// Every *.toml of the folder; names that are used twice or confused_with nobody are errors.
std::vector<EffectDefinition> read_effects(const std::filesystem::path &folder);

// The deck variables with the effect at this size; those that the deck lacks are left alone, so
// that one file serves all tests. `touched` tells whether there was any.
std::map<std::string, double> with_effect(const EffectDefinition &effect, double size,
                                          const std::map<std::string, double> &without,
                                          bool &touched);

}  // namespace bondlab
