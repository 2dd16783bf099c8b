// SPDX-License-Identifier: GPL-2.0-or-later
// Job: the platen's motion and forces. See fix_platen.h; arguments and restart are in
// fix_platen_io.cpp.
#include "fix_platen.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "exact_sum_mpi.h"
#include "fix_arguments.h"
#include "force.h"
#include "memory.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using bondlab::PlatenForce;
using bondlab::PlatenHistory;
using bondlab::PlatenTouch;
using bondlab::Vec3;

namespace {
Vec3 vec(const double *a) { return {a[0], a[1], a[2]}; }
}  // namespace

int FixPlaten::setmask() { return INITIAL_INTEGRATE | POST_FORCE; }

void FixPlaten::init() {
  if (strncmp(update->integrate_style, "verlet", 6) != 0)
    stop_with_error(
        lmp, this,
        std::string("needs `run_style verlet`, this run has '") + update->integrate_style + "'");
  motion_.init();
}

void FixPlaten::setup(int) {
  if (!placed_) place();
  apply(false);
  reduce();
}

// The surface where it is at present.
void FixPlaten::stand() {
  now_ = surface_;
  if (touch_along_)
    now_.point = now_.point + touch_shift_ * along_;
  else
    bondlab::close_gap(now_, touch_shift_);
  now_.point = now_.point + vec(motion_.moved());
}

// First use: touch the specimen, start the clock.
void FixPlaten::place() {
  placed_ = true;
  motion_.start(update->ntimestep, update->dt);
  if (touch_) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      const Vec3 x = vec(atom->x[i]);
      const double r = atom->radius[i];
      least = std::fmin(least, touch_along_ ? bondlab::travel_to_touch(surface_, along_, x, r)
                                            : bondlab::touch(surface_, x, r).gap);
    }
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, world);
    if (!std::isfinite(least))
      stop_with_error(lmp, this,
                      "keyword touch: the platen meets no particle of its group in its direction");
    touch_shift_ = least;
  }
  stand();
  if (now_.surface != bondlab::Surface::plane && !(now_.radius > 0.0))
    stop_with_error(lmp, this,
                    "keyword touch: the radius would have to be " + std::to_string(now_.radius) +
                        " m to touch the particles");
  check_nothing_is_behind();
}

// A centre behind the surface is a platen put on the wrong side: the force would be absurd.
void FixPlaten::check_nothing_is_behind() {
  int worst = 0;  // tag
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) {
      const PlatenTouch t = bondlab::touch(now_, vec(atom->x[i]), atom->radius[i]);
      if (t.gap < -atom->radius[i]) worst = atom->tag[i];
    }
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_INT, MPI_MAX, world);
  if (worst)
    stop_with_error(lmp, this,
                    "the centre of particle " + std::to_string(worst) +
                        " is behind the platen's surface; check its place, its normal or "
                        "inside|outside, or use `touch`");
}

void FixPlaten::initial_integrate(int) {
  motion_.advance(update->ntimestep, update->dt, force_);
  step_motion_ = vec(motion_.step());
  stand();
}

void FixPlaten::post_force(int) {
  apply(true);
  if (!motion_.needs_force()) return;
  reduce();
  motion_.finish(update->dt, force_);
}

// Few particles touch: a quick sweep finds them, and those that have just ceased to.
void FixPlaten::apply(bool advance) {
  parts_.clear();
  reduced_ = false;
  const std::size_t n = atom->nlocal;
  if (n == 0) return;
  near_.resize(atom->nmax);
  bondlab::mark_near(now_, atom->x[0], atom->radius, n, near_.data());
  for (std::size_t i = 0; i < n; i++) near_[i] |= touching_[i];
  const unsigned char *mark = near_.data(), *end = mark + n;
  while ((mark = static_cast<const unsigned char *>(std::memchr(mark, 1, end - mark)))) {
    apply_to(static_cast<int>(mark - near_.data()), advance);
    if (++mark == end) break;
  }
}

void FixPlaten::apply_to(int i, bool advance) {
  if (!(atom->mask[i] & groupbit)) return;
  const double dt = update->dt;
  const Vec3 centre = vec(atom->x[i]);
  const double radius = atom->radius[i];
  const PlatenTouch at = bondlab::touch(now_, centre, radius);
  double *h = history_[i], *f = atom->f[i], *t = atom->torque[i];
  if (at.gap >= 0.0) {
    if (advance) set_arrays(i);
    return;
  }
  const double kn = stiffness_.normal(radius);
  const Vec3 arm = at.point - centre;
  const Vec3 motion =
      dt * (vec(atom->v[i]) + bondlab::cross(vec(atom->omega[i]), arm)) - step_motion_;
  PlatenHistory history{vec(h), vec(h + 3)};
  const PlatenForce on = bondlab::platen_force({kn, kn / ratio_, friction_}, -at.gap, at.normal,
                                               motion, advance, history);
  if (advance) {
    const double state[6] = {history.shear.x,  history.shear.y,  history.shear.z,
                             history.normal.x, history.normal.y, history.normal.z};
    std::copy(state, state + 6, h);
    touching_[i] = 1;
  }
  const Vec3 turn = bondlab::cross(arm, on.force);
  f[0] += on.force.x, f[1] += on.force.y, f[2] += on.force.z;
  t[0] += turn.x, t[1] += turn.y, t[2] += turn.z;

  const Vec3 moment = bondlab::cross(at.point - now_.point, on.force);
  parts_.push_back(
      {-on.force.x, -on.force.y, -on.force.z, -moment.x, -moment.y, -moment.z, 1.0, on.energy});
}

// Exact sums cost more than the forces themselves, so they are made when somebody asks.
void FixPlaten::reduce() {
  if (reduced_) return;
  reduced_ = true;
  bondlab::ExactSums<SUMS> all;
  for (const auto &part : parts_)
    for (int k = 0; k < SUMS; k++) all.add(k, part[k]);
  bondlab::sum_over_ranks(all, world);
  for (int k = 0; k < SUMS; k++) total_[k] = all.value(k);
  for (int c = 0; c < 3; c++) force_[c] = total_[FORCE + c];
}

double FixPlaten::compute_vector(int n) {
  if (n >= 6 && n < 9) return motion_.moved()[n - 6];
  if (n >= 9 && n < 12) return motion_.speed(n - 9);
  if (n == 13) return touch_shift_;
  reduce();
  if (n < 6) return total_[n];
  return total_[n == 12 ? TOUCHING : ENERGY];
}

// `reset_timestep` between runs: the clock keeps its time.
void FixPlaten::reset_timestep(bigint to, bigint from) { motion_.renumber(to, from); }
