// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the study's own text with the named effects switched on and the refitted parameters as
//   starts, and the difference as a person reads it.
// Method: the file is changed line by line, so that its comments and order stay: in every test
//   whose deck has a variable of the effect, the entry in the test's `variables = { ... }` is
//   replaced or added; each parameter gets or changes its `start`. Values that the effect derives
//   from the study's own (add, scale) are worked out from the deck's value. A variable that an
//   effect sets leaves the `sets` of its parameter, since a study can't fix and fit it at once: it
//   stands at its value of now when the others are fitted again. A conversion error has no deck
//   variable: it is a comment at the end, for a person.
// Units: numbers as the deck wants them, without unit. Failure: a test whose variables are not
//   written on one line gets a line of its own, which TOML may refuse, and a parameter whose only
//   variable an effect sets keeps it: read_study() tells of both.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/effect_definition.h"
#include "study/study.h"

namespace bondlab::diagnose {

struct SizedEffect {
  EffectDefinition effect;
  double size = 0;  // SI
};

// The study's text as a file in another folder reads it: the paths in it, which are relative to the
// study's own file ([data] folder, a test's with a '/'), turned into paths from `folder`.
std::string moved_study(const std::string &text, const std::filesystem::path &study_file,
                        const std::filesystem::path &folder);

std::string study_with_effects(const Study &study, const std::vector<SizedEffect> &effects,
                               const std::vector<double> &parameters);

// Lines removed (-) and added (+) with the line numbers of the first. Of a long table only the
// entries about the change are shown.
std::string readable_diff(const std::string &before, const std::string &after);

}  // namespace bondlab::diagnose
