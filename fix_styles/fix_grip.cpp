// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_grip.h.
#include "fix_grip.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "comm.h"
#include "exact_sum_mpi.h"
#include "fix_arguments.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixGrip::FixGrip(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), motion_(lmp, this), centre_{0, 0, 0}, particles_(0.0), total_{} {
  vector_flag = 1;
  size_vector = 13;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;

  AtomVecBondedSphere::of(lmp, "fix grip");
  FixArguments a(lmp, this, narg, arg);
  while (a.more())
    if (!motion_.read(a)) a.unknown_keyword(FixMotion::keywords());
  motion_.check(a);
}

int FixGrip::setmask() { return INITIAL_INTEGRATE | POST_FORCE; }

void FixGrip::init() {
  motion_.init();
  const int self = modify->find_fix(id);
  for (int i = 0; i < modify->nfix; i++) {
    const char *style = modify->fix[i]->style;
    if (i < self && !strcmp(style, "nve/bonded"))
      stop_with_error(lmp, this, "must be defined before fix nve/bonded, which moves its particles");
    if (i > self && !strcmp(style, "platen"))
      stop_with_error(lmp, this,
                      std::string("must be defined after fix platen (id ") + modify->fix[i]->id +
                          "), whose forces on its particles it takes");
  }
}

void FixGrip::setup(int) {
  if (!motion_.started()) place();
  take_forces();
}

void FixGrip::place() {
  motion_.start(update->ntimestep, update->dt);
  bondlab::ExactSums<4> sums;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    for (int d = 0; d < 3; d++) sums.add(d, atom->x[i][d]);
    sums.add(3, 1.0);
  }
  bondlab::sum_over_ranks(sums, world);
  particles_ = sums.value(3);
  if (particles_ == 0.0) stop_with_error(lmp, this, "no particle is in its group");
  for (int d = 0; d < 3; d++) centre_[d] = sums.value(d) / particles_;
}

void FixGrip::initial_integrate(int) {
  motion_.advance(update->ntimestep, update->dt, total_);
  const double *step = motion_.step();
  const double v[3] = {step[0] / update->dt, step[1] / update->dt, step[2] / update->dt};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    std::copy(v, v + 3, atom->v[i]);
    std::fill(atom->omega[i], atom->omega[i] + 3, 0.0);
  }
}

void FixGrip::post_force(int) {
  take_forces();
  motion_.finish(update->dt, total_);
}

// The particles' forces and torques go to the body.
void FixGrip::take_forces() {
  double c[3];
  for (int d = 0; d < 3; d++) c[d] = centre_[d] + motion_.moved()[d];
  bondlab::ExactSums<6> sums;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *x = atom->x[i];
    double *f = atom->f[i], *t = atom->torque[i];
    const double r[3] = {x[0] - c[0], x[1] - c[1], x[2] - c[2]};
    for (int d = 0; d < 3; d++) {
      const int e = (d + 1) % 3, g = (d + 2) % 3;
      sums.add(d, f[d]);
      sums.add(3 + d, t[d]);
      sums.add(3 + d, r[e] * f[g]);
      sums.add(3 + d, -r[g] * f[e]);
    }
    std::fill(f, f + 3, 0.0);
    std::fill(t, t + 3, 0.0);
  }
  bondlab::sum_over_ranks(sums, world);
  for (int k = 0; k < 6; k++) total_[k] = sums.value(k);
}

double FixGrip::compute_vector(int n) {
  if (n < 6) return total_[n];
  if (n < 9) return motion_.moved()[n - 6];
  if (n < 12) return motion_.speed(n - 9);
  return particles_;
}

void FixGrip::reset_timestep(bigint to, bigint from) { motion_.renumber(to, from); }

void FixGrip::write_restart(FILE *fp) {
  if (comm->me != 0) return;
  std::vector<double> s = motion_.state();
  s.insert(s.end(), centre_, centre_ + 3);
  s.push_back(particles_);
  s.insert(s.end(), total_, total_ + 6);
  const int size = static_cast<int>(s.size() * sizeof(double));
  fwrite(&size, sizeof size, 1, fp);
  fwrite(s.data(), sizeof(double), s.size(), fp);
}

void FixGrip::restart(char *buf) {
  constexpr int motion = FixMotion::state_size;
  double s[motion + 10];
  std::memcpy(s, buf, sizeof s);
  motion_.set_state(s);
  std::copy(s + motion, s + motion + 3, centre_);
  particles_ = s[motion + 3];
  std::copy(s + motion + 4, s + motion + 10, total_);
}
