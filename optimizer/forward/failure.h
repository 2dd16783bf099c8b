// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: say whether a run that has ended is a result, and if not, name the cause in words its user
// can act on. Method: the engine's own words come first (an error message names the cause even when
// the run hung after it), then how the
//   process ended, then the curve: present, readable, free of NaN, with its completion line and the
//   columns wanted. A deck error is located by following the commands the log echoes through the
//   deck.
// Why not the exit status alone: a rank that stops may leave the others waiting for ever, and a run
// can end with status 0
//   without having written what was asked for.
// Units: none. Failure: none of its own: whatever can't be read is a cause too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "forward/forward_model.h"
#include "forward/launcher.h"
#include "forward/run_plan.h"

namespace bondlab {

// Names in a run's folder besides those of test.toml.
inline constexpr const char *kLogName = "log.bondlab";
inline constexpr const char *kScreenName = "screen.txt";

struct Verdict {
  bool ok = false;
  FailureCause cause = FailureCause::none;
  std::string message;
  Curve curve;  // when ok
};

Verdict judge_run(const RunEnd &end, const RunPlan &plan, const std::filesystem::path &directory);

// The curve of a run that is done, judged again when it is given out from the store.
Verdict judge_output(const RunPlan &plan, const std::filesystem::path &directory);

// Line of the deck whose command the log echoed last; 0 when it can't be told.
int last_deck_line(const std::string &deck, const std::string &log);

// The last lines of the log, or of the screen output where there is no log; "" when there is
// neither.
std::string log_tail(const std::filesystem::path &directory, int lines = 8);

}  // namespace bondlab
