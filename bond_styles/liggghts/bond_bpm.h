/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: what all bond styles of bonded particles share: the bond table's columns, the constants
   derived for each row, gathering blocks of relative motion, adding up loads, breaking, events.
   A style adds its coefficients and calls its law (bond_styles/laws) block by block.

   Every bond keeps the grain contact of its pair with it (laws/grain_contact.h): the contact of a
   bonded pair is stress-free at the distance of bonding, also after a break until the pair first
   separates; then the reference is R_i + R_j. The row of a broken bond stays until the two are far
   apart; pair_style grain takes the pair from then on.

   Order: rows in order of tags (pair_table.h), so forces do not depend on ranks.
   Failure: error with both tags if a partner is missing. NaN: caught by fix curve and by the
   stability check every rebuild. Limits: no virial, no per-atom energy; newton off for pairs. */

#ifndef BONDLAB_BOND_BPM_H
#define BONDLAB_BOND_BPM_H

#include <string>
#include <vector>

#include "atom_vec_bonded_sphere.h"
#include "bond.h"
#include "laws/grain_contact.h"
#include "laws/strength.h"

namespace LAMMPS_NS {

// One broken bond, as it was when it broke.
struct BreakEvent {
  bigint step;
  int tag_lo, tag_hi, type;
  double x[3];                        // contact point, m
  int mode;                           // 0 tension, 1 shear
  double sigma, tau, sigma_c, tau_c;  // Pa
};

class BondBPM : public Bond {
 public:
  // columns of AtomVecBondedSphere::bonds
  enum Column { REST, REFERENCE, FSX, FSY, FSZ, MBX, MBY, MBZ, MT, CSX, CSY, CSZ };
  // in 2D: shear force FSX, bending moment MBX, contact shear CSX
  enum Info { TYPE_MASK = 0xffff, BROKEN = 1 << 16, SEPARATED = 1 << 17 };

  explicit BondBPM(class LAMMPS *);
  ~BondBPM();

  // Breaks on this rank since somebody took them; each bond on one rank only.
  std::vector<BreakEvent> events;

  // Elastic energy of intact bonds, and of the contacts in parallel to them, of row `row`, J.
  virtual double row_energy(int row) = 0;
  double contact_row_energy(int row) const;
  bool counted_here(int row) const;  // each bond on one rank only
  bool intact(int row) const { return !(table().info[row] & BROKEN); }
  // Sum over this bond of stiffness seen by each of its two particles, for the time step: the
  // largest translational (N/m) and rotational (N m) entries, see command_timestep_bonded.cpp.
  virtual void stiffness(int row, double &translational, double &coupling, double &rotational) = 0;
  void refresh();  // after a rebuild: order, constants
  AtomVecBondedSphere *style() const { return style_; }

  void init_style();
  void settings(int, char **);
  double equilibrium_distance(int);
  double single(int, double, int, int, double &);
  double memory_usage();

 protected:
  AtomVecBondedSphere *style_;
  class PairGrain *grain_;  // grain contact in parallel, NULL if there is none
  bigint seen_generation_;
  // constants of each row, [rows padded to blocks], derived from coefficients and tags
  std::vector<double> kn_c_, ks_c_, mu_c_, alive_, ri_, rj_, sigma_c_, tau_c_;
  // what a law says of one block
  struct alignas(64) Report {
    double sigma[bondlab::laws::kBlock], tau[bondlab::laws::kBlock];  // Pa
    double fate[bondlab::laws::kBlock];                               // BondFate
  };

  bondlab::PairTable &table() const { return style_->bonds; }
  double *column(int c) { return table().state[c].data(); }
  int padded() const { return static_cast<int>(alive_.size()); }

  bool gone(int row) const;  // may be dropped from the table
  virtual void derive(int row) = 0;  // fills the style's own constants of a row
  virtual void resize_constants(int padded) = 0;
  void gather(int first, double dt, bondlab::laws::Kinematics3 &) const;
  void gather(int first, double dt, bondlab::laws::Kinematics2 &) const;
  void scatter(int first, const bondlab::laws::PairLoads3 &) const;
  void scatter(int first, const bondlab::laws::PairLoads2 &) const;
  void finish_step(int first, const Report &);  // breaks and separations of one block
  bondlab::laws::ContactParameters contact_block(int first) const;
  [[noreturn]] void bad(const std::string &text) const;  // a user's mistake in a command
};

}  // namespace LAMMPS_NS

#endif
