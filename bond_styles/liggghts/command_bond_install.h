/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `bond_install`: bond particles once, by the gap between their surfaces or from a list of
   pairs; set the reference positions. See bond_install.md. */

#ifdef COMMAND_CLASS

CommandStyle(bond_install,CommandBondInstall)

#else

#ifndef BONDLAB_COMMAND_BOND_INSTALL_H
#define BONDLAB_COMMAND_BOND_INSTALL_H

#include <string>
#include <utility>
#include <vector>

#include "pointers.h"

namespace LAMMPS_NS {

class CommandBondInstall : protected Pointers {
 public:
  explicit CommandBondInstall(class LAMMPS *lmp) : Pointers(lmp) {}
  void command(int, char **);

 private:
  class AtomVecBondedSphere *style_;
  class BondBPM *bond_style_;  // of the type being installed
  int group_bit_;
  [[noreturn]] void bad(const std::string &text) const;
  void ghosts(double reach);
  int by_gap(double gap, int type);
  int from_file(const char *file, int type);
  void install(int a, int b, int type);
};

}  // namespace LAMMPS_NS

#endif
#endif
