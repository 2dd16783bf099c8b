// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a trial on the engine as a table and its counts, in Markdown, and as JSON.
// Method: counts with 95 % binomial intervals (Clopper & Pearson 1934), ours and the others'.
// Units: sizes SI. Failure: as write_file().
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnose/hidden_trial.h"

namespace bondlab::diagnose {

std::string trial_line(const TrialCase &trial);  // for a person, as the trial goes on
std::string trial_markdown(const std::vector<TrialCase> &cases);
void write_trial(const std::vector<TrialCase> &cases, const std::filesystem::path &out);

}  // namespace bondlab::diagnose
