// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: start one engine run as a session of processes of its own, watch it, and end all of it when
// it must end. Method: fork, setsid, exec with standard input from /dev/null and both outputs in a
// file. poll() looks whether it ended,
//   whether the wall limit is over, and whether any watched file still grows; what must end gets
//   SIGTERM, and SIGKILL two seconds later. Killing goes by the environment variable
//   BONDLAB_RUN_DIR, which every process of a run inherits: mpirun puts its ranks into process
//   groups of their own, so a group isn't enough. The run gets SIGTERM when the thread that started
//   it dies (kill -9 of bondlab).
// Units: seconds. Failure: UserError when the program can't be started. Limits: Linux (/proc,
// prctl).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace bondlab {

struct Launch {
  std::vector<std::string> command;  // command[0] is a path
  std::filesystem::path
      directory;  // of the run: the working directory, and its mark in the environment
  std::map<std::string, std::string> environment;  // beside our own
  std::filesystem::path screen;                    // gets standard output and error
  double wall_limit = 0;                           // s
  double stall_limit = 0;  // s without growth of any watched file; 0: not watched
  std::vector<std::filesystem::path> watched;
};

enum class EndReason { by_itself, wall_limit, stalled, killed };

struct RunEnd {
  EndReason reason = EndReason::by_itself;
  int status = 0;  // exit status; -1 when a signal ended it
  int signal = 0;
  double wall_seconds = 0;
};

class EngineProcess {
 public:
  explicit EngineProcess(const Launch &launch);
  ~EngineProcess();  // kills what still runs
  EngineProcess(const EngineProcess &) = delete;
  EngineProcess &operator=(const EngineProcess &) = delete;

  bool poll();  // true when it has ended; never blocks
  const RunEnd &end() const { return end_; }
  double seconds() const;  // since the start
  void kill();             // all of it, at once, and waits for it

 private:
  using Clock = std::chrono::steady_clock;
  void terminate(EndReason reason);
  bool progressed();

  Launch launch_;
  pid_t pid_ = -1;
  bool ended_ = false;
  bool terminating_ = false, killed_ = false;
  Clock::time_point started_, last_progress_, last_look_, terminated_;
  std::uintmax_t watched_size_ = 0;
  RunEnd end_;
};

// Kills every process that carries this run directory in its environment: what a dead bondlab left
// behind.
void kill_processes_of_run(const std::filesystem::path &directory);

}  // namespace bondlab
