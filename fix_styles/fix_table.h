/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: a table of results (table_file.h) written by rank 0 of a run, for fixes: opened, gone on
   with after a restart, completed when the run ends as it should.

   Life: setup() at the start of every run, row() by any rank (rank 0 writes), finish() in post_run.
   Failure: an error that names the fix, the file and the system's reason. Units: the columns'. */

#ifndef BONDLAB_FIX_TABLE_H
#define BONDLAB_FIX_TABLE_H

#include <string>
#include <vector>

#include "pointers.h"
#include "step_clock.h"
#include "table_file.h"

namespace LAMMPS_NS {

class Fix;

class FixTable : protected Pointers {
 public:
  FixTable(LAMMPS *lmp, Fix *fix, const std::string &kind);

  std::string path;
  bool append;  // go on with the file of the run that wrote the restart
  std::vector<std::string> names, units;
  bondlab::StepClock clock;  // the time written; a fix that uses it restarts it

  void setup();  // all ranks
  bool is_open() const { return open_; }
  bigint last_step() const { return last_step_; }  // of the rows, on all ranks; -1: none
  double time_at(bigint step) const { return clock.at(step); }  // of the present run, s
  void row(bigint step, const std::vector<std::string> &cells);
  void finish();  // all ranks

 private:
  Fix *fix_;
  std::string kind_;
  bool open_;
  bigint last_step_;
  bondlab::TableFile file_;
  template <class Action>
  void on_rank_0(Action action);
};

}  // namespace LAMMPS_NS

#endif
