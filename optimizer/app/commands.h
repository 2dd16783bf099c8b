// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the subcommands of `bondlab`, one file each; main.cpp puts them together.
// Method: add_X() adds the subcommand and its options to the application and a callback that does
// the work. A callback
//   returns normally for exit status 0 and throws otherwise: UserError (1), RunsFailed (2),
//   Interrupted (130 or 143), anything else (3).
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

namespace bondlab {

// Forward runs failed beyond what the policy allows: exit status 2. The text names the runs and
// where they are kept.
class RunsFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

void add_check(CLI::App &app);
void add_run(CLI::App &app);
void add_compare(CLI::App &app);
void add_fit(CLI::App &app);
void add_report(CLI::App &app);
void add_specimen(CLI::App &app);
void add_view(CLI::App &app);
void add_diagnose(CLI::App &app);
void add_hide(CLI::App &app);
void add_trial(CLI::App &app);

// Where the results of a study go: --out, or bondlab-results/<study name> in the current directory.
std::string results_directory(const std::string &out_option, const std::string &study_name);

}  // namespace bondlab
