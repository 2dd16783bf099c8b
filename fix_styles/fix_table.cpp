// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_table.h.
#include "fix_table.h"

#include <exception>

#include "comm.h"
#include "error.h"
#include "fix.h"
#include "fix_arguments.h"
#include "fix_stop_peak.h"
#include "update.h"

namespace LAMMPS_NS {

FixTable::FixTable(LAMMPS *lmp, Fix *fix, const std::string &kind)
    : Pointers(lmp), append(false), fix_(fix), kind_(kind), open_(false), last_step_(-1) {}

// Writing happens on rank 0 alone, at steps where the others don't wait: a failure ends them too.
template <class Action>
void FixTable::on_rank_0(Action action) {
  if (comm->me != 0) return;
  try {
    action();
  } catch (const std::exception &e) {
    const std::string text =
        std::string("Fix ") + fix_->style + " (id " + fix_->id + "): " + e.what();
    error->one(FLERR, text.c_str());
  }
}

void FixTable::setup() {
  if (!clock.started()) clock.start(update->get_cur_time(), update->ntimestep, update->dt);
  // the run about to begin may have another time step
  clock.advance(update->ntimestep, update->dt);
  if (open_) {
    on_rank_0([this] { file_.resume(); });
    return;
  }
  int failed = 0;
  std::string why;
  if (comm->me == 0) try {
      if (append && update->ntimestep > 0)
        file_.go_on(path, kind_, names, units, update->ntimestep);
      else
        file_.create(path, kind_, names, units);
      last_step_ = file_.last_step();
    } catch (const std::exception &e) {
      failed = 1;
      why = e.what();
    }
  MPI_Bcast(&failed, 1, MPI_INT, 0, world);
  if (failed) stop_with_error(lmp, fix_, why);  // rank 0 prints
  MPI_Bcast(&last_step_, 1, MPI_LMP_BIGINT, 0, world);
  open_ = true;
}

void FixTable::row(bigint step, const std::vector<std::string> &cells) {
  last_step_ = step;
  on_rank_0([&] { file_.row(step, cells); });
}

void FixTable::finish() {
  clock.advance(update->ntimestep, update->dt);
  const std::string reason = FixStopPeak::reason_of_end(lmp);
  if (open_ && !reason.empty()) on_rank_0([&] { file_.complete(reason); });
}

}  // namespace LAMMPS_NS
