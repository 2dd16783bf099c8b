// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one batch of forward runs from start to end; the state that EngineForwardModel::run needs
// while it goes on. Method: equal requests share a Job. A job waits for cores, runs, or watches
// another process compute its key; the loop
//   looks at all of them every few milliseconds until each has an outcome. Leaving the batch by an
//   exception kills what runs and marks it lost.
// Units: seconds. Failure: as EngineForwardModel. Limits: internal to this room.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "forward/engine_forward_model.h"
#include "forward/failure.h"
#include "forward/launcher.h"
#include "forward/run_folder.h"

namespace bondlab {

class EngineForwardModel::Batch {
 public:
  Batch(const Study &study, const ForwardSettings &settings, RunStore &store,
        std::map<std::string, ForwardOutcome> &failed_here,
        std::function<void(const BatchProgress &)> progress);
  ~Batch();

  std::vector<ForwardOutcome> run(const std::vector<ForwardRequest> &requests);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Stage { pending, running, elsewhere, settled };
  struct Job {
    RunPlan plan;
    RunKey key;
    Stage stage = Stage::pending;
    ForwardOutcome outcome;
    std::int64_t id = 0;
    std::string directory;  // from the results folder
    RunHistory history;
    std::unique_ptr<EngineProcess> process;
    double expected = -1;  // s, from earlier runs
  };

  std::vector<std::size_t> make_jobs(
      const std::vector<ForwardRequest> &requests);  // job of each request
  void make_specimens(std::vector<Job> &jobs);
  void look_up(Job &job);
  bool fits(const Job &job) const;
  void start(Job &job);
  void forget_lost_run(const RunRecord &run, const std::string &new_directory);
  void finish(Job &job);
  void settle_failed(Job &job, const Failure &failure);
  void fill_common(Job &job, const std::string &directory);
  void report(bool force);
  BatchProgress count() const;
  double seconds_left() const;

  const Study &study_;
  const ForwardSettings &settings_;
  RunStore &store_;
  std::map<std::string, ForwardOutcome> &failed_here_;
  std::function<void(const BatchProgress &)> progress_;
  std::vector<Job> jobs_;
  Clock::time_point begin_, last_report_, last_heartbeat_, last_look_elsewhere_;
  int reported_settled_ = -1, reported_running_ = -1;
};

}  // namespace bondlab
