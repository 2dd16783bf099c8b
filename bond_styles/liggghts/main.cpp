// SPDX-License-Identifier: GPL-2.0-or-later
//
// lmp_bondlab: LIGGGHTS with our atom, bond, pair, fix, compute and command styles.
//
// Method: the engine is linked as a library; our styles are entered into its maps before the deck
//   is read (bond and atom styles by the rebuilt force.cpp and atom.cpp, see
//   tools/cmake/generate_styles.cmake).
// Signals: as in the stock program. SIGINT and SIGTERM end the run at the next step, a second one
//   at once; SIGUSR1 asks for a restart file.
// Failure: exit status 0 only if the deck ran to its end without a signal. Errors of the deck end
//   the process inside the engine with status 1; an exception from a style of ours is printed and
//   aborts all ranks. Standard output and the log are line-buffered, since the engine's
//   Error::one and a kill would otherwise lose the very message that explains them.

#include <mpi.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "input.h"
#include "lammps.h"
#include "signal_handling.h"

namespace LAMMPS_NS {
void register_styles(LAMMPS *lmp);  // generated
}

namespace {

void install_handler(int signal_number, void (*handler)(int)) {
  struct sigaction action;
  std::memset(&action, 0, sizeof action);
  action.sa_handler = handler;
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

int main(int argc, char **argv) {
  using namespace LAMMPS_NS;

  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  install_handler(SIGINT, SignalHandler::int_handler);
  install_handler(SIGTERM, SignalHandler::int_handler);
  install_handler(SIGUSR1, SignalHandler::usr1_handler);

  MPI_Init(&argc, &argv);
  int status = 0;
  try {
    LAMMPS *lmp = new LAMMPS(argc, argv, MPI_COMM_WORLD);
    if (lmp->logfile) std::setvbuf(lmp->logfile, nullptr, _IOLBF, 0);
    register_styles(lmp);
    lmp->input->file();
    if (SignalHandler::request_quit) status = 1;
    delete lmp;
  } catch (const std::exception &error) {
    std::printf("ERROR: %s\n", error.what());
    std::fflush(nullptr);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return status;
}
