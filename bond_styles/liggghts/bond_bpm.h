/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: what all bond styles of bonded particles share: walking through the bond table block by block,
   reading the relative motion, adding up loads, the constants of each bond, the options common to
   all laws, breaking and its log, `bond_style hybrid`, restart. A style adds its coefficients and the
   call of its law (bond_styles/laws) for a block of bonds.

   Every bond keeps the grain contact of its pair with it (laws/grain_contact.h): the contact of a
   bonded pair is stress-free at the distance of bonding, also after a break until the pair first
   separates; then the reference is R_i + R_j. The row of a broken bond stays until the two are far
   apart; pair_style grain takes the pair from then on.

   Memory: a step streams through the state (PairTable) and, beside it, only what differs from bond to
   bond; what a bond type fixes lies in one block of lanes a type, in the first cache.
   Order: rows in order of tags (pair_table.h), so forces do not depend on ranks; in `hybrid` sub-style
   after sub-style.
   Failure: error with both tags if a partner is missing. NaN: caught by fix curve and by the
   stability check every rebuild. Limits: no virial; newton off for pairs. */

#ifndef BONDLAB_BOND_BPM_H
#define BONDLAB_BOND_BPM_H

#include <functional>
#include <string>
#include <vector>

#include "atom_vec_bonded_sphere.h"
#include "bond.h"
#include "bond_coefficients.h"
#include "laws/bond_batch.h"
#include "laws/bond_options.h"
#include "laws/grain_contact.h"
#include "laws/strength.h"

namespace LAMMPS_NS {

class BondBPM : public Bond {
 public:
  // Columns of AtomVecBondedSphere::bonds: these, then the law's own, then two of the options.
  // In 2D the contact's shear force is CSX.
  enum Column { REST, REFERENCE, CSX, CSY, CSZ, LAW };
  enum Info { TYPE_MASK = 0xffff, BROKEN = 1 << 16, SEPARATED = 1 << 17, MISSING = 1 << 18 };

  // law_columns: doubles of state a bond of the law; constants: see constants();
  // orientations: the law needs those of the two particles.
  BondBPM(class LAMMPS *, const char *name, int law_columns, int constants, bool orientations);
  ~BondBPM();

  // The bond styles of this run (several in `hybrid`), none if there is no style of ours.
  static std::vector<BondBPM *> all(class LAMMPS *);

  bool mine(int type) const { return type < static_cast<int>(types_.size()) && setflag[type]; }
  bool computes(int row) const { return mine(style_->bonds.info[row] & TYPE_MASK); }
  bool counted_here(int row) const;  // each bond on one rank only
  bool intact(int row) const { return !(table().info[row] & BROKEN); }
  void refresh();  // after a rebuild: order, constants
  AtomVecBondedSphere *style() const { return style_; }

  // Fills the law's own columns of a new bond: where its particles are and how they are turned.
  virtual void create(const double *xi, const double *xj, const double *qi, const double *qj,
                      double *law_columns) const;

  // What row `row` carries now, for output: forces N, moments N m, stresses Pa.
  struct Values {
    double fn, fs, mb, mt;      // tension positive; magnitudes
    double sigma, tau;          // rim stresses of the law's criterion
    double damage;              // 1 - carried share, 1: broken
    double energy;              // elastic, J
    double lost;                // dissipated by damping and softening so far, J
    double creep;               // dissipated by creep and yield so far, J
  };
  virtual Values values(int row) = 0;
  double contact_row_energy(int row) const;
  // Visits every bond of this style on this rank: the force on its smaller-tag particle (bond and its
  // grain contact, N, without dashpots) as it stands. visit(row, force)
  using VisitForce = std::function<void(int, const double *)>;
  void for_each_force(const VisitForce &visit);
  // Stiffness of the row for the time step: normal and shear force (N/m), bend and twist (N m).
  struct Stiffness {
    double normal, shear, bend, twist;
  };
  virtual Stiffness stiffness(int row) const = 0;
  // the same with the grain contact and the options; damping_time: s, of the bond's dashpots
  Stiffness whole_stiffness(int row, double &damping_time) const;

  void compute(int, int);
  void coeff(int, char **);
  void init_style();
  void settings(int, char **);
  double equilibrium_distance(int);
  double single(int, double, int, int, double &);
  void write_restart(FILE *);
  void read_restart(FILE *);
  double memory_usage();

 protected:
  static constexpr int kMostColumns = 32, kMostConstants = 32;

  // What a law says of one block.
  struct alignas(64) Report {
    double sigma[bondlab::laws::kBlock], tau[bondlab::laws::kBlock];  // Pa
    double fate[bondlab::laws::kBlock];                               // BondFate
  };
  // One block of rows as a law sees it; every pointer leads to [kBlock].
  struct alignas(64) Block {
    double scratch[kMostConstants + 8][bondlab::laws::kBlock];
    double kept[kMostColumns][bondlab::laws::kBlock];
    Report report;
    double *state[kMostColumns];             // by column; the law's own from LAW on
    const double *constant[kMostConstants];  // by the style's own numbers
    double *alive;
    const double *ri, *rj;                   // radii, m
    bondlab::laws::ContactParameters contact;
    bondlab::laws::OptionArrays options;
    bool with_contact, with_options;
    double dt;  // s, 0 in the set-up of a run
    int first;

    double *law(int k) { return state[LAW + k]; }
  };
  virtual void block_3d(Block &, const bondlab::laws::Kinematics3 &,
                        const bondlab::laws::Orientations3 &, bool advance,
                        bondlab::laws::PairLoads3 &) = 0;
  virtual void block_2d(Block &, const bondlab::laws::Kinematics2 &,
                        const bondlab::laws::Orientations2 &, bool advance,
                        bondlab::laws::PairLoads2 &) = 0;

  // A bond and its two particles, for its constants.
  struct Pair {
    int type, tag_lo, tag_hi;
    double ri, rj, mi, mj, rest;  // m, kg, m
  };
  // Fills the style's constants of a bond, those only that differ from bond to bond included.
  virtual void constants(const Pair &, double *) const = 0;
  // Which of them differ from bond to bond of a type (radii, scattered strengths)?
  virtual bool varies(int type, int constant) const = 0;
  // For softening and damping: the stiffness per area that opens the bond (Pa/m), its area, and the
  // tensile strength.
  struct Opening {
    double stiffness, area, strength;
  };
  virtual Opening opening(const Pair &, const double *constants) const = 0;
  // Strengths for the log, Pa.
  virtual void strengths(int row, double &sigma_c, double &tau_c) const = 0;

  // The style's own words after `bond_coeff N`; options common to all laws are taken off before.
  virtual void read_coefficients(BondCoefficients &, int lo, int hi) = 0;
  // Numbers of a type that a restart file keeps.
  virtual std::vector<double> coefficients(int type) const = 0;
  virtual void set_coefficients(int type, const std::vector<double> &) = 0;

  const char *name_;
  AtomVecBondedSphere *style_;
  class PairGrain *grain_;  // grain contact in parallel, NULL if there is none
  std::vector<BondOptions> types_;  // [nbondtypes + 1]

  bondlab::PairTable &table() const { return style_->bonds; }
  double state(int column, int row) const { return table().value(column, row); }
  double constant(int k, int row) const;
  double option(int which, int row) const;  // state of the options: 0 largest load factor, 1 lost
  double carried(int row) const;            // share of the effective load, 1 without softening
  double distance(int row) const;           // m
  Pair pair(int row) const;
  bool flat() const;
  [[noreturn]] void bad(const std::string &text) const;  // a user's mistake in a command

 private:
  const int law_columns_, constants_;
  const bool orientations_;
  bool any_options_, any_contact_off_;
  int fallback_type_;               // some type of this style, for lanes of other styles
  int varying_;                     // columns of own_ that hold constants
  std::vector<int> place_;          // [constants_] column in own_, or -1: the same for the whole type
  bigint seen_generation_;
  // What differs from bond to bond, as blocks [blocks][own_columns_][kBlock]: alive, varying constants,
  // contact if there are several particle types, s_f and tau_v if there are options.
  enum Own { ALIVE, VARYING };
  int own_columns_;
  bondlab::HugeVector own_;
  std::vector<double> of_type_;     // [types][constants_ + 1][kBlock], E_t/E_c last
  std::vector<int> block_type_;     // type of all bonds of a block, or one of the following
  enum { MIXED = -1, FOREIGN = -2, NONE = -3 };

  double *own(int column, int row) {
    using bondlab::laws::kBlock;
    return own_.data() + (std::size_t(row / kBlock) * own_columns_ + column) * kBlock + row % kBlock;
  }
  double own_value(int column, int row) const { return *const_cast<BondBPM *>(this)->own(column, row); }
  double *of_type(int type, int k) {
    return of_type_.data() + (std::size_t(type) * (constants_ + 1) + k) * bondlab::laws::kBlock;
  }
  void allocate();
  void derive_types();
  void derive_rows();
  void view(int first, const double *ri, const double *rj, const double *per_both, Block &);
  void restore_foreign(Block &);
  // sink(block, loads, kind): what is to be done with a block's loads
  template <class Kinematics, class Orientations, class Loads, class Sink>
  void walk(bool advance, const bondlab::ParticleRecords &, Sink sink);
  template <class Kinematics, class Orientations, class Loads>
  void step(bool advance);
  void run_block(Block &b, const bondlab::laws::Kinematics3 &k, const bondlab::laws::Orientations3 &q,
                 bool advance, bondlab::laws::PairLoads3 &l) { block_3d(b, k, q, advance, l); }
  void run_block(Block &b, const bondlab::laws::Kinematics2 &k, const bondlab::laws::Orientations2 &q,
                 bool advance, bondlab::laws::PairLoads2 &l) { block_2d(b, k, q, advance, l); }
  void finish_step(Block &);  // breaks and separations of one block
  void note_break(Block &, int lane);
};

}  // namespace LAMMPS_NS

#endif
