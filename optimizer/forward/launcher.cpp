// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/launcher.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

#include "base/user_error.h"

extern char **environ;

namespace bondlab {

namespace fs = std::filesystem;

namespace {

constexpr const char *kMark = "BONDLAB_RUN_DIR";
constexpr double kGrace =
    2;  // s between SIGTERM and SIGKILL: mpirun needs some tenths to end its ranks
constexpr double kLookInterval = 0.5;  // s between looks at the watched files

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::vector<pid_t> processes_of_run(const fs::path &directory) {
  const std::string mark = std::string(kMark) + "=" + directory.string();
  std::vector<pid_t> found;
  std::error_code error;
  for (const fs::directory_entry &entry : fs::directory_iterator("/proc", error)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream stream(entry.path() / "environ", std::ios::binary);
    const std::string environment((std::istreambuf_iterator<char>(stream)),
                                  std::istreambuf_iterator<char>());
    for (std::size_t begin = 0; begin < environment.size();) {
      const std::size_t end = std::min(environment.find('\0', begin), environment.size());
      if (environment.compare(begin, end - begin, mark) == 0) {
        found.push_back(static_cast<pid_t>(std::atol(name.c_str())));
        break;
      }
      begin = end + 1;
    }
  }
  return found;
}

}  // namespace

void kill_processes_of_run(const fs::path &directory) {
  // More than once: a process that is just being forked shows up only in the next round.
  for (int round = 0; round < 20; ++round) {
    const std::vector<pid_t> processes = processes_of_run(directory);
    if (processes.empty()) return;
    for (const pid_t process : processes)
      if (process != getpid()) ::kill(process, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

EngineProcess::EngineProcess(const Launch &launch) : launch_(launch) {
  std::vector<std::string> variables;
  for (char **variable = environ; *variable; ++variable) {
    const std::string text = *variable, name = text.substr(0, text.find('='));
    if (name != kMark && !launch_.environment.count(name)) variables.push_back(text);
  }
  for (const auto &[name, value] : launch_.environment) variables.push_back(name + "=" + value);
  variables.push_back(std::string(kMark) + "=" + launch_.directory.string());
  std::vector<char *> arguments, environment;  // all made before fork: the child may not allocate
  for (std::string &word : launch_.command) arguments.push_back(word.data());
  for (std::string &variable : variables) environment.push_back(variable.data());
  arguments.push_back(nullptr);
  environment.push_back(nullptr);

  int report[2];  // the child's errno, if it can't start
  if (pipe2(report, O_CLOEXEC) != 0)
    throw UserError(std::string("no pipe for a new process: ") + std::strerror(errno));
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) {
    const int reason = errno;
    close(report[0]);
    close(report[1]);
    throw UserError(std::string("no new process can be made: ") + std::strerror(reason));
  }
  if (pid_ == 0) {
    setsid();
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int input = open("/dev/null", O_RDONLY);
    const int output = open(launch_.screen.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (getppid() == parent && input >= 0 && output >= 0 && dup2(input, 0) == 0 &&
        dup2(output, 1) == 1 && dup2(output, 2) == 2 && chdir(launch_.directory.c_str()) == 0)
      execve(arguments[0], arguments.data(), environment.data());
    const int reason = errno;
    if (write(report[1], &reason, sizeof reason) < 0) _exit(126);
    _exit(127);
  }
  close(report[1]);
  int reason = 0;
  ssize_t got;
  do got = read(report[0], &reason, sizeof reason);
  while (got < 0 && errno == EINTR);
  close(report[0]);
  if (got > 0) {
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
    throw UserError("'" + launch_.command[0] + "' can't be started in '" +
                    launch_.directory.string() + "': " + std::strerror(reason));
  }
  started_ = last_progress_ = last_look_ = Clock::now();
}

EngineProcess::~EngineProcess() {
  if (pid_ > 0 && !ended_) kill();
}

double EngineProcess::seconds() const { return seconds_since(started_); }

bool EngineProcess::progressed() {
  std::uintmax_t size = 0;
  for (const fs::path &file : launch_.watched) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(file, error);
    if (!error) size += bytes;
  }
  const bool grown = size != watched_size_;
  watched_size_ = size;
  return grown;
}

void EngineProcess::terminate(EndReason reason) {
  if (terminating_) return;
  terminating_ = true;
  terminated_ = Clock::now();
  end_.reason = reason;
  ::kill(-pid_, SIGTERM);  // mpirun takes its ranks along
}

bool EngineProcess::poll() {
  if (ended_) return true;
  int status = 0;
  const pid_t got = waitpid(pid_, &status, WNOHANG);
  if (got == pid_) {
    ended_ = true;
    end_.wall_seconds = seconds();
    end_.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    end_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (end_.status != 0)
      kill_processes_of_run(launch_.directory);  // a crashed mpirun may leave ranks behind
    return true;
  }
  if (terminating_) {
    if (!killed_ && seconds_since(terminated_) > kGrace) {
      kill_processes_of_run(launch_.directory);
      killed_ = true;
    }
    return false;
  }
  if (launch_.wall_limit > 0 && seconds() > launch_.wall_limit) {
    terminate(EndReason::wall_limit);
  } else if (launch_.stall_limit > 0 && seconds_since(last_look_) > kLookInterval) {
    last_look_ = Clock::now();
    if (progressed())
      last_progress_ = last_look_;
    else if (seconds_since(last_progress_) > launch_.stall_limit)
      terminate(EndReason::stalled);
  }
  return false;
}

void EngineProcess::kill() {
  if (ended_) return;
  if (!terminating_) end_.reason = EndReason::killed;
  terminating_ = true;
  ::kill(-pid_, SIGTERM);
  const Clock::time_point begin = Clock::now();
  int status = 0;
  pid_t got = 0;
  while ((got = waitpid(pid_, &status, WNOHANG)) == 0 && seconds_since(begin) < 0.5)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill_processes_of_run(launch_.directory);
  if (got == 0) waitpid(pid_, &status, 0);
  ended_ = true;
  end_.wall_seconds = seconds();
  end_.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace bondlab
