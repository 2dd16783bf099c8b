// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: names of the failure causes, as stored and shown (declared in forward_model.h).
#include <utility>

#include "base/user_error.h"
#include "forward/forward_model.h"

namespace bondlab {

static constexpr std::pair<FailureCause, const char *> kNames[] = {
    {FailureCause::none, "none"},
    {FailureCause::deck_error, "deck_error"},
    {FailureCause::engine_crash, "engine_crash"},
    {FailureCause::lost_atoms, "lost_atoms"},
    {FailureCause::bond_atoms_missing, "bond_atoms_missing"},
    {FailureCause::runaway_atoms, "runaway_atoms"},
    {FailureCause::not_a_number, "not_a_number"},
    {FailureCause::timeout, "timeout"},
    {FailureCause::no_progress, "no_progress"},
    {FailureCause::truncated_output, "truncated_output"},
    {FailureCause::missing_output, "missing_output"},
    {FailureCause::bad_output, "bad_output"},
    {FailureCause::launcher, "launcher"},
    {FailureCause::specimen, "specimen"}};

std::string to_string(FailureCause cause) {
  for (const auto &[value, name] : kNames)
    if (value == cause) return name;
  return "none";
}

FailureCause failure_cause_from(const std::string &name) {
  for (const auto &[value, text] : kNames)
    if (name == text) return value;
  throw UserError("'" + name + "' isn't a cause of failure");
}

}  // namespace bondlab
