/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `fragments_write FILE`: write the fragments of the specimen as it is now to a table. See
   compute_fragments.md. Units: SI. Failure: an error that names the file. */

#ifdef COMMAND_CLASS

// clang-format off
CommandStyle(fragments_write,CommandFragmentsWrite)
// clang-format on

#else

#ifndef BONDLAB_COMMAND_FRAGMENTS_WRITE_H
#define BONDLAB_COMMAND_FRAGMENTS_WRITE_H

#include "pointers.h"

namespace LAMMPS_NS {

class CommandFragmentsWrite : protected Pointers {
 public:
  explicit CommandFragmentsWrite(class LAMMPS *lmp) : Pointers(lmp) {}
  void command(int, char **);
};

}  // namespace LAMMPS_NS

#endif
#endif
