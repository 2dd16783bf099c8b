// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: find the engine lmp_bondlab and mpirun, and say which engine it is.
// Method: lmp_bondlab stands beside our own program, or where BONDLAB_LMP points; mpirun where
// BONDLAB_MPIRUN points, where
//   the build found it, or in PATH. The engine's identity is the hash of its file: another build is
//   another engine, and its results are never mixed.
// Units: none. Failure: UserError that says where was looked.
#pragma once

#include <filesystem>
#include <string>

namespace bondlab {

struct Engine {
  std::filesystem::path program;  // lmp_bondlab
  std::filesystem::path mpirun;
  std::string hash;  // SHA-256 of the program
  // A run on one rank is started without mpirun, whose own start costs more than a small run;
  // not when the user named a launcher by BONDLAB_MPIRUN.
  bool alone_without_mpirun = false;
};

Engine find_engine();

// Processors this process may use.
int available_cores();

}  // namespace bondlab
