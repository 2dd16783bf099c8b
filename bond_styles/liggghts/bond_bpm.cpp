// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_bpm.h.
#include "bond_bpm.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "neighbor.h"
#include "pair_gather.h"
#include "pair_grain.h"
#include "update.h"

using namespace LAMMPS_NS;
using bondlab::PairTable;
using namespace bondlab::laws;

BondBPM::BondBPM(LAMMPS *lmp)
    : Bond(lmp), style_(AtomVecBondedSphere::of(lmp, "bond_style")), grain_(NULL),
      seen_generation_(-1) {
  style_->bond_gone = [this](int row) { return gone(row); };
}

BondBPM::~BondBPM() {
  // the atom style may be gone already when the engine shuts down
  if (dynamic_cast<AtomVecBondedSphere *>(atom->avec) == style_) style_->bond_gone = nullptr;
}

void BondBPM::bad(const std::string &text) const { error->all(FLERR, text.c_str()); abort(); }

void BondBPM::settings(int narg, char **arg) {
  if (narg) bad(std::string("bond_style takes no further words, '") + arg[0] + "' was given");
}

void BondBPM::init_style() {
  if (force->newton_pair)
    bad("bonded particles need `newton off` (or `newton off on`): with `newton on` forces of ghosts would be added up in an order that depends on the ranks");
  comm->ghost_velocity = 1;
  grain_ = dynamic_cast<PairGrain *>(force->pair);
  if (!grain_ && force->pair) grain_ = dynamic_cast<PairGrain *>(force->pair_match("grain", 1));
  // ghosts must reach as far as the longest bond: half as much again as it is now, and the skin
  double longest = 0.0, all = 0.0;
  const PairTable &t = table();
  for (int row = 0; row < t.size(); row++) longest = std::max(longest, t.state[REST][row]);
  MPI_Allreduce(&longest, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  if (all > 0.0) comm->cutghostuser = std::max(comm->cutghostuser, 1.5 * all + neighbor->skin);
  seen_generation_ = -1;  // coefficients may have changed
}

// A broken pair that has once been apart is an ordinary contact. Its row stays all the same while the
// two could come into contact again, with the history of that contact and its place in the order of
// summation: both would change at a rebuild of the neighbour list, whenever that happens to be. It
// goes when they are further apart than ghosts reach, the same distance on any number of ranks.
bool BondBPM::gone(int row) const {
  const PairTable &t = style_->bonds;
  const int both = BROKEN | SEPARATED;
  if ((t.info[row] & both) != both) return false;
  int i = style_->index_of(t.lo[row]), j = style_->index_of(t.hi[row]);
  if (i < 0 || j < 0) return true;
  if (i >= atom->nlocal) std::swap(i, j);
  if (i >= atom->nlocal) return true;  // belongs to other ranks now
  j = domain->closest_image(i, j);
  double d2 = 0.0;
  for (int d = 0; d < 3; d++) d2 += (atom->x[j][d] - atom->x[i][d]) * (atom->x[j][d] - atom->x[i][d]);
  const double reach = *std::min_element(comm->cutghost, comm->cutghost + domain->dimension);
  return d2 > reach * reach * (1.0 - 1e-9);
}

bool BondBPM::counted_here(int row) const { return table().own_lo[row] < atom->nlocal; }

void BondBPM::refresh() {
  style_->index_tables();
  if (seen_generation_ == style_->generation) return;
  seen_generation_ = style_->generation;
  const PairTable &t = table();
  const int n = t.size(), padded = static_cast<int>(t.at_lo.size());
  for (auto *v : {&kn_c_, &ks_c_, &mu_c_, &alive_, &ri_, &rj_, &sigma_c_, &tau_c_})
    v->assign(padded, 0.0);
  resize_constants(padded);
  const double *radius = atom->radius;
  const int *type = atom->type;
  for (int k = 0; k < padded; k++) {
    const int row = std::min(k, n - 1);  // unused lanes repeat the last bond
    ri_[k] = radius[t.at_lo[row]];
    rj_[k] = radius[t.at_hi[row]];
    alive_[k] = t.info[row] & BROKEN ? 0.0 : 1.0;
    if (grain_)
      grain_->constants(type[t.at_lo[row]], type[t.at_hi[row]], ri_[k], rj_[k], kn_c_[k],
                        ks_c_[k], mu_c_[k]);
  }
  for (int k = 0; k < n; k++) derive(k);
  for (int k = n; k < padded; k++) derive(k);
}

ContactParameters BondBPM::contact_block(int first) const {
  return {table().state[REFERENCE].data() + first, kn_c_.data() + first, ks_c_.data() + first,
          mu_c_.data() + first};
}

void BondBPM::gather(int first, double dt, Kinematics3 &k) const {
  bondlab::gather(table(), first, dt, atom->x, atom->v, atom->omega, ri_.data() + first,
                  rj_.data() + first, k);
}

void BondBPM::gather(int first, double dt, Kinematics2 &k) const {
  bondlab::gather(table(), first, dt, atom->x, atom->v, atom->omega, ri_.data() + first,
                  rj_.data() + first, k);
}

void BondBPM::scatter(int first, const PairLoads3 &loads) const {
  bondlab::scatter(table(), first, atom->nlocal, loads, atom->f, atom->torque);
}

void BondBPM::scatter(int first, const PairLoads2 &loads) const {
  bondlab::scatter(table(), first, atom->nlocal, loads, atom->f, atom->torque);
}

void BondBPM::finish_step(int first, const Report &report) {
  int dead = 0;
  for (int k = 0; k < kBlock; k++) dead += alive_[first + k] == 0.0;
  if (!dead) return;
  PairTable &t = table();
  const int n = std::min(kBlock, t.size() - first);
  for (int k = 0; k < n; k++) {
    const int row = first + k;
    if (alive_[row] != 0.0) continue;
    if (report.fate[k] != 0.0) {
      t.info[row] |= BROKEN;
      if (counted_here(row)) {
        BreakEvent event;
        event.step = update->ntimestep;
        event.tag_lo = t.lo[row];
        event.tag_hi = t.hi[row];
        event.type = t.info[row] & TYPE_MASK;
        const double share = ri_[row] / (ri_[row] + rj_[row]);
        const double *a = atom->x[t.at_lo[row]], *b = atom->x[t.at_hi[row]];
        for (int d = 0; d < 3; d++) event.x[d] = a[d] + share * (b[d] - a[d]);
        event.mode = report.fate[k] == static_cast<double>(BondFate::broken_in_shear);
        event.sigma = report.sigma[k];
        event.tau = report.tau[k];
        event.sigma_c = sigma_c_[row];
        event.tau_c = tau_c_[row];
        events.push_back(event);
      }
    }
    if (!(t.info[row] & SEPARATED)) {
      const double *a = atom->x[t.at_lo[row]], *b = atom->x[t.at_hi[row]];
      const double d = std::sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                                 (b[2] - a[2]) * (b[2] - a[2]));
      const double touching = ri_[row] + rj_[row];
      // beyond both references neither contact is loaded, so the change makes no jump
      if (d >= std::max(t.state[REFERENCE][row], touching)) {
        t.info[row] |= SEPARATED;
        t.state[REFERENCE][row] = touching;
      }
    }
  }
}

double BondBPM::contact_row_energy(int row) const {
  const PairTable &t = table();
  const double *a = atom->x[t.at_lo[row]], *b = atom->x[t.at_hi[row]];
  double d2 = 0.0;
  for (int d = 0; d < 3; d++) d2 += (b[d] - a[d]) * (b[d] - a[d]);
  const double overlap = t.state[REFERENCE][row] - std::sqrt(d2);
  double shear2 = 0.0;
  for (int c = CSX; c <= (domain->dimension == 2 ? CSX : CSZ); c++)
    shear2 += t.state[c][row] * t.state[c][row];
  return contact_energy(overlap > 0.0 ? kn_c_[row] * overlap : 0.0, std::sqrt(shear2), kn_c_[row],
                        ks_c_[row]);
}

double BondBPM::equilibrium_distance(int) { return 0.0; }

double BondBPM::single(int, double, int, int, double &fforce) {
  fforce = 0.0;
  return 0.0;
}

double BondBPM::memory_usage() {
  return 8.0 * sizeof(double) * padded();
}
