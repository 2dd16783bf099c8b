// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_bpm.h. What a step does; coefficients, constants and restart are in bond_bpm_setup.cpp.
#include "bond_bpm.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "atom.h"
#include "bond_hybrid.h"
#include "domain.h"
#include "force.h"
#include "pair_gather.h"
#include "pair_grain.h"
#include "update.h"

using namespace LAMMPS_NS;
using bondlab::PairTable;
using namespace bondlab::laws;

std::vector<BondBPM *> BondBPM::all(LAMMPS *lmp) {
  std::vector<BondBPM *> found;
  Bond *bond = lmp->force->bond;
  if (BondBPM *one = dynamic_cast<BondBPM *>(bond)) found.push_back(one);
  if (BondHybrid *several = dynamic_cast<BondHybrid *>(bond))
    for (int m = 0; m < several->nstyles; m++)
      if (BondBPM *one = dynamic_cast<BondBPM *>(several->styles[m])) found.push_back(one);
  return found;
}

bool BondBPM::flat() const { return domain->dimension == 2; }

bool BondBPM::counted_here(int row) const { return table().own_lo[row] < atom->nlocal; }

void BondBPM::compute(int eflag, int vflag) {
  if (eflag || vflag)
    ev_setup(eflag, vflag);
  else
    evflag = 0;
  refresh();
  const bool advance = !update->setupflag;
  if (flat())
    step<Kinematics2, Orientations2, PairLoads2>(advance);
  else
    step<Kinematics3, Orientations3, PairLoads3>(advance);
}

template <class Kinematics, class Orientations, class Loads>
void BondBPM::step(bool advance) {
  PairTable &t = table();
  const bondlab::ParticleRecords &records = grain_ ? style_->records() : style_->fill_records();
  walk<Kinematics, Orientations, Loads>(advance, records, [&](Block &block, const Loads &loads, int kind) {
    if (kind == FOREIGN) {
      restore_foreign(block);
      bondlab::scatter(t, block.first, atom->nlocal, loads, atom->f, atom->torque,
                       [this](int row) { return computes(row); });
    } else {
      bondlab::scatter(t, block.first, atom->nlocal, loads, atom->f, atom->torque);
    }
    if (advance) finish_step(block);
  });
}

template <class Kinematics, class Orientations, class Loads, class Sink>
void BondBPM::walk(bool advance, const bondlab::ParticleRecords &records, Sink sink) {
  PairTable &t = table();
  const int n = t.size();
  const double dt = advance ? update->dt : 0.0;
  Block block;
  Kinematics kinematics;
  Orientations turned;
  Loads loads;
  for (int first = 0; first < n; first += kBlock) {
    const int kind = block_type_[first / kBlock];
    if (kind == NONE) continue;
    if (first + kBlock < n) {
      t.prefetch(first + kBlock);
      bondlab::prefetch(t, first + kBlock, records);
    }
    if (orientations_)
      bondlab::gather(t, first, dt, records, style_->quat, kinematics, turned);
    else
      bondlab::gather(t, first, dt, records, kinematics);
    view(first, kinematics.ri, kinematics.rj, kinematics.per_both, block);
    block.dt = dt;
    run_block(block, kinematics, turned, advance, loads);
    sink(block, loads, kind);
  }
}

void BondBPM::for_each_force(const VisitForce &visit) {
  refresh();
  const bondlab::ParticleRecords &records = style_->fill_records();
  const auto sink = [&](Block &block, const auto &loads, int) {
    const int n = std::min(kBlock, table().size() - block.first);
    for (int lane = 0; lane < n; lane++) {
      const int row = block.first + lane;
      if (!computes(row)) continue;
      double f[3];
      bondlab::force_of(loads, lane, f);
      visit(row, f);
    }
  };
  if (flat())
    walk<Kinematics2, Orientations2, PairLoads2>(false, records, sink);
  else
    walk<Kinematics3, Orientations3, PairLoads3>(false, records, sink);
}

// Lays out one block for the law: state in place, unless other styles own some of the lanes.
void BondBPM::view(int first, const double *ri, const double *rj, const double *per_both, Block &b) {
  PairTable &t = table();
  const int kind = block_type_[first / kBlock], columns = t.columns();
  b.first = first;
  b.alive = own(ALIVE, first);
  b.ri = ri;
  b.rj = rj;
  for (int c = 0; c < columns; c++) {
    b.state[c] = t.block(c, first);
    if (kind != FOREIGN) continue;
    std::copy(b.state[c], b.state[c] + kBlock, b.kept[c]);
    b.state[c] = b.kept[c];
  }
  for (int k = 0; k <= constants_; k++) {  // the last: E_t/E_c
    const int place = k < constants_ ? place_[k] : -1;
    const double *values;
    if (place >= 0) {
      values = own(place, first);
    } else if (kind >= 0) {
      values = of_type(kind, k);
    } else {
      for (int lane = 0; lane < kBlock; lane++) {
        const int type = t.info[std::min(first + lane, t.size() - 1)] & TYPE_MASK;
        b.scratch[k][lane] = *of_type(mine(type) ? type : fallback_type_, k);
      }
      values = b.scratch[k];
    }
    if (k < constants_)
      b.constant[k] = values;
    else
      b.options.tension = values;
  }

  b.with_options = any_options_;
  if (any_options_) {
    const double *tau = own(own_columns_ - 1, first), per_step = update->dt > 0.0 ? 1.0 / update->dt : 0.0;
    double *viscous = b.scratch[kMostConstants];
    for (int lane = 0; lane < kBlock; lane++) viscous[lane] = per_step * tau[lane];
    b.options.viscous = viscous;
    b.options.failure = own(own_columns_ - 2, first);
    b.options.worst = b.state[LAW + style_->law_columns];
    b.options.lost = b.state[LAW + style_->law_columns + 1];
  }

  double *kn = b.scratch[kMostConstants + 1], *ks = b.scratch[kMostConstants + 2],
         *mu = b.scratch[kMostConstants + 3];
  b.with_contact = grain_ != NULL;
  b.contact = {b.state[REFERENCE], kn, ks, mu};
  if (!grain_) {
    for (int lane = 0; lane < kBlock; lane++) kn[lane] = ks[lane] = mu[lane] = 0.0;
    return;
  }
  if (atom->ntypes == 1) {
    grain_->constants_of_block(b.ri, b.rj, per_both, kn, ks, mu);
  } else {
    const int place = VARYING + varying_;
    for (int k = 0; k < 3; k++)
      std::copy(own(place + k, first), own(place + k, first) + kBlock, (k == 0 ? kn : (k == 1 ? ks : mu)));
  }
  if (kind >= 0 ? types_[kind].contact != 0.0 : !any_contact_off_) return;
  double alive = 0.0;
  for (int lane = 0; lane < kBlock; lane++) {
    const int type = kind >= 0 ? kind : t.info[std::min(first + lane, t.size() - 1)] & TYPE_MASK;
    const bool off = mine(type) && types_[type].contact == 0.0;
    const double share = off ? 1.0 - b.alive[lane] : 1.0;
    kn[lane] *= share;
    ks[lane] *= share;
    alive += 1.0 - share;
  }
  b.with_contact = alive != kBlock;
}

// Lanes of other styles leave their state as it was.
void BondBPM::restore_foreign(Block &b) {
  PairTable &t = table();
  const int n = std::min(kBlock, t.size() - b.first);
  for (int c = 0; c < t.columns(); c++)
    for (int lane = 0; lane < n; lane++)
      if (computes(b.first + lane)) t.value(c, b.first + lane) = b.kept[c][lane];
}

void BondBPM::finish_step(Block &b) {
  double alive = 0.0;
  for (int k = 0; k < kBlock; k++) alive += b.alive[k];
  if (alive == kBlock) return;
  PairTable &t = table();
  const int n = std::min(kBlock, t.size() - b.first);
  for (int k = 0; k < n; k++) {
    const int row = b.first + k;
    if (b.alive[k] != 0.0 || !computes(row)) continue;
    if (b.report.fate[k] != 0.0) note_break(b, k);
    if (t.info[row] & SEPARATED) continue;
    // beyond both references neither contact is loaded, so the change makes no jump
    const double touching = b.ri[k] + b.rj[k];
    if (distance(row) >= std::max(state(REFERENCE, row), touching)) {
      t.info[row] |= SEPARATED;
      t.value(REFERENCE, row) = touching;
    }
  }
}

void BondBPM::note_break(Block &b, int lane) {
  PairTable &t = table();
  const int row = b.first + lane;
  t.info[row] |= BROKEN;
  // a contact that was switched off takes over from where the two are now, without a jump
  const int type = t.info[row] & TYPE_MASK;
  if (types_[type].contact == 0.0) t.value(REFERENCE, row) = std::min(state(REFERENCE, row), distance(row));
  if (!counted_here(row)) return;
  BreakEvent event;
  event.step = update->ntimestep;
  event.tag_lo = t.lo[row];
  event.tag_hi = t.hi[row];
  event.type = type;
  const double share = b.ri[lane] / (b.ri[lane] + b.rj[lane]);
  const double *p = atom->x[t.at_lo[row]], *q = atom->x[t.at_hi[row]];
  for (int d = 0; d < 3; d++) event.x[d] = p[d] + share * (q[d] - p[d]);
  event.mode = static_cast<int>(b.report.fate[lane]) - static_cast<int>(BondFate::broken_in_tension);
  event.sigma = b.report.sigma[lane];
  event.tau = b.report.tau[lane];
  strengths(row, event.sigma_c, event.tau_c);
  style_->breaks.push_back(event);
}

double BondBPM::distance(int row) const {
  const PairTable &t = table();
  const double *a = atom->x[t.at_lo[row]], *b = atom->x[t.at_hi[row]];
  double d2 = 0.0;
  for (int d = 0; d < 3; d++) d2 += (b[d] - a[d]) * (b[d] - a[d]);
  return std::sqrt(d2);
}

double BondBPM::contact_row_energy(int row) const {
  if (!grain_) return 0.0;
  const PairTable &t = table();
  if (types_[t.info[row] & TYPE_MASK].contact == 0.0 && intact(row)) return 0.0;
  const double overlap = state(REFERENCE, row) - distance(row);
  double shear2 = 0.0, kn, ks, mu;
  for (int c = CSX; c <= (flat() ? CSX : CSZ); c++) shear2 += state(c, row) * state(c, row);
  grain_->constants(atom->type[t.at_lo[row]], atom->type[t.at_hi[row]], atom->radius[t.at_lo[row]],
                    atom->radius[t.at_hi[row]], kn, ks, mu);
  return contact_energy(overlap > 0.0 ? kn * overlap : 0.0, std::sqrt(shear2), kn, ks);
}

BondBPM::Stiffness BondBPM::whole_stiffness(int row, double &damping_time) const {
  const PairTable &t = table();
  Stiffness s = stiffness(row);
  const BondOptions &options = types_[t.info[row] & TYPE_MASK];
  damping_time = any_options_ && intact(row) ? own_value(own_columns_ - 1, row) : 0.0;
  s.normal *= std::max(1.0, options.tension);
  if (grain_) {
    double kn, ks, mu;
    grain_->constants(atom->type[t.at_lo[row]], atom->type[t.at_hi[row]], atom->radius[t.at_lo[row]],
                      atom->radius[t.at_hi[row]], kn, ks, mu);
    s.normal += kn;  // also where the contact waits for the bond to break
    s.shear += ks;
  }
  return s;
}

void BondBPM::create(const double *, const double *, const double *, const double *, double *) const {}

double BondBPM::equilibrium_distance(int) { return 0.0; }

double BondBPM::single(int, double, int, int, double &fforce) {
  fforce = 0.0;
  return 0.0;
}

double BondBPM::memory_usage() {
  return sizeof(double) * (own_.size() + of_type_.size()) + sizeof(int) * block_type_.size();
}
