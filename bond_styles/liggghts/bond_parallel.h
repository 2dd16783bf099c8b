/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `bond_style parallel`: coefficients, strengths and the call of laws/parallel.h.
   See bond_parallel.md for syntax and formulas. */

#ifdef BOND_CLASS

BondStyle(parallel,BondParallel)

#else

#ifndef BONDLAB_BOND_PARALLEL_H
#define BONDLAB_BOND_PARALLEL_H

#include "bond_bpm.h"
#include "laws/parallel.h"

namespace LAMMPS_NS {

class BondParallel : public BondBPM {
 public:
  explicit BondParallel(class LAMMPS *);
  ~BondParallel();
  void compute(int, int);
  void coeff(int, char **);
  void init_style();
  double row_energy(int row);
  void stiffness(int row, double &translational, double &coupling, double &rotational);
  void write_restart(FILE *);
  void read_restart(FILE *);

 protected:
  void derive(int row);
  void resize_constants(int padded);

 private:
  struct Type {
    bondlab::laws::ParallelParameters law;
    bondlab::laws::StrengthDistribution sigma, tau;
  };
  std::vector<Type> types_;  // [nbondtypes + 1]
  std::vector<double> radius_, stiffness_, ratio_, beta_, tan_phi_;
  void allocate();
  template <bool advance>
  void compute_blocks();
};

}  // namespace LAMMPS_NS

#endif
#endif
