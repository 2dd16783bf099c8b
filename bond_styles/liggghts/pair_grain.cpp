// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see pair_grain.h.
#include "pair_grain.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "pair_gather.h"
#include "read_number.h"
#include "update.h"

using namespace LAMMPS_NS;
using bondlab::PairTable;
using namespace bondlab::laws;

PairGrain::PairGrain(LAMMPS *lmp)
    : Pair(lmp), style_(AtomVecBondedSphere::of(lmp, "pair_style grain")), modulus_(NULL),
      ratio_(NULL), friction_(NULL), seen_generation_(-1), largest_radius_(0.0) {
  single_enable = 0;
  no_virial_fdotr_compute = 1;
}

PairGrain::~PairGrain() {
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
  memory->destroy(modulus_);
  memory->destroy(ratio_);
  memory->destroy(friction_);
}

void PairGrain::allocate() {
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  memory->create(modulus_, n, n, "pair:modulus");
  memory->create(ratio_, n, n, "pair:ratio");
  memory->create(friction_, n, n, "pair:friction");
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      setflag[i][j] = 0;
      modulus_[i][j] = ratio_[i][j] = friction_[i][j] = 0.0;
    }
}

void PairGrain::settings(int narg, char **arg) {
  if (narg) {
    const std::string text =
        std::string("pair_style grain takes no further words, '") + arg[0] + "' was given";
    error->all(FLERR, text.c_str());
  }
}

void PairGrain::coeff(int narg, char **arg) {
  if (narg != 5)
    error->all(FLERR, "pair_coeff for pair_style grain: expected `pair_coeff I J E_c kn_ks mu` (Pa, 1, 1)");
  if (!allocated) allocate();
  int ilo, ihi, jlo, jhi;
  force->bounds(arg[0], atom->ntypes, ilo, ihi);
  force->bounds(arg[1], atom->ntypes, jlo, jhi);
  const double modulus = bondlab::read_number(arg[2]);
  const double ratio = bondlab::read_number(arg[3]);
  const double friction = bondlab::read_number(arg[4]);
  const auto check = [this](bool good, const char *name, const char *given, const char *allowed) {
    if (good) return;
    const std::string text = std::string("pair_coeff for pair_style grain: ") + name + " is " +
                             given + ", it must be " + allowed;
    error->all(FLERR, text.c_str());
  };
  check(modulus >= 0.0 && std::isfinite(modulus), "E_c", arg[2], "0 (no contact) or positive, Pa");
  check(ratio > 0.0 && std::isfinite(ratio), "kn_ks", arg[3], "positive");
  check(friction >= 0.0 && std::isfinite(friction), "mu", arg[4], "0 or positive");
  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) {
      modulus_[i][j] = modulus_[j][i] = modulus;
      ratio_[i][j] = ratio_[j][i] = ratio;
      friction_[i][j] = friction_[j][i] = friction;
      setflag[i][j] = 1;
      count++;
    }
  if (count == 0) error->all(FLERR, "pair_coeff for pair_style grain: no pair of types I <= J was named");
}

void PairGrain::init_style() {
  if (force->newton_pair)
    error->all(FLERR, "pair_style grain needs `newton off` (or `newton off on`)");
  comm->ghost_velocity = 1;
  double mine = 0.0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, atom->radius[i]);
  MPI_Allreduce(&mine, &largest_radius_, 1, MPI_DOUBLE, MPI_MAX, world);
  const int request = neighbor->request(this);
  neighbor->requests[request]->half = 0;
  neighbor->requests[request]->gran = 1;
  seen_generation_ = -1;
}

double PairGrain::init_one(int i, int j) {
  if (!setflag[i][j]) {
    // grains of two types: each brings its own stiffness (in series), the smaller friction slips
    modulus_[i][j] = modulus_[j][i] = -1.0;
    ratio_[i][j] = ratio_[j][i] = std::sqrt(ratio_[i][i] * ratio_[j][j]);
    friction_[i][j] = friction_[j][i] = std::min(friction_[i][i], friction_[j][j]);
  }
  return 2.0 * largest_radius_;
}

void PairGrain::constants(int itype, int jtype, double ri, double rj, double &kn, double &ks,
                          double &mu) const {
  const bool mixed = modulus_[itype][jtype] < 0.0;
  const double ei = mixed ? modulus_[itype][itype] : modulus_[itype][jtype];
  const double ej = mixed ? modulus_[jtype][jtype] : modulus_[itype][jtype];
  if (domain->dimension == 2)
    kn = in_series(grain_stiffness_2d(style_->thickness, ei),
                   grain_stiffness_2d(style_->thickness, ej));
  else
    kn = in_series(grain_stiffness_3d(ri, ei), grain_stiffness_3d(rj, ej));
  ks = kn / ratio_[itype][jtype];
  mu = friction_[itype][jtype];
}

void PairGrain::constants_of_block(const double *__restrict ri, const double *__restrict rj,
                                   const double *__restrict per_both, double *__restrict kn, double *__restrict ks,
                                   double *__restrict mu) const {
  const double modulus = modulus_[1][1], ratio = ratio_[1][1], friction = friction_[1][1];
  if (domain->dimension == 2) {
    const double k = in_series(grain_stiffness_2d(style_->thickness, modulus),
                               grain_stiffness_2d(style_->thickness, modulus));
    for (int b = 0; b < kBlock; b++) kn[b] = k, ks[b] = k / ratio, mu[b] = friction;
    return;
  }
  // in_series() of two grains of one modulus is 4 E R_i R_j/(R_i + R_j)
  const double four = grain_stiffness_3d(1.0, modulus), soft = four / ratio;
  for (int b = 0; b < kBlock; b++) {
    const double share = ri[b] * rj[b] * per_both[b];
    kn[b] = four * share;
    ks[b] = soft * share;
    mu[b] = friction;
  }
}

// Takes the rows anew from the neighbour list; pairs in the bond table are the bond style's.
void PairGrain::refresh() {
  style_->index_tables();
  if (seen_generation_ == style_->generation) return;
  seen_generation_ = style_->generation;

  PairTable &t = style_->contacts;
  const PairTable &bonds = style_->bonds;
  PairTable fresh(t.columns());
  const double none[3] = {0.0, 0.0, 0.0};
  double values[3];
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      const int a = atom->tag[i], b = atom->tag[j];
      if (bonds.find(a, b) >= 0) continue;
      const int old = t.find(a, b);
      if (old >= 0)
        for (int c = 0; c < 3; c++) values[c] = t.value(c, old);
      fresh.append(a, b, 0, old >= 0 ? values : none);
    }
  }
  fresh.index(
      atom->nlocal, [this](int tag) { return atom->map(tag); },
      [this](int a, int b) { return domain->closest_image(a, b); });
  t = std::move(fresh);

  const int n = t.size(), padded = static_cast<int>(t.at_lo.size());
  for (auto *v : {&reference_, &kn_, &ks_, &mu_}) v->assign(padded, 0.0);
  for (int k = 0; k < padded; k++) {
    const int row = std::min(k, n - 1), i = t.at_lo[row], j = t.at_hi[row];
    reference_[k] = atom->radius[i] + atom->radius[j];
    constants(atom->type[i], atom->type[j], atom->radius[i], atom->radius[j], kn_[k], ks_[k], mu_[k]);
  }
}

void PairGrain::compute(int eflag, int vflag) {
  if (eflag || vflag)
    ev_setup(eflag, vflag);
  else
    evflag = vflag_fdotr = 0;
  refresh();
  const PairTable &t = style_->contacts;
  walk(!update->setupflag, style_->fill_records(), [&](int first, const auto &loads) {
    bondlab::scatter(t, first, atom->nlocal, loads, atom->f, atom->torque);
  });
}

void PairGrain::for_each_force(const std::function<void(int, const double *)> &visit) {
  refresh();
  walk(false, style_->fill_records(), [&](int first, const auto &loads) {
    for (int lane = 0; lane < std::min(kBlock, style_->contacts.size() - first); lane++) {
      double f[3];
      bondlab::force_of(loads, lane, f);
      visit(first + lane, f);
    }
  });
}

template <class Sink>
void PairGrain::walk(bool advance, const bondlab::ParticleRecords &records, Sink sink) {
  PairTable &t = style_->contacts;
  const double dt = advance ? update->dt : 0.0;
  for (int first = 0; first < t.size(); first += kBlock) {
    const ContactParameters c{reference_.data() + first, kn_.data() + first, ks_.data() + first,
                              mu_.data() + first};
    if (domain->dimension == 2) {
      Kinematics2 k;
      PairLoads2 loads;
      bondlab::gather(t, first, dt, records, k);
      contact_block_2d(k, c, advance, t.block(0, first), loads);
      sink(first, loads);
    } else {
      Kinematics3 k;
      PairLoads3 loads;
      bondlab::gather(t, first, dt, records, k);
      contact_block_3d(k, c, advance, t.block(0, first), t.block(1, first), t.block(2, first), loads);
      sink(first, loads);
    }
  }
}

void PairGrain::write_restart(FILE *fp) {
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      const double row[4] = {double(setflag[i][j]), modulus_[i][j], ratio_[i][j], friction_[i][j]};
      fwrite(row, sizeof(double), 4, fp);
    }
}

void PairGrain::read_restart(FILE *fp, const int, const int) {
  if (!allocated) allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      double row[4] = {0.0, 0.0, 0.0, 0.0};
      if (comm->me == 0 && fread(row, sizeof(double), 4, fp) != 4)
        error->one(FLERR, "restart file ends within the coefficients of pair_style grain");
      MPI_Bcast(row, 4, MPI_DOUBLE, 0, world);
      setflag[i][j] = static_cast<int>(row[0]);
      modulus_[i][j] = modulus_[j][i] = row[1];
      ratio_[i][j] = ratio_[j][i] = row[2];
      friction_[i][j] = friction_[j][i] = row[3];
    }
}

double PairGrain::memory_usage() { return Pair::memory_usage() + 4.0 * sizeof(double) * kn_.size(); }
