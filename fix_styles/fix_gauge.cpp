// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_gauge.h.
#include "fix_gauge.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "comm.h"
#include "domain.h"
#include "exact_sum_mpi.h"
#include "fix_arguments.h"
#include "update.h"

using namespace LAMMPS_NS;
using bondlab::ExactSums;
using bondlab::Extent;
using bondlab::Gauge;
using bondlab::GaugeSettings;

namespace {
void over_ranks(Extent &e, MPI_Comm world) {
  MPI_Allreduce(MPI_IN_PLACE, &e.lo, 1, MPI_DOUBLE, MPI_MIN, world);
  MPI_Allreduce(MPI_IN_PLACE, &e.hi, 1, MPI_DOUBLE, MPI_MAX, world);
}
}  // namespace

FixGauge::FixGauge(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg),
      style_(AtomVecBondedSphere::of(lmp, "fix gauge")),
      extent_given_(false),
      placed_(false),
      measured_step_(-1),
      strain_{} {
  vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
  read_arguments(narg, arg);
}

void FixGauge::read_arguments(int narg, char **arg) {
  FixArguments a(lmp, this, narg, arg);
  bool axial = false, layers = false;
  GaugeSettings &s = settings_;
  while (a.more()) {
    if (a.next_is("axial")) {
      s.axial = a.choice("the axial direction", domain->dimension == 2 ? "x|y" : "x|y|z");
      axial = true;
    } else if (a.next_is("layers")) {
      s.low = a.number_in("the lower layer (fraction of the height)", 0.0, 1.0);
      s.high = a.number_in("the upper layer (fraction of the height)", 0.0, 1.0);
      if (s.high <= s.low) a.fail("the upper layer must be above the lower one");
      layers = true;
    } else if (a.next_is("thickness")) {
      s.thickness = a.number("thickness of a layer (m)", FixArguments::POSITIVE);
    } else if (a.next_is("lateral")) {
      s.across = a.choice("the lateral direction", domain->dimension == 2 ? "x|y" : "x|y|z|radial");
      s.lateral = s.across == 3 ? GaugeSettings::shell : GaugeSettings::strips;
      if (!a.next_is("strip")) a.fail("lateral needs `strip T` (m) after the direction");
      s.strip = a.number("depth of the strip (m)", FixArguments::POSITIVE);
    } else if (a.next_is("extent")) {
      frame_.lo = a.number("lower end of the extent (m)");
      frame_.hi = a.number("upper end of the extent (m)");
      if (frame_.hi <= frame_.lo) a.fail("the upper end of the extent must be above the lower one");
      extent_given_ = true;
    } else {
      a.unknown_keyword("axial, layers, thickness, lateral, extent");
    }
  }
  if (!axial) a.fail("needs `axial x|y|z`");
  if (!layers) a.fail("needs `layers LOW HIGH` (fractions of the height)");
  if (!(s.thickness > 0.0)) a.fail("needs `thickness T` (m)");
  if (s.lateral == GaugeSettings::strips && s.across == s.axial)
    a.fail("the lateral direction is the axial one");
}

int FixGauge::setmask() { return 0; }
void FixGauge::init() {}

void FixGauge::setup(int) {
  if (!placed_) place();
  measured_step_ = -1;
}

template <class Visit>
void FixGauge::for_each_particle(Visit visit) const {
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) visit(i, style_->xref[i]);
}

// First use: where is the specimen?
void FixGauge::place() {
  placed_ = true;
  if (!extent_given_) {
    Extent e;
    for_each_particle([&](int i, const double *X) { e.add(X[settings_.axial], atom->radius[i]); });
    over_ranks(e, world);
    frame_.lo = e.lo;
    frame_.hi = e.hi;
  }
  if (settings_.lateral != GaugeSettings::none) place_flanks();
  measure();
  const char *where = strain_.top == 0.0      ? "upper layer"
                      : strain_.bottom == 0.0 ? "lower layer"
                                              : NULL;
  if (settings_.lateral != GaugeSettings::none && strain_.flank == 0.0) where = "flanks";
  if (settings_.lateral == GaugeSettings::strips && !(strain_.lateral == strain_.lateral))
    where = "flanks";
  if (where)
    stop_with_error(lmp, this,
                    std::string("no particle of the group is in the ") + where +
                        "; the specimen reaches from " + std::to_string(frame_.lo) + " to " +
                        std::to_string(frame_.hi) + " m; make the layer or strip thicker");
}

void FixGauge::place_flanks() {
  const Gauge section(settings_, frame_);
  const int a = section.first_across(), b = section.second_across();
  Extent ea, eb, es;
  for_each_particle([&](int i, const double *X) {
    if (!section.in_section(X)) return;
    ea.add(X[a], atom->radius[i]);
    eb.add(X[b], atom->radius[i]);
    es.add(X[settings_.across < 3 ? settings_.across : 0], atom->radius[i]);
  });
  over_ranks(ea, world);
  over_ranks(eb, world);
  over_ranks(es, world);
  frame_.left = es.lo;
  frame_.right = es.hi;
  if (settings_.lateral != GaugeSettings::shell) return;

  frame_.centre[0] = 0.5 * (ea.lo + ea.hi);
  frame_.centre[1] = 0.5 * (eb.lo + eb.hi);
  Extent er;
  for_each_particle([&](int i, const double *X) {
    if (section.in_section(X))
      er.add(std::hypot(X[a] - frame_.centre[0], X[b] - frame_.centre[1]), atom->radius[i]);
  });
  over_ranks(er, world);
  frame_.radius = er.hi;

  const Gauge shell(settings_, frame_);
  ExactSums<3> mean;
  for_each_particle([&](int, const double *X) {
    if (!shell.in_shell(X)) return;
    mean.add(0, 1.0);
    mean.add(1, X[a]);
    mean.add(2, X[b]);
  });
  bondlab::sum_over_ranks(mean, world);
  frame_.shell_centre[0] = mean.value(1) / mean.value(0);
  frame_.shell_centre[1] = mean.value(2) / mean.value(0);
}

void FixGauge::measure() {
  if (!placed_) {
    place();
    return;
  }
  // Between runs positions may be changed at the same step: then nothing is kept.
  if (update->whichflag && measured_step_ == update->ntimestep) return;
  measured_step_ = update->ntimestep;
  Gauge gauge(settings_, frame_);
  for_each_particle([&](int i, const double *X) {
    double u[3];
    domain->unmap(atom->x[i], atom->image[i], u);
    for (int d = 0; d < 3; d++) u[d] -= X[d];
    gauge.add(X, u);
  });
  bondlab::sum_over_ranks(gauge.sums(), world);
  strain_ = gauge.strain();
}

double FixGauge::compute_vector(int n) {
  measure();
  const double values[] = {strain_.axial, strain_.lateral, strain_.top, strain_.bottom,
                           strain_.flank};
  return values[n];
}

// The extent as found, so that a restarted run measures between the same layers.
void FixGauge::write_restart(FILE *fp) {
  if (comm->me != 0) return;
  const double placed = placed_ ? 1.0 : 0.0;
  const int size = sizeof placed + sizeof frame_;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&placed, sizeof placed, 1, fp);
  fwrite(&frame_, sizeof frame_, 1, fp);
}

void FixGauge::restart(char *buf) {
  double placed;
  std::copy(buf, buf + sizeof placed, reinterpret_cast<char *>(&placed));
  if (placed == 0.0) return;
  placed_ = true;
  std::copy(buf + sizeof placed, buf + sizeof placed + sizeof frame_,
            reinterpret_cast<char *>(&frame_));
}
