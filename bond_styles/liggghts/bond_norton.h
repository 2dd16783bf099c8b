/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `bond_style norton`: coefficients, temperature, strengths and the call of laws/norton.h.
   See bond_norton.md for syntax and formulas.

   What creeps, how often and whose temperature counts is one choice for all types of a run, since a
   block of bonds goes through one compiled loop; the numbers may differ from type to type.
   Temperature: of the deck (a number or a variable, taken once a step) or the mean of the two
   particles' `Temp`. Units: SI, K. Failure: errors that name the word. */

#ifdef BOND_CLASS

BondStyle(norton,BondNorton)

#else

#ifndef BONDLAB_BOND_NORTON_H
#define BONDLAB_BOND_NORTON_H

#include "bond_bpm.h"
#include "laws/norton_type.h"

namespace LAMMPS_NS {

class BondNorton : public BondBPM {
 public:
  explicit BondNorton(class LAMMPS *);
  void init_style();
  void compute(int, int);
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
  // in 2D FSX and MBX alone
  enum State { STRAIN, THEN, DISSIPATED, FSX, FSY, FSZ, MBX, MBY, MBZ, MT, STATES };
  enum Constant {
    MODULUS, SHEAR, LAMBDA, HALF_DIAMETER, LENGTH, LEAST, BETA, SIGMA_C, TAU_C, CRUSH, YIELD_T,
    YIELD_C, YIELD_S, EXPONENT, LOG_CREEP, LOG_SHEAR, BEND_SHAPE, T_REF, ACTIVATION, MODULUS_SLOPE,
    STRENGTH_SLOPE, CONSTANTS
  };
  // Where the temperature comes from.
  enum Source { REFERENCE_T, NUMBER, VARIABLE, PARTICLES };
  struct Type {
    bondlab::laws::NortonType law;
    bondlab::laws::StrengthDistribution sigma, tau;
    double every = 1.0;
    Source source = REFERENCE_T;
    double kelvin = 0.0;    // NUMBER
    std::string variable;   // VARIABLE
  };
  // Constants of a block after the temperature.
  struct alignas(64) Columns {
    double kelvin[bondlab::laws::kBlock], length[bondlab::laws::kBlock], radius[bondlab::laws::kBlock];
    double modulus[bondlab::laws::kBlock], creep[bondlab::laws::kBlock];
    double strength[6][bondlab::laws::kBlock];
  };

  std::vector<Type> kinds_;  // [nbondtypes + 1]
  const Type *common_;       // any type in use: what all types share is read from it
  bool other_length_;        // has a type another length than the distance of the centres?
  double kelvin_;            // of the deck, this step
  class FixPropertyAtom *particle_kelvin_;

  double kelvin_of(int row) const;
  bondlab::laws::NortonConstants constants_of(Block &, Columns &) const;
  bondlab::laws::NortonStep step_of(const Block &, bool advance) const;
  struct Shape {
    double length;  // m
    bondlab::laws::BondSection section;
  };
  Shape shape(int row) const;
  template <bool advance, bool options, bool contact>
  void block(Block &, const bondlab::laws::Kinematics3 &, bondlab::laws::PairLoads3 &);
  template <bool advance, bool options, bool contact>
  void block(Block &, const bondlab::laws::Kinematics2 &, bondlab::laws::PairLoads2 &);
};

}  // namespace LAMMPS_NS

#endif
#endif
