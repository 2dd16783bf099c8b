// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: where the results of a study go (declared in commands.h).
#include <filesystem>

#include "app/commands.h"

namespace bondlab {

std::string results_directory(const std::string &out_option, const std::string &study_name) {
  if (!out_option.empty()) return out_option;
  return (std::filesystem::path("bondlab-results") / study_name).string();
}

}  // namespace bondlab
