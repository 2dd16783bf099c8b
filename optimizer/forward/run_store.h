// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: remember every forward run, so that a finished one is never repeated and one that was cut
// off is done again. Method: one SQLite file (WAL, synchronous=FULL: what was committed survives
// kill -9 and a power cut), one row a run key,
//   one row a failure. A run belongs to the process that claimed it (host, boot, pid and the pid's
//   start time), so that a run left `running` by a dead process is told from one that another
//   bondlab is still computing. States and what comes next:
//     queued   asked for, nobody has begun      -> claimed when a process comes to it
//     running  claimed by a process             -> if that process is gone: lost; else its result
//     is waited for done     result in its folder             -> given out without running; its
//     folder gone: lost failed   with a named cause               -> a later command tries again,
//     up to max_attempts attempts in all lost     cut off, or its files are gone   -> claimed again
//     like queued; not counted as an attempt
// Units: seconds. Failure: UserError when the file isn't a store, is of another schema version, or
// can't be written. Limits: WAL needs a local disk (not NFS). Processes on other hosts are judged
// by their heartbeat alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forward/forward_model.h"
#include "forward/run_plan.h"

struct sqlite3;

namespace bondlab {

enum class RunState { queued, running, done, failed, lost };
std::string to_string(RunState state);

// What identifies a process beyond its number, which the system uses again.
struct ProcessIdentity {
  std::string host, boot;
  std::int64_t pid = 0;
  std::int64_t start_ticks = 0;
};
ProcessIdentity this_process();
ProcessIdentity process_identity(std::int64_t pid);  // start_ticks 0 when there is no such process
bool is_alive(const ProcessIdentity &process);       // on this host and boot

struct RunRecord {
  std::int64_t id = 0;
  std::string key, point, test, workload;
  std::uint64_t seed = 0;
  RunState state = RunState::queued;
  int attempts = 0;       // begun and ended by themselves: done or failed
  std::string directory;  // from the results folder
  FailureCause cause = FailureCause::none;
  std::string message;
  double wall_seconds = 0;
  ProcessIdentity owner;
  double heartbeat = 0;  // s since 1970, of the owner
};

class RunStore {
 public:
  static constexpr int schema_version = 1;

  // Opens or makes the store. Refuses a file of another schema version.
  explicit RunStore(const std::filesystem::path &file);
  ~RunStore();
  RunStore(const RunStore &) = delete;
  RunStore &operator=(const RunStore &) = delete;

  // The run of a key, made `queued` when it is new.
  RunRecord get_or_queue(const RunKey &key, const RunPlan &plan);
  std::optional<RunRecord> find(const std::string &key) const;

  // Takes a run that is queued, lost, failed or running in a dead process; false when somebody else
  // was faster or has it.
  bool claim(std::int64_t id, const std::string &directory);
  void finish_done(std::int64_t id, double wall_seconds);
  void finish_failed(std::int64_t id, const Failure &failure, double wall_seconds);
  void mark_lost(std::int64_t id, const std::string &why);

  // Says that this process is alive; call it every few seconds while runs are going on.
  void heartbeat();
  // Whether the process a run is `running` in is still there.
  bool owner_is_alive(const RunRecord &run) const;

  // Mean wall time of the finished runs of a workload; nothing when there are none.
  std::optional<double> mean_seconds(const std::string &workload) const;

  struct Counts {
    int queued = 0, running = 0, done = 0, failed = 0, lost = 0;
  };
  Counts counts() const;

 private:
  class Statement;
  void execute(const std::string &sql) const;
  [[noreturn]] void fail(const std::string &doing) const;
  RunRecord read_row(Statement &row) const;

  std::filesystem::path file_;
  sqlite3 *database_ = nullptr;
  ProcessIdentity self_;
};

}  // namespace bondlab
