// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_nve_bonded.h.
#include "fix_nve_bonded.h"

#include <cmath>
#include <cstring>
#include <string>

#include "atom.h"
#include "bond_styles/liggghts/atom_vec_bonded_sphere.h"
#include "domain.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixNVEBonded::FixNVEBonded(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), style_(AtomVecBondedSphere::of(lmp, "fix nve/bonded")),
      orientation_(false), first_step_(false), half_dt_(0.0), dt_(0.0), inertia_factor_(0.4) {
  time_integrate = 1;
  for (int k = 3; k < narg; k += 2) {
    const bool known = !strcmp(arg[k], "orientation") && k + 1 < narg &&
                       (!strcmp(arg[k + 1], "yes") || !strcmp(arg[k + 1], "no"));
    if (!known) {
      const std::string text = std::string("fix nve/bonded: '") + arg[k] +
                               "' is not understood, allowed is `orientation yes|no`";
      error->all(FLERR, text.c_str());
    }
    orientation_ = !strcmp(arg[k + 1], "yes");
  }
}

int FixNVEBonded::setmask() { return INITIAL_INTEGRATE | FINAL_INTEGRATE; }

void FixNVEBonded::init() {
  inertia_factor_ = domain->dimension == 2 ? 0.5 : 0.4;  // disc, sphere
  if (style_->send_orientation) orientation_ = true;  // a bond law asked for it
  first_step_ = true;
  reset_dt();
}

void FixNVEBonded::reset_dt() {
  dt_ = update->dt;
  half_dt_ = 0.5 * update->dt;
}

// v += dt/2 F/m, w += dt/2 T/I for the particles of the group
void FixNVEBonded::half_kick() {
  const int n = atom->nlocal, *mask = atom->mask;
  double *v = atom->v[0], *w = atom->omega[0];
  const double *f = atom->f[0], *t = atom->torque[0], *m = atom->rmass, *r = atom->radius;
  const double dt = half_dt_, factor = inertia_factor_;
  for (int i = 0; i < n; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double linear = dt / m[i], angular = linear / (factor * r[i] * r[i]);
    for (int d = 0; d < 3; d++) {
      v[3 * i + d] += linear * f[3 * i + d];
      w[3 * i + d] += angular * t[3 * i + d];
    }
  }
}

void FixNVEBonded::initial_integrate(int) {
  if (atom->nlocal == 0) {
    first_step_ = false;
    return;
  }
  if (first_step_) {
    // the run's set-up computed forces from full-step velocities: take those the last run ended with
    style_->restore_forces(update->ntimestep - 1);
    first_step_ = false;
  }
  half_kick();
  const int n = atom->nlocal, *mask = atom->mask;
  double *x = atom->x[0];
  const double *v = atom->v[0], dt = dt_;
  for (int i = 0; i < n; i++) {
    if (!(mask[i] & groupbit)) continue;
    for (int d = 0; d < 3; d++) x[3 * i + d] += dt * v[3 * i + d];
  }
  if (style_->on_grid()) style_->snap_to_grid();
  if (orientation_) turn();
}

void FixNVEBonded::final_integrate() {
  if (atom->nlocal) half_kick();
}

// After `run 0` the forces are those of a set-up: they must not replace what the last step ended with.
void FixNVEBonded::post_run() {
  const bool stepped = !first_step_;
  if (stepped || style_->saved_step != update->ntimestep) style_->save_forces();
}

// q <- rotation by w dt, times q (exact for constant w), unit length kept. With half the angle h below
// 0.1, as in any usable step, sine and cosine are their series to rounding (next terms 3e-18 and 2e-21), and
// the length is mended by one Newton step: no call of the mathematics library, which took longer than
// all the rest of the integration.
void FixNVEBonded::turn() {
  const int n = atom->nlocal, *mask = atom->mask;
  double **q = style_->quat, **w = atom->omega;
  const double half_dt = 0.5 * dt_;
  for (int i = 0; i < n; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double rate2 = w[i][0] * w[i][0] + w[i][1] * w[i][1] + w[i][2] * w[i][2];
    const double h2 = half_dt * half_dt * rate2;
    double s, c;  // sin(h)/|w|, cos(h)
    if (h2 < 0.01) {
      s = half_dt * (1.0 + h2 * (-1.0 / 6 + h2 * (1.0 / 120 + h2 * (-1.0 / 5040 + h2 * (1.0 / 362880)))));
      c = 1.0 + h2 * (-0.5 + h2 * (1.0 / 24 + h2 * (-1.0 / 720 + h2 * (1.0 / 40320 - h2 * (1.0 / 3628800)))));
    } else {
      const double rate = std::sqrt(rate2);
      s = std::sin(half_dt * rate) / rate;
      c = std::cos(half_dt * rate);
    }
    const double ax = s * w[i][0], ay = s * w[i][1], az = s * w[i][2];
    const double p[4] = {q[i][0], q[i][1], q[i][2], q[i][3]};
    // rotation in world axes multiplies from the left
    const double r[4] = {c * p[0] - ax * p[1] - ay * p[2] - az * p[3],
                         c * p[1] + ax * p[0] + ay * p[3] - az * p[2],
                         c * p[2] + ay * p[0] + az * p[1] - ax * p[3],
                         c * p[3] + az * p[0] + ax * p[2] - ay * p[1]};
    const double off = r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3] - 1.0;
    const double norm = std::fabs(off) < 1e-8 ? 1.0 - 0.5 * off : 1.0 / std::sqrt(1.0 + off);
    for (int d = 0; d < 4; d++) q[i][d] = norm * r[d];
  }
}
