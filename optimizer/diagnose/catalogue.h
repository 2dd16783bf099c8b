// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what the diagnosis knows about a candidate effect besides its trace.
// Method: plain data; inputs/effects/ holds one file an effect, see README.md there.
// Units: sizes in the effect's own unit, SI. Failure: none.
#pragma once

#include <string>
#include <vector>

namespace bondlab::diagnose {

enum class EffectKind { bond, specimen, machine, conversion };
std::string to_string(EffectKind kind);

struct EffectEntry {
  std::string name;   // "norton_creep"
  std::string title;  // for people
  EffectKind kind = EffectKind::bond;
  std::string size_name, unit;  // of the parameter that is its size
  double switch_on = 1;         // a little: the size at which the trace is taken
  double lowest = 0;            // admissible sizes; 0 where only one sign makes sense
  double largest = 1;
  std::vector<std::string> expected;       // "uniaxial_compression: hold, down"
  std::vector<std::string> confused_with;  // names of effects
  std::string separating_test;             // in words
};

}  // namespace bondlab::diagnose
