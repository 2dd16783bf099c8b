// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the one interface between those who decide which points to run and whatever computes them: a
// batch of requests in,
//   a batch of outcomes (curves, or a named failure) out.
// Method: an outcome stands at the index of its request. A failed run is an outcome, not an
// exception: one bad point never
//   loses a batch. Equal requests in one batch are computed once.
// Units: SI. Failure: run() throws UserError for what concerns the whole batch (engine not found,
// ranks x jobs beyond the
//   cores, a store of another version) and Interrupted when SIGINT or SIGTERM stopped it (finished
//   runs are kept).
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "forward/curve.h"
#include "forward/measured_cost.h"

namespace bondlab {

struct ForwardRequest {
  std::string test;                         // name of a TestEntry
  std::map<std::string, double> variables;  // SI; the deck variables set by parameters
  int packing = 0;                          // 0: the study's own seed; k: that seed + k
};

enum class FailureCause {
  none,
  deck_error,
  engine_crash,
  lost_atoms,
  bond_atoms_missing,
  runaway_atoms,
  not_a_number,
  timeout,
  no_progress,
  truncated_output,
  missing_output,
  bad_output,  // not readable as the format, or a column that responses need is missing
  launcher,
  specimen
};
std::string to_string(FailureCause cause);
FailureCause failure_cause_from(const std::string &name);

struct Failure {
  FailureCause cause = FailureCause::none;
  std::string message;  // one or two sentences, with the deck's file and line or the engine's words
                        // where known
  std::string run_directory;  // kept
  std::string command;        // replays the run
  std::string log_tail;       // last lines of what the engine wrote
};

struct ForwardOutcome {
  bool ok = false;
  Failure failure;
  Curve curve;
  std::string run_id;
  std::string run_directory;
  std::string replay_command;
  double wall_seconds = 0;
  std::optional<MeasuredCost> cost;  // of a run of the engine that came to its end
  bool from_store = false;
  std::map<std::string, double> deck_variables;  // every numeric deck variable of the run (fixed,
                                                 // set, specimen's dimensions), SI
};

struct BatchProgress {
  int total = 0;  // different runs in the batch
  int done = 0;   // finished well, from_store included
  int from_store = 0;
  int failed = 0;
  int running = 0;
  double elapsed = 0;  // s
  double left = -1;    // s, estimated from the runs finished so far; negative: unknown yet
};

class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(int signal)
      : std::runtime_error("interrupted by a signal"), signal_(signal) {}
  int signal() const { return signal_; }

 private:
  int signal_;
};

class ForwardModel {
 public:
  virtual ~ForwardModel() = default;
  virtual std::vector<ForwardOutcome> run(const std::vector<ForwardRequest> &requests,
                                          std::function<void(const BatchProgress &)> progress) = 0;
};

}  // namespace bondlab
