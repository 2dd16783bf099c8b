// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/engine.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "base/sha256.h"
#include "base/user_error.h"
#include "study/input_folders.h"

namespace bondlab {

namespace fs = std::filesystem;

static bool is_program(const fs::path &path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

static fs::path find_mpirun() {
  if (const char *environment = std::getenv("BONDLAB_MPIRUN")) {
    if (!is_program(environment))
      throw UserError(std::string("BONDLAB_MPIRUN names '") + environment +
                      "', which isn't a program");
    return fs::absolute(environment);
  }
#ifdef BONDLAB_MPIRUN
  if (is_program(BONDLAB_MPIRUN)) return BONDLAB_MPIRUN;
#endif
  const char *path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (is_program(fs::path(folder) / "mpirun")) return fs::absolute(fs::path(folder) / "mpirun");
  throw UserError(
      "mpirun isn't in PATH; install Open MPI (openmpi-bin) or set BONDLAB_MPIRUN to it");
}

Engine find_engine() {
  Engine engine;
  if (const char *environment = std::getenv("BONDLAB_LMP")) {
    engine.program = environment;
    if (!is_program(engine.program))
      throw UserError("BONDLAB_LMP names '" + engine.program.string() + "', which isn't a program");
  } else {
    engine.program = program_folder() / "lmp_bondlab";
    if (!is_program(engine.program))
      throw UserError("the engine isn't beside bondlab ('" + engine.program.string() +
                      "'); build it with tools/setup and cmake, or set BONDLAB_LMP to it");
  }
  engine.program = fs::absolute(engine.program);
  engine.mpirun = find_mpirun();
  engine.hash = sha256_file(engine.program);
  engine.alone_without_mpirun = std::getenv("BONDLAB_MPIRUN") == nullptr;
  return engine;
}

int available_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof cores, &cores) == 0) return std::max(1, CPU_COUNT(&cores));
  return std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace bondlab
