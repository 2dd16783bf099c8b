// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_membrane.h.
#include "fix_membrane.h"

#include <cmath>
#include <cstring>
#include <string>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "comm.h"
#include "domain.h"
#include "exact_sum_mpi.h"
#include "fix_arguments.h"
#include "platen_motion.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixMembrane::FixMembrane(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg),
      style_(AtomVecBondedSphere::of(lmp, "fix membrane")),
      axial_(0),
      pressure_(0.0),
      ramp_(0.0),
      reach_(0.0) {
  vector_flag = 1;
  size_vector = 2;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;

  FixArguments a(lmp, this, narg, arg);
  axial_ = a.choice("the axis of the specimen", domain->dimension == 2 ? "x|y" : "x|y|z");
  pressure_ = a.number("the pressure (Pa)", FixArguments::NOT_NEGATIVE);
  while (a.more()) {
    if (a.next_is("ramp"))
      ramp_ = a.number("ramp (s)", FixArguments::NOT_NEGATIVE);
    else if (a.next_is("reach"))
      reach_ = a.number("reach (m)", FixArguments::NOT_NEGATIVE);
    else
      a.unknown_keyword("ramp, reach");
  }
}

int FixMembrane::setmask() { return POST_FORCE; }

void FixMembrane::setup(int) {
  if (frame_.placed == 0.0) place();
  post_force(0);
}

int FixMembrane::side(const double *X, double radius, double normal[3]) const {
  normal[0] = normal[1] = normal[2] = 0.0;
  if (domain->dimension == 2) {
    const int across = 1 - axial_;
    const bool lower = X[across] - radius <= frame_.lo + reach_;
    const bool upper = X[across] + radius >= frame_.hi - reach_;
    if (!lower && !upper) return -1;
    normal[across] = upper ? 1.0 : -1.0;
    return upper ? 1 : 0;
  }
  const int a = (axial_ + 1) % 3, b = (axial_ + 2) % 3;
  const double u = X[a] - frame_.centre[0], v = X[b] - frame_.centre[1];
  const double r = std::sqrt(u * u + v * v);
  if (r + radius < frame_.radius - reach_ || r == 0.0) return -1;
  normal[a] = u / r;
  normal[b] = v / r;
  return 0;
}

void FixMembrane::place() {
  frame_.placed = 1.0;
  clock_.start(0.0, update->ntimestep, update->dt);
  const bool flat = domain->dimension == 2;
  const int a = flat ? 1 - axial_ : (axial_ + 1) % 3, b = flat ? a : (axial_ + 2) % 3;
  double least[6] = {0, 0, 0, 0, 0, 0};  // -lo and hi along the axis, a, b
  for (double &value : least) value = 1e300;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *X = style_->xref[i], r = atom->radius[i];
    const int along[3] = {axial_, a, b};
    for (int k = 0; k < 3; k++) {
      least[2 * k] = std::fmin(least[2 * k], X[along[k]] - r);
      least[2 * k + 1] = std::fmin(least[2 * k + 1], -(X[along[k]] + r));
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, least, 6, MPI_DOUBLE, MPI_MIN, world);
  frame_.length = -least[1] - least[0];
  frame_.lo = least[2];
  frame_.hi = -least[3];
  frame_.centre[0] = 0.5 * (least[2] - least[3]);
  frame_.centre[1] = 0.5 * (least[4] - least[5]);
  double radius = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (!flat && (atom->mask[i] & groupbit)) {
      const double u = style_->xref[i][a] - frame_.centre[0];
      const double v = style_->xref[i][b] - frame_.centre[1];
      radius = std::fmax(radius, std::sqrt(u * u + v * v) + atom->radius[i]);
    }
  MPI_Allreduce(&radius, &frame_.radius, 1, MPI_DOUBLE, MPI_MAX, world);

  bondlab::ExactSums<5> sums;
  for (int i = 0; i < atom->nlocal; i++) {
    double n[3];
    const double r = atom->radius[i];
    if (!(atom->mask[i] & groupbit)) continue;
    const int at = side(style_->xref[i], r, n);
    if (at < 0) continue;
    const double share = flat ? r : r * r;
    sums.add(at, share);
    sums.add(2, share * n[a]);
    sums.add(3, share * n[b]);
    sums.add(4, 1.0);
  }
  bondlab::sum_over_ranks(sums, world);
  frame_.share[0] = sums.value(0);
  frame_.share[1] = sums.value(1);
  if (!flat) {
    frame_.drift[0] = sums.value(2);
    frame_.drift[1] = sums.value(3);
  }
  frame_.particles = sums.value(4);
  if (frame_.share[0] == 0.0 || (flat && frame_.share[1] == 0.0))
    stop_with_error(lmp, this, "no particle of the group touches the lateral surface");
}

double FixMembrane::pressure_now() const {
  return ramp_ > 0.0 ? pressure_ * bondlab::ramp_speed(clock_.now, ramp_) : pressure_;
}

void FixMembrane::post_force(int) {
  clock_.advance(update->ntimestep, update->dt);
  const double p = pressure_now();
  if (p == 0.0) return;
  const bool flat = domain->dimension == 2;
  const double thickness = flat ? style_->thickness : 1.0;
  const double area = frame_.length * (flat ? thickness : 2.0 * bondlab::pi * frame_.radius);
  const int a = flat ? 0 : (axial_ + 1) % 3, b = flat ? 0 : (axial_ + 2) % 3;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double n[3];
    const double r = atom->radius[i];
    const int at = side(style_->xref[i], r, n);
    if (at < 0) continue;
    const double push = p * area * (flat ? r : r * r) / frame_.share[at];
    if (!flat) {
      n[a] -= frame_.drift[0] / frame_.share[0];
      n[b] -= frame_.drift[1] / frame_.share[0];
    }
    for (int d = 0; d < 3; d++) atom->f[i][d] -= push * n[d];
  }
}

void FixMembrane::reset_timestep(bigint to, bigint from) { clock_.renumber(to, from); }

double FixMembrane::compute_vector(int n) { return n == 0 ? pressure_now() : frame_.particles; }

void FixMembrane::write_restart(FILE *fp) {
  if (comm->me != 0) return;
  const int size = sizeof frame_ + sizeof clock_;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&frame_, sizeof frame_, 1, fp);
  fwrite(&clock_, sizeof clock_, 1, fp);
}

void FixMembrane::restart(char *buf) {
  std::memcpy(&frame_, buf, sizeof frame_);
  std::memcpy(&clock_, buf + sizeof frame_, sizeof clock_);
}
