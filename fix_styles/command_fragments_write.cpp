// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see command_fragments_write.h.
#include "command_fragments_write.h"

#include <stdexcept>

#include "comm.h"
#include "compute_fragments.h"
#include "error.h"
#include "table_file.h"
#include "update.h"

using namespace LAMMPS_NS;

void CommandFragmentsWrite::command(int narg, char **arg) {
  if (narg != 1) error->all(FLERR, "fragments_write: expected `fragments_write FILE`");
  double bonds = 0.0;
  const auto fragments = fragments_of_run(lmp, "fragments_write", bonds);
  if (comm->me != 0) return;
  try {
    bondlab::TableFile table;
    table.create(arg[0], "bondlab-fragments 1",
                 {"number", "particles", "mass", "size", "first_id", "x", "y", "z", "vx", "vy", "vz"},
                 {"1", "1", "kg", "m", "1", "m", "m", "m", "m/s", "m/s", "m/s"});
    bigint number = 0;
    for (const bondlab::Fragment &f : fragments) {
      std::vector<std::string> cells{std::to_string(f.particles), bondlab::number_text(f.mass),
                                     bondlab::number_text(f.size), std::to_string(f.first_tag)};
      for (const double value : {f.x[0], f.x[1], f.x[2], f.v[0], f.v[1], f.v[2]})
        cells.push_back(bondlab::number_text(value));
      table.row(++number, cells);
    }
    table.complete("end_of_run");
  } catch (const std::runtime_error &e) {
    error->one(FLERR, (std::string("fragments_write: ") + e.what()).c_str());
  }
}
