// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see command_write_data.h.
#include "command_write_data.h"

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "write_data.h"

using namespace LAMMPS_NS;

void CommandWriteData::command(int narg, char **arg) {
  AtomVecBondedSphere *style = dynamic_cast<AtomVecBondedSphere *>(atom->avec);
  if (style) style->list_bonds();
  WriteData(lmp).command(narg, arg);
  if (style) style->forget_listed_bonds();
}
