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
  Values values(int row);
  Stiffness stiffness(int row) const;

 protected:
  void block_3d(Block &, const bondlab::laws::Kinematics3 &, const bondlab::laws::Orientations3 &,
                bool advance, bondlab::laws::PairLoads3 &);
  void block_2d(Block &, const bondlab::laws::Kinematics2 &, const bondlab::laws::Orientations2 &,
                bool advance, bondlab::laws::PairLoads2 &);
  void constants(const Pair &, double *) const;
  bool varies(int type, int constant) const;
  Opening opening(const Pair &, const double *constants) const;
  void strengths(int row, double &sigma_c, double &tau_c) const;
  void read_coefficients(BondCoefficients &, int lo, int hi);
  std::vector<double> coefficients(int type) const;
  void set_coefficients(int type, const std::vector<double> &);

 private:
  enum State { FSX, FSY, FSZ, MBX, MBY, MBZ, MT, STATES };  // in 2D FSX and MBX alone
  enum Constant { RADIUS_FACTOR, MODULUS, RATIO, BETA, TAN_PHI, SIGMA_C, TAU_C, CONSTANTS };
  struct Type {
    bondlab::laws::ParallelParameters law;
    bondlab::laws::StrengthDistribution sigma, tau;
  };
  std::vector<Type> kinds_;  // [nbondtypes + 1]
  bondlab::laws::BondSection section(int row, double &kn, double &ks) const;
  template <bool advance, bool options, bool contact>
  void block(Block &, const bondlab::laws::Kinematics3 &, bondlab::laws::PairLoads3 &);
  template <bool advance, bool options, bool contact>
  void block(Block &, const bondlab::laws::Kinematics2 &, bondlab::laws::PairLoads2 &);
};

}  // namespace LAMMPS_NS

#endif
#endif
