// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the forward model that runs lmp_bondlab: from a batch of requests to curves or named
// failures, through the run store. Method: every request is planned, its specimen made or reused,
// its key looked up. What isn't known is run, as many at a
//   time as there are cores (ranks counted), each in a folder and session of its own; what another
//   bondlab is computing is waited for. Failures are kept with their folders and tried again by a
//   later command, up to max_attempts attempts in all; one command never runs the same key twice. A
//   run cut off (kill -9, SIGINT) is lost and done again.
// Why one thread with polling: a run takes seconds, a look takes microseconds, and the death signal
// of a child belongs to
//   the thread that started it.
// Units: SI. Failure: see forward_model.h. Limits: two bondlab at a time each believe all cores to
// be theirs.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "forward/engine.h"
#include "forward/forward_model.h"
#include "forward/run_plan.h"
#include "forward/run_store.h"
#include "study/study.h"

namespace bondlab {

struct ForwardSettings {
  std::filesystem::path results;  // gets runs/, specimens/, store.sqlite
  Engine engine;                  // find_engine()
  int jobs = 0;                   // runs at a time; 0: as many as the cores take
  int cores = 0;                  // 0: available_cores()
  int max_attempts = 3;           // of a failing run, over all commands
  double stall_limit =
      0;  // s without output before a run counts as hung; 0: half its wall limit, at least 60 s
  SpecimenSource specimens;  // empty: the generator, with files in results/specimens
};

class EngineForwardModel : public ForwardModel {
 public:
  // Opens the store. UserError when ranks x jobs is more than the cores.
  EngineForwardModel(const Study &study, ForwardSettings settings);
  ~EngineForwardModel() override;

  std::vector<ForwardOutcome> run(const std::vector<ForwardRequest> &requests,
                                  std::function<void(const BatchProgress &)> progress) override;

  RunStore &store() { return *store_; }

 private:
  class Batch;

  const Study study_;
  ForwardSettings settings_;
  std::unique_ptr<RunStore> store_;
  std::map<std::string, ForwardOutcome>
      failed_here_;  // by key: what this command has tried already
};

// UserError when a test of the study can't run with `jobs` at a time on `cores`.
void check_cores(const Study &study, int jobs, int cores);

// Specimens from the generator, cached in `folder`.
SpecimenSource generated_specimens(const std::filesystem::path &folder);

}  // namespace bondlab
