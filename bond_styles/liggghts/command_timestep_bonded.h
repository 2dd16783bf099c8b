/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `timestep_bonded SAFETY`: set the time step to a fraction of the stability limit of the
   bonded network. See timestep_bonded.md. */

#ifdef COMMAND_CLASS

CommandStyle(timestep_bonded,CommandTimestepBonded)

#else

#ifndef BONDLAB_COMMAND_TIMESTEP_BONDED_H
#define BONDLAB_COMMAND_TIMESTEP_BONDED_H

#include "pointers.h"

namespace LAMMPS_NS {

class CommandTimestepBonded : protected Pointers {
 public:
  explicit CommandTimestepBonded(class LAMMPS *lmp) : Pointers(lmp) {}
  void command(int, char **);
};

}  // namespace LAMMPS_NS

#endif
#endif
