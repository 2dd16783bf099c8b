/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `write_data` with the bonds of bonded particles in the file's `Bonds` section: the engine's own
   command, with its lists of bonds filled before and emptied after. `bond_install GROUP data` installs
   them again. Only identities are written: reference state and damage are in restart files. */

#ifdef COMMAND_CLASS

CommandStyle(write_data,CommandWriteData)

#else

#ifndef BONDLAB_COMMAND_WRITE_DATA_H
#define BONDLAB_COMMAND_WRITE_DATA_H

#include "pointers.h"

namespace LAMMPS_NS {

class CommandWriteData : protected Pointers {
 public:
  explicit CommandWriteData(class LAMMPS *lmp) : Pointers(lmp) {}
  void command(int, char **);
};

}  // namespace LAMMPS_NS

#endif
#endif
