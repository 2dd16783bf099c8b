// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a run's own folder: made before it starts, described by manifest.json and replay.sh, thinned
// out when it is done. Method: runs/NUMBER-TEST-KEY below the results folder, with -2, -3 ... for
// later attempts; never shared by two runs.
//   After success only the outputs of test.toml, the frames that `shots` asked for, the log, the
//   manifest and the replay script stay;
//   a failed run keeps all.
// Units: SI in manifest.json's "si", the deck's own in "variables". Failure: UserError (disk full,
// no permission).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "forward/engine.h"
#include "forward/failure.h"
#include "forward/launcher.h"
#include "forward/measured_cost.h"
#include "forward/run_plan.h"

namespace bondlab {

// A folder that wasn't there before, as a path from `results`.
std::string new_run_folder(const std::filesystem::path &results, std::int64_t id,
                           const RunPlan &plan, const RunKey &key);

// mpirun and the engine with all their arguments.
std::vector<std::string> engine_command(const Engine &engine, const RunPlan &plan);

Launch make_launch(const Engine &engine, const RunPlan &plan, const RunKey &key, std::int64_t id,
                   const std::filesystem::path &folder);

struct RunHistory {
  std::int64_t id = 0;
  std::string state = "running";
  std::string started, finished;  // UTC
  double wall_seconds = 0;
  FailureCause cause = FailureCause::none;
  std::string message;
  std::optional<MeasuredCost> cost;
};
void write_manifest(const std::filesystem::path &folder, const Engine &engine, const RunPlan &plan,
                    const RunKey &key, const RunHistory &history);
void write_replay(const std::filesystem::path &folder, const Engine &engine, const RunPlan &plan,
                  const RunKey &key, std::int64_t id);

// `sh '.../replay.sh'`: repeats the run in a folder beside it.
std::string replay_command(const std::filesystem::path &folder);

void thin_out(const std::filesystem::path &folder, const RunPlan &plan);

// 2026-11-22T05:30:00Z
std::string utc_now();

// 'text' for a shell.
std::string quoted(const std::string &text);

}  // namespace bondlab
