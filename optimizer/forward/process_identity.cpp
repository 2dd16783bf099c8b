// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: tell processes apart beyond their numbers (declared in run_store.h). Linux: /proc/PID/stat,
// field 22, and the boot id.
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "forward/run_store.h"

namespace bondlab {

static std::string first_line(const std::string &file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

ProcessIdentity process_identity(std::int64_t pid) {
  ProcessIdentity process;
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  process.host = host;
  process.boot = first_line("/proc/sys/kernel/random/boot_id");
  process.pid = pid;
  const std::string stat = first_line("/proc/" + std::to_string(pid) + "/stat");
  const std::size_t name_end =
      stat.rfind(')');  // the name may contain anything, also blanks and brackets
  if (name_end == std::string::npos) return process;
  std::istringstream fields(stat.substr(name_end + 1));
  std::string state, skipped;
  fields >> state;
  if (state == "Z" || state == "X") return process;  // dead, only not yet collected
  for (int field = 4; field < 22; ++field) fields >> skipped;
  fields >> process.start_ticks;
  return process;
}

ProcessIdentity this_process() { return process_identity(getpid()); }

bool is_alive(const ProcessIdentity &process) {
  if (process.pid <= 0 || process.start_ticks == 0) return false;
  const ProcessIdentity now = process_identity(process.pid);
  return now.boot == process.boot && now.start_ticks == process.start_ticks;
}

}  // namespace bondlab
