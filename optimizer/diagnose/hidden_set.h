// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a frozen list of cases with something hidden, as data (inputs/hidden/set.toml).
// Method: TOML, read and checked at once. A case's size is in noise units (the norm of the effect's
//   whitened trace off what the parameters can do), because only then are effects comparable.
// Units: none. Failure: UserErrors with file:line:column.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/user_error.h"

namespace bondlab::diagnose {

struct HiddenCase {
  std::string id;
  std::string kind;  // effect, outside, left_out (taken out of the catalogue), pair, null
  std::uint64_t seed = 0;
  std::vector<std::string> effects;  // one; two of a pair; none of a null
  double units = 0;                  // of each effect
  Place place;
};

struct HiddenSet {
  std::filesystem::path laboratory;  // study file, beside the set
  int replicates = 0;
  std::vector<HiddenCase> cases;
};

HiddenSet read_hidden_set(const std::filesystem::path &file);

}  // namespace bondlab::diagnose
