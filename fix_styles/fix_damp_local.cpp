// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_damp_local.h.
#include "fix_damp_local.h"

#include <cstring>
#include <string>

#include "atom.h"
#include "fix_arguments.h"
#include "local_damping.h"
#include "modify.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixDampLocal::FixDampLocal(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), alpha_(0.0) {
  FixArguments a(lmp, this, narg, arg);
  alpha_ = a.number_in("the damping coefficient alpha", 0.0, 1.0);
  if (a.more()) a.fail("takes one number, alpha; '" + a.word("") + "' is too many");
  if (!atom->torque_flag || !atom->omega_flag)
    a.fail("needs particles that rotate, `atom_style bonded/sphere`");
}

int FixDampLocal::setmask() { return POST_FORCE; }

void FixDampLocal::init() {
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
