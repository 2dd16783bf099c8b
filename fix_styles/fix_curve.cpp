// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_curve.h.
#include "fix_curve.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "comm.h"
#include "fix_arguments.h"
#include "fix_platen.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixCurve::FixCurve(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), table_(lmp, this, "bondlab-curve 1") {
  restart_global = 1;
  FixArguments a(lmp, this, narg, arg);
  nevery = a.count("the number of steps between two rows");
  table_.path = a.word("the file name");
  table_.names = {"step", "time"};
  table_.units = {"1", "s"};
  while (a.more()) {
    if (a.next_is("append")) {
      table_.append = true;
      continue;
    }
    const std::string name = a.word("the name of a column");
    if (std::count(table_.names.begin(), table_.names.end(), name))
      a.fail("there are two columns '" + name + "' (step and time are always written)");
    table_.names.push_back(name);
    table_.units.push_back(a.word(("the unit of column '" + name + "'").c_str()));
    sources_.emplace_back(
        new FixValueSource(lmp, this, a.word(("the value of column '" + name + "'").c_str())));
  }
  if (sources_.empty()) a.fail("needs at least one column: NAME UNIT VALUE");
}

int FixCurve::setmask() { return END_OF_STEP | POST_RUN; }

void FixCurve::init() {
  for (auto &source : sources_) source->init(nevery);
  // The first row is written while the run is set up, when later fixes have not been.
  for (int i = modify->find_fix(id) + 1; i < modify->nfix; i++)
    if (dynamic_cast<FixPlaten *>(modify->fix[i]))
      stop_with_error(lmp, this,
                      std::string("must come after fix platen (id ") + modify->fix[i]->id + ")");
}

void FixCurve::setup(int) {
  table_.setup();
  if (update->ntimestep % nevery == 0 && update->ntimestep > table_.last_step()) end_of_step();
  modify->addstep_compute_all((update->ntimestep / nevery) * nevery + nevery);
}

void FixCurve::end_of_step() {
  modify->clearstep_compute();
  std::vector<std::string> cells = {bondlab::number_text(table_.time_at(update->ntimestep))};
  for (std::size_t k = 0; k < sources_.size(); k++) {
    const double value = sources_[k]->evaluate();
    if (!std::isfinite(value))
      stop_with_error(lmp, this,
                      "column '" + table_.names[k + 2] + "' (" + sources_[k]->text() + ") is " +
                          bondlab::number_text(value) + " at step " +
                          std::to_string(update->ntimestep));
    cells.push_back(bondlab::number_text(value));
  }
  modify->addstep_compute(update->ntimestep + nevery);
  table_.row(update->ntimestep, cells);
}

void FixCurve::post_run() { table_.finish(); }

void FixCurve::reset_timestep(bigint to, bigint from) { table_.clock.renumber(to, from); }

void FixCurve::write_restart(FILE *fp) {
  if (comm->me != 0) return;
  const int size = sizeof table_.clock;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&table_.clock, sizeof table_.clock, 1, fp);
}

void FixCurve::restart(char *buf) { std::memcpy(&table_.clock, buf, sizeof table_.clock); }
