// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_bpm.h. Coefficients, constants of types and rows, restart.
#include <algorithm>
#include <cmath>

#include "atom.h"
#include "bond_bpm.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "pair_grain.h"

using namespace LAMMPS_NS;
using bondlab::PairTable;
using namespace bondlab::laws;

namespace {

// A broken pair that has once been apart is an ordinary contact. Its row stays all the same while the
// two could come into contact again, with the history of that contact and its place in the order of
// summation: both would change at a rebuild of the neighbour list, whenever that happens to be. It
// goes when they are further apart than ghosts reach, the same distance on any number of ranks.
bool gone(const AtomVecBondedSphere *style, Atom *atom, Comm *comm, Domain *domain, int row) {
  const PairTable &t = style->bonds;
  const int both = BondBPM::BROKEN | BondBPM::SEPARATED;
  if ((t.info[row] & both) != both) return false;
  int i = style->index_of(t.lo[row]), j = style->index_of(t.hi[row]);
  if (i < 0 || j < 0) return true;
  if (i >= atom->nlocal) std::swap(i, j);
  if (i >= atom->nlocal) return true;  // belongs to other ranks now
  j = domain->closest_image(i, j);
  double d2 = 0.0;
  for (int d = 0; d < 3; d++) d2 += (atom->x[j][d] - atom->x[i][d]) * (atom->x[j][d] - atom->x[i][d]);
  const double reach = *std::min_element(comm->cutghost, comm->cutghost + domain->dimension);
  return d2 > reach * reach * (1.0 - 1e-9);
}

}  // namespace

BondBPM::BondBPM(LAMMPS *lmp, const char *name, int law_columns, int constants, bool orientations)
    : Bond(lmp), name_(name), style_(AtomVecBondedSphere::of(lmp, "bond_style")), grain_(NULL),
      law_columns_(law_columns), constants_(constants), orientations_(orientations),
      any_options_(false), any_contact_off_(false), fallback_type_(0), varying_(0),
      place_(constants, -1), seen_generation_(-1), own_columns_(VARYING) {
  writedata = 0;  // coefficients are the deck's, not the data file's
  style_->ask_for_columns(LAW, law_columns, false);
  if (orientations) style_->need_orientations();
  AtomVecBondedSphere *style = style_;
  style_->bond_gone = [style, this](int row) { return gone(style, atom, comm, domain, row); };
}

BondBPM::~BondBPM() {
  // the atom style may be gone already when the engine shuts down
  if (dynamic_cast<AtomVecBondedSphere *>(atom->avec) == style_) style_->bond_gone = nullptr;
  if (allocated) memory->destroy(setflag);
}

void BondBPM::bad(const std::string &text) const {
  error->all(FLERR, text.c_str());
  abort();
}

void BondBPM::settings(int narg, char **arg) {
  if (narg) bad(std::string("bond_style takes no further words, '") + arg[0] + "' was given");
}

void BondBPM::allocate() {
  allocated = 1;
  const int n = atom->nbondtypes + 1;
  memory->create(setflag, n, "bond:setflag");
  for (int i = 0; i < n; i++) setflag[i] = 0;
  types_.assign(n, BondOptions());
}

void BondBPM::coeff(int narg, char **arg) {
  if (!allocated) allocate();
  int lo, hi;
  force->bounds(arg[0], atom->nbondtypes, lo, hi);
  BondCoefficients words(name_, std::vector<std::string>(arg + 1, arg + narg),
                         [this](const std::string &text) { bad(text); });
  const BondOptions options = words.take_options();
  if (lo > hi) words.wrong("no bond type was named");
  read_coefficients(words, lo, hi);
  for (int i = lo; i <= hi; i++) {
    types_[i] = options;
    setflag[i] = 1;
  }
  if (options.any()) style_->ask_for_columns(LAW, law_columns_, true);
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
  for (int row = 0; row < t.size(); row++) longest = std::max(longest, state(REST, row));
  MPI_Allreduce(&longest, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  if (all > 0.0) comm->cutghostuser = std::max(comm->cutghostuser, 1.5 * all + neighbor->skin);
  if (!allocated) bad(std::string("bond_style ") + name_ + " has no bond_coeff");
  derive_types();
  seen_generation_ = -1;  // coefficients may have changed
}

// What a bond type fixes once and for all, and which constants it doesn't.
void BondBPM::derive_types() {
  const int n = static_cast<int>(types_.size());
  any_options_ = any_contact_off_ = false;
  fallback_type_ = 0;
  varying_ = 0;
  std::fill(place_.begin(), place_.end(), -1);
  for (int type = 1; type < n; type++) {
    if (!setflag[type]) continue;
    if (!fallback_type_) fallback_type_ = type;
    any_options_ = any_options_ || types_[type].any();
    any_contact_off_ = any_contact_off_ || types_[type].contact == 0.0;
    for (int k = 0; k < constants_; k++)
      if (varies(type, k)) place_[k] = 0;
  }
  for (int &place : place_)
    if (place == 0) place = VARYING + varying_++;
  own_columns_ = VARYING + varying_ + (atom->ntypes > 1 ? 3 : 0) + (any_options_ ? 2 : 0);
  of_type_.assign(std::size_t(n) * (constants_ + 1) * kBlock, 0.0);
  for (int type = 1; type < n; type++) {
    if (!setflag[type]) continue;
    double values[kMostConstants] = {0.0};
    const Pair any{type, 1, 2, 1.0, 1.0, 1.0, 1.0, 2.0};
    constants(any, values);
    for (int k = 0; k < constants_; k++) std::fill_n(of_type(type, k), kBlock, values[k]);
    std::fill_n(of_type(type, constants_), kBlock, types_[type].tension);
  }
}

BondBPM::Pair BondBPM::pair(int row) const {
  const PairTable &t = table();
  const int i = t.at_lo[row], j = t.at_hi[row];
  return {t.info[row] & TYPE_MASK, t.lo[row], t.hi[row], atom->radius[i], atom->radius[j],
          atom->rmass[i], atom->rmass[j], state(REST, row)};
}

void BondBPM::refresh() {
  style_->index_tables();
  if (seen_generation_ == style_->generation) return;
  seen_generation_ = style_->generation;
  derive_rows();
}

void BondBPM::derive_rows() {
  const PairTable &t = table();
  const int n = t.size(), padded = t.padded();
  own_.assign(std::size_t(padded) * own_columns_, 0.0);
  block_type_.assign(padded / kBlock, NONE);
  for (int k = 0; k < padded; k++) {
    const int row = std::min(k, n - 1);  // unused lanes repeat the last bond
    const Pair p = pair(row);
    int &kind = block_type_[k / kBlock];
    const int this_kind = mine(p.type) ? p.type : FOREIGN;
    if (k % kBlock == 0)
      kind = this_kind;
    else if (kind != this_kind)
      kind = kind == FOREIGN || this_kind == FOREIGN ? FOREIGN : MIXED;
    int at = VARYING + varying_;
    if (atom->ntypes > 1) {
      if (grain_)
        grain_->constants(atom->type[t.at_lo[row]], atom->type[t.at_hi[row]], p.ri, p.rj,
                          *own(at, k), *own(at + 1, k), *own(at + 2, k));
      at += 3;
    }
    if (this_kind == FOREIGN) {
      // harmless numbers for a lane whose result is thrown away
      for (int c = 0; c < constants_; c++)
        if (place_[c] >= 0) *own(place_[c], k) = 1.0;
      if (any_options_) *own(at, k) = 1.0;
      continue;
    }
    *own(ALIVE, k) = t.info[row] & BROKEN ? 0.0 : 1.0;
    double values[kMostConstants] = {0.0};
    constants(p, values);
    for (int c = 0; c < constants_; c++)
      if (place_[c] >= 0) *own(place_[c], k) = values[c];
    if (any_options_) {
      const BondOptions &o = types_[p.type];
      const Opening opening_of_bond = opening(p, values);
      *own(at, k) = failure_factor(o.fracture_energy, o.tension * opening_of_bond.stiffness, opening_of_bond.strength);
      *own(at + 1, k) = viscous_time(o.damping, opening_of_bond.stiffness * opening_of_bond.area, p.mi, p.mj);
    }
  }
  // blocks of other styles only
  for (int first = 0; first < padded; first += kBlock) {
    bool any = false;
    for (int k = first; k < std::min(first + kBlock, n); k++) any = any || computes(k);
    if (!any) block_type_[first / kBlock] = NONE;
  }
}

double BondBPM::constant(int k, int row) const {
  BondBPM *self = const_cast<BondBPM *>(this);
  return place_[k] >= 0 ? own_value(place_[k], row)
                        : *self->of_type(table().info[row] & TYPE_MASK, k);
}

double BondBPM::option(int which, int row) const {
  return any_options_ ? state(LAW + style_->law_columns + which, row) : 0.0;
}

double BondBPM::carried(int row) const {
  return any_options_ ? integrity(option(0, row), own_value(own_columns_ - 2, row)) : 1.0;
}

// ---- restart ------------------------------------------------------------------------------------

void BondBPM::write_restart(FILE *fp) {
  for (int i = 1; i <= atom->nbondtypes; i++) {
    const BondOptions &o = types_[i];
    std::vector<double> row = {o.tension, o.fracture_energy, o.damping, o.contact};
    const std::vector<double> own_words = coefficients(i);
    row.insert(row.end(), own_words.begin(), own_words.end());
    const int n = static_cast<int>(row.size());
    fwrite(&n, sizeof n, 1, fp);
    fwrite(row.data(), sizeof(double), n, fp);
  }
}

void BondBPM::read_restart(FILE *fp) {
  if (!allocated) allocate();
  for (int i = 1; i <= atom->nbondtypes; i++) {
    int n = 0, good = 1;
    std::vector<double> row;
    if (comm->me == 0) {
      good = fread(&n, sizeof n, 1, fp) == 1 && n >= 4 && n < 1000;
      row.resize(good ? n : 0);
      good = good && fread(row.data(), sizeof(double), n, fp) == static_cast<std::size_t>(n);
    }
    MPI_Bcast(&good, 1, MPI_INT, 0, world);
    if (!good) bad(std::string("restart file ends within the coefficients of bond_style ") + name_);
    MPI_Bcast(&n, 1, MPI_INT, 0, world);
    row.resize(n);
    MPI_Bcast(row.data(), n, MPI_DOUBLE, 0, world);
    types_[i] = {row[0], row[1], row[2], row[3]};
    set_coefficients(i, std::vector<double>(row.begin() + 4, row.end()));
    setflag[i] = 1;
    if (types_[i].any()) style_->ask_for_columns(LAW, law_columns_, true);
  }
}
