// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_damp_local.h.
#include "fix_damp_local.h"

#include <cmath>
#include <cstring>
#include <string>

#include "atom.h"
#include "bond_styles/liggghts/atom_vec_bonded_sphere.h"
#include "domain.h"
#include "fix_arguments.h"
#include "local_damping.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixDampLocal::FixDampLocal(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), alpha_(0.0), style_(NULL), taken_(NULL), first_step_(true) {
  FixArguments a(lmp, this, narg, arg);
  alpha_ = a.number_in("the damping coefficient alpha", 0.0, 1.0);
  bool energy = false;
  if (a.next_is("energy")) energy = a.choice("energy", "no|yes") == 1;
  if (a.more()) a.fail("takes one number, alpha, and `energy yes|no`; '" + a.word("") + "' is too many");
  if (!atom->torque_flag || !atom->omega_flag)
    a.fail("needs particles that rotate, `atom_style bonded/sphere`");
  if (!energy) return;
  style_ = AtomVecBondedSphere::of(lmp, "fix damp/local energy yes");
  restart_peratom = 1;
  create_attribute = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
}

FixDampLocal::~FixDampLocal() {
  if (!taken_) return;
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  memory->destroy(taken_);
}

int FixDampLocal::setmask() { return taken_ ? POST_FORCE | POST_INTEGRATE : POST_FORCE; }

void FixDampLocal::init() {
  first_step_ = true;
  const int self = modify->find_fix(id);
  for (int i = self + 1; i < modify->nfix; i++)
    if ((modify->fmask[i] & POST_FORCE) && strcmp(modify->fix[i]->style, style) != 0)
      stop_with_error(lmp, this,
                      std::string("must come after fix ") + modify->fix[i]->style + " (id " +
                          modify->fix[i]->id +
                          "), which adds forces: damping acts on the sum of all forces");
}

// The first half step of a run from rest, or one that no integrator of ours takes its force from.
void FixDampLocal::setup(int vflag) { post_force(vflag); }

void FixDampLocal::post_force(int) {
  const int n = atom->nlocal;
  if (n == 0 || alpha_ == 0.0) return;
  double *f = atom->f[0], *t = atom->torque[0];
  const double *v = atom->v[0], *w = atom->omega[0];
  if (igroup == 0) {  // all particles: one contiguous sweep
    bondlab::damp_locally(f, v, 3 * static_cast<std::size_t>(n), alpha_);
    bondlab::damp_locally(t, w, 3 * static_cast<std::size_t>(n), alpha_);
    return;
  }
  for (int i = 0; i < n; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    bondlab::damp_locally(f + 3 * i, v + 3 * i, 3, alpha_);
    bondlab::damp_locally(t + 3 * i, w + 3 * i, 3, alpha_);
  }
}

// ---- energy ----

double FixDampLocal::power(int i, const double *f, const double *t, double back, double at) const {
  const double m = atom->rmass[i], r = atom->radius[i];
  const double per[2] = {update->dt / m, update->dt / ((domain->dimension == 2 ? 0.5 : 0.4) * m * r * r)};
  const double *load[2] = {f, t}, *speed[2] = {atom->v[i], atom->omega[i]};
  double sum = 0.0;
  for (int k = 0; k < 2; k++)
    for (int d = 0; d < 3; d++) {
      const double kick = per[k] * load[k][d], then = speed[k][d] - back * kick;
      // at rest but for rounding: nothing is damped
      if (std::fabs(then) <= 1e-14 * std::fabs(kick)) continue;
      sum += bondlab::damping_part(load[k][d], then, alpha_) * (speed[k][d] - at * kick);
    }
  return sum;
}

// Positions and half-step velocities are new, forces are those of the last step.
void FixDampLocal::post_integrate() {
  const bool goes_on = !first_step_ || style_->saved_step == update->ntimestep - 1;
  first_step_ = false;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *f = atom->f[i], *t = atom->torque[i];
    // a first step's force was damped by the velocity of the start, and did no work before
    const double work = goes_on ? 0.5 * (power(i, f, t, 1.0, 1.0) + power(i, f, t, 1.0, 0.0)) : 0.5 * power(i, f, t, 0.5, 0.0);
    taken_[i] -= update->dt * work;
  }
}

// With the first half of this step's force, which velocity Verlet's kinetic energy already holds.
double FixDampLocal::dissipated(int i) const {
  if (!taken_) return 0.0;
  const bool kept = style_->saved_step == update->ntimestep;  // between two runs
  if (!(atom->mask[i] & groupbit) || (first_step_ && !kept)) return taken_[i];
  const double *f = atom->f[i], *t = atom->torque[i];
  if (first_step_) f = style_->saved_force[i], t = f + 3;
  return taken_[i] - 0.5 * update->dt * power(i, f, t, 0.5, 0.5);
}

void FixDampLocal::grow_arrays(int nmax) { memory->grow(taken_, nmax, "damp/local:taken"); }
void FixDampLocal::copy_arrays(int i, int j, int) { taken_[j] = taken_[i]; }
void FixDampLocal::set_arrays(int i) { taken_[i] = 0.0; }

int FixDampLocal::pack_exchange(int i, double *buf) {
  buf[0] = taken_[i];
  return 1;
}
int FixDampLocal::unpack_exchange(int i, double *buf) {
  taken_[i] = buf[0];
  return 1;
}

int FixDampLocal::size_restart(int) { return 2; }
int FixDampLocal::maxsize_restart() { return 2; }
int FixDampLocal::pack_restart(int i, double *buf) {
  buf[0] = 2;
  buf[1] = taken_[i];
  return 2;
}
void FixDampLocal::unpack_restart(int i, int which) {
  const double *extra = atom->extra[i];
  int at = 0;
  for (int k = 0; k < which; k++) at += static_cast<int>(extra[at]);
  taken_[i] = extra[at + 1];
}

double FixDampLocal::memory_usage() { return taken_ ? sizeof(double) * static_cast<double>(atom->nmax) : 0.0; }
