/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `bond_install`: bond particles once, by the gap between their surfaces or from a list of
   pairs; set the reference positions. See bond_install.md. */

#ifdef COMMAND_CLASS

CommandStyle(bond_install,CommandBondInstall)

#else

#ifndef BONDLAB_COMMAND_BOND_INSTALL_H
#define BONDLAB_COMMAND_BOND_INSTALL_H

#include <cstdint>
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
  int group_bit_;
  // Pairs that stay without a bond.
  struct Missing {
    double fraction = 0.0;                 // of the pairs whose direction is within the cone
    double normal[3] = {0.0, 0.0, 0.0};    // axis of the cone
    double least_cosine = -1.0;            // of its half angle; -1: all directions
    double open = 0.0;                     // m the crack is open
    std::uint64_t seed = 1;
    bigint count = 0;                      // on this rank
  } missing_;
  int keyword(int narg, char **arg, int k, int &type);
  bool is_missing(const double *xi, const double *xj, int tag_i, int tag_j, double distance) const;
  [[noreturn]] void bad(const std::string &text) const;
  void ghosts(double reach);
  int by_gap(double gap, int type);
  std::vector<int> read_pairs(const char *file);
  std::vector<int> pairs_of_data_file(std::vector<int> &types);
  int from_pairs(const std::vector<int> &pairs, const std::vector<int> &types, const std::string &source);
  class BondBPM *style_of(int type) const;
  void install(int a, int b, int type);
};

}  // namespace LAMMPS_NS

#endif
#endif
