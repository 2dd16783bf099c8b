/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `bond_style beam/mohr/coulomb`: coefficients, strengths and the call of
   laws/beam_mohr_coulomb.h. See bond_beam_mohr_coulomb.md for syntax and formulas. */

#ifdef BOND_CLASS

BondStyle(beam/mohr/coulomb,BondBeamMohrCoulomb)

#else

#ifndef BONDLAB_BOND_BEAM_MOHR_COULOMB_H
#define BONDLAB_BOND_BEAM_MOHR_COULOMB_H

#include "bond_bpm.h"
#include "laws/beam_mohr_coulomb.h"

namespace LAMMPS_NS {

class BondBeamMohrCoulomb : public BondBPM {
 public:
  explicit BondBeamMohrCoulomb(class LAMMPS *);
  void create(const double *xi, const double *xj, const double *qi, const double *qj,
              double *law_columns) const;
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
  // the frame of the bond seen from either particle; in 2D its direction alone, the first four
  enum State { FRAME, STATES = 8 };
  // TOUCHING: 1 if the rest length is R_i + R_j; POINT: 1 if shear acts at the grains' contact
  enum Constant { LAMBDA, MODULUS, SHEAR, TWIST, BEND_FACTOR, BETA1, BETA2, TAN_PHI, COHESION,
                  CUTOFF, FRICTION, TOUCHING, POINT, CONSTANTS };
  struct Type {
    bondlab::laws::BeamParameters law;
    bondlab::laws::StrengthDistribution cohesion, cutoff;
  };
  std::vector<Type> kinds_;  // [nbondtypes + 1]
  double rest(const Pair &) const;     // l_0, m
  double radius(const Pair &) const;   // R_b, m
  bondlab::laws::BeamStiffness whole(int row) const;  // intact, in compression
  bondlab::laws::BeamLoads loads(int row) const;      // effective, of an intact bond
  bool replaced(int row) const;
  // Sizes of a block's bonds from the radii of their particles, and the reference of the contacts.
  const double *sizes(Block &, const double *&rest, const double *&radius) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
