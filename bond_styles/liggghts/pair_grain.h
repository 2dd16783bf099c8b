/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `pair_style grain`: linear elastic contact with Coulomb friction between grains whose
   stiffness follows from a modulus (laws/grain_contact.h), for all pairs that are not in the bond
   table; gives bond styles the constants of the contact that acts in parallel to a bond.

   Contacts are rows of a table like bonds, taken anew from the engine's neighbour list whenever that
   is rebuilt; the shear history of touching pairs is carried over. See pair_grain.md. */

#ifdef PAIR_CLASS

PairStyle(grain,PairGrain)

#else

#ifndef BONDLAB_PAIR_GRAIN_H
#define BONDLAB_PAIR_GRAIN_H

#include <cmath>
#include <functional>
#include <vector>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "laws/grain_contact.h"
#include "pair.h"

namespace LAMMPS_NS {

class PairGrain : public Pair {
 public:
  explicit PairGrain(class LAMMPS *);
  ~PairGrain();

  // Contact of a particle of type i (radius ri, m) with one of type j: N/m, N/m, 1.
  void constants(int itype, int jtype, double ri, double rj, double &kn, double &ks,
                 double &mu) const;
  // The same for a block of pairs (laws/bond_batch.h) of particles that are all of type 1.
  void constants_of_block(const double *ri, const double *rj, const double *per_both, double *kn, double *ks,
                          double *mu) const;
  // Visits this rank's share of the unbonded contacts: (kn, ks, overlap, shear force), each once.
  template <class Visit>
  void for_each_contact(Visit visit) const;
  // Visits every unbonded contact on this rank: visit(row of style->contacts, force on the smaller-tag
  // particle, N).
  void for_each_force(const std::function<void(int, const double *)> &visit);
  int candidates() const { return style_->contacts.size(); }
  void refresh();

  void compute(int, int);
  void settings(int, char **);
  void coeff(int, char **);
  void init_style();
  double init_one(int, int);
  void write_restart(FILE *);
  void read_restart(FILE *, const int, const int);
  void write_restart_settings(FILE *) {}
  void read_restart_settings(FILE *, const int, const int) {}
  double memory_usage();

 private:
  AtomVecBondedSphere *style_;
  double **modulus_, **ratio_, **friction_;  // [ntypes+1][ntypes+1]: Pa, 1, 1
  bigint seen_generation_;
  double largest_radius_;
  std::vector<double> reference_, kn_, ks_, mu_;
  // loads of all blocks in turn; sink(first row, loads)
  template <class Sink>
  void walk(bool advance, const bondlab::ParticleRecords &, Sink sink);
  void allocate();
};

template <class Visit>
void PairGrain::for_each_contact(Visit visit) const {
  const bondlab::PairTable &t = style_->contacts;
  for (int row = 0; row < t.size(); row++) {
    if (t.own_lo[row] >= atom->nlocal) continue;
    const double *a = atom->x[t.at_lo[row]], *b = atom->x[t.at_hi[row]];
    double d2 = 0.0, s2 = 0.0;
    for (int d = 0; d < 3; d++) {
      d2 += (b[d] - a[d]) * (b[d] - a[d]);
      s2 += t.value(d, row) * t.value(d, row);
    }
    const double overlap = reference_[row] - std::sqrt(d2);
    if (overlap > 0.0) visit(kn_[row], ks_[row], overlap, std::sqrt(s2));
  }
}

}  // namespace LAMMPS_NS

#endif
#endif
