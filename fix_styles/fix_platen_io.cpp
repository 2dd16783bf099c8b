// SPDX-License-Identifier: GPL-2.0-or-later
// Job: the platen's arguments, per-particle arrays and restart. See fix_platen.h.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "comm.h"
#include "domain.h"
#include "fix_arguments.h"
#include "fix_platen.h"
#include "memory.h"
#include "update.h"

using namespace LAMMPS_NS;
using bondlab::Surface;
using bondlab::Vec3;

namespace {

constexpr int kHistory = 6;

Vec3 read_vector(FixArguments &a, const char *what) {
  Vec3 v;
  v.x = a.number(what);
  v.y = a.number(what);
  v.z = a.number(what);
  return v;
}

Vec3 unit(FixArguments &a, Vec3 v, const char *what) {
  const double size = bondlab::length(v);
  if (!(size > 0.0)) a.fail(std::string(what) + " is 0 0 0, it must have a direction");
  return (1.0 / size) * v;
}

}  // namespace

FixPlaten::FixPlaten(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg),
      ratio_(1.0),
      friction_(0.0),
      motion_(lmp, this),
      touch_(false),
      touch_along_(false),
      along_{0, 0, 0},
      placed_(false),
      touch_shift_(0.0),
      force_{0, 0, 0},
      history_(NULL),
      touching_(NULL),
      total_{},
      reduced_(true),
      step_motion_{0, 0, 0} {
  vector_flag = 1;
  size_vector = 15;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;

  AtomVecBondedSphere *style = AtomVecBondedSphere::of(lmp, "fix platen");
  if (domain->dimension == 2) stiffness_.thickness = style->thickness;
  read_arguments(narg, arg);
  stand();

  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
}

FixPlaten::~FixPlaten() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  memory->destroy(history_);
  memory->destroy(touching_);
}

void FixPlaten::read_arguments(int narg, char **arg) {
  FixArguments a(lmp, this, narg, arg);
  switch (a.choice("the surface", "plane|cylinder|sphere")) {
    case 0:
      surface_.surface = Surface::plane;
      surface_.point = read_vector(a, "a coordinate of the plane's point (m)");
      surface_.direction =
          unit(a, read_vector(a, "a component of the plane's normal"), "the normal");
      break;
    case 1: {
      surface_.surface = Surface::cylinder;
      if (a.next_is("vector")) {
        surface_.direction = unit(a, read_vector(a, "a component of the axis"), "the axis");
      } else {
        const int axis = a.choice("the axis of the cylinder", "x|y|z|vector");
        surface_.direction = {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
      }
      surface_.point = read_vector(a, "a coordinate of the axis (m)");
      break;
    }
    case 2:
      surface_.surface = Surface::sphere;
      surface_.point = read_vector(a, "a coordinate of the centre (m)");
  }
  if (surface_.surface != Surface::plane) {
    surface_.radius = a.number("the radius (m)", FixArguments::POSITIVE);
    surface_.inside = a.choice("the side the particles are on", "outside|inside") == 1;
  }

  read_keywords(a);
  check_arguments(a);
}

void FixPlaten::read_keywords(FixArguments &a) {
  bool stiffness = false, ratio = false;
  while (a.more()) {
    const bool modulus = a.next_is("modulus");
    if (modulus || a.next_is("stiffness_per_radius")) {
      if (stiffness)
        a.fail("the stiffness is given twice: use modulus or stiffness_per_radius once");
      stiffness = true;
      stiffness_.kind = modulus ? bondlab::PlatenStiffness::Kind::modulus
                                : bondlab::PlatenStiffness::Kind::per_radius;
      stiffness_.value = a.number(modulus ? "modulus (Pa)" : "stiffness_per_radius (N/m2)",
                                  FixArguments::POSITIVE);
    } else if (a.next_is("ratio")) {
      ratio_ = a.number("ratio (kn/ks)", FixArguments::POSITIVE);
      ratio = true;
    } else if (a.next_is("friction")) {
      friction_ = a.number("friction", FixArguments::NOT_NEGATIVE);
    } else if (a.next_is("touch")) {
      touch_ = true;
      touch_along_ = a.next_is("along");
      if (touch_along_)
        along_ = unit(a, read_vector(a, "a component of `touch along`"), "`touch along`");
    } else if (!motion_.read(a)) {
      a.unknown_keyword((std::string("touch, modulus, stiffness_per_radius, ratio, friction, ") +
                         FixMotion::keywords())
                            .c_str());
    }
  }
  if (!stiffness) a.fail("needs a stiffness: `modulus E` (Pa) or `stiffness_per_radius K` (N/m2)");
  if (friction_ > 0.0 && !ratio) a.fail("friction needs `ratio kn/ks` as well");
  motion_.check(a);
}

void FixPlaten::check_arguments(const FixArguments &a) const {
  if (domain->dimension != 2) return;
  const Vec3 d = surface_.direction;
  if (surface_.surface == Surface::sphere) a.fail("a sphere can't be used in 2D, use `cylinder z`");
  if (surface_.surface == Surface::cylinder && (d.x != 0.0 || d.y != 0.0))
    a.fail("the axis of a cylinder must be z in 2D");
  if (surface_.surface == Surface::plane && d.z != 0.0)
    a.fail("the normal of a plane must have no z component in 2D");
  if (along_.z != 0.0) a.fail("`touch along` must have no z component in 2D");
}

// ---- per-particle arrays ----

void FixPlaten::grow_arrays(int nmax) {
  memory->grow(history_, nmax, kHistory, "platen:history");
  memory->grow(touching_, nmax, "platen:touching");
}

void FixPlaten::note_touching(int i) {
  const double *normal = history_[i] + 3;
  touching_[i] = normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0;
}

void FixPlaten::copy_arrays(int i, int j, int) {
  std::copy(history_[i], history_[i] + kHistory, history_[j]);
  touching_[j] = touching_[i];
}

void FixPlaten::set_arrays(int i) {
  std::fill(history_[i], history_[i] + kHistory, 0.0);
  touching_[i] = 0;
}

int FixPlaten::pack_exchange(int i, double *buf) {
  std::copy(history_[i], history_[i] + kHistory, buf);
  return kHistory;
}

int FixPlaten::unpack_exchange(int i, double *buf) {
  std::copy(buf, buf + kHistory, history_[i]);
  note_touching(i);
  return kHistory;
}

int FixPlaten::size_restart(int) { return kHistory + 1; }
int FixPlaten::maxsize_restart() { return kHistory + 1; }

int FixPlaten::pack_restart(int i, double *buf) {
  buf[0] = kHistory + 1;
  std::copy(history_[i], history_[i] + kHistory, buf + 1);
  return kHistory + 1;
}

void FixPlaten::unpack_restart(int i, int which) {
  const double *extra = atom->extra[i];
  int at = 0;
  for (int k = 0; k < which; k++) at += static_cast<int>(extra[at]);
  std::copy(extra + at + 1, extra + at + 1 + kHistory, history_[i]);
  note_touching(i);
}

double FixPlaten::memory_usage() {
  return static_cast<double>(atom->nmax) * (kHistory * sizeof(double) + 2);
}

// ---- state of the platen ----

namespace {
// What a restart file holds of a platen.
struct PlatenState {
  double surface;  // to recognise another platen of the same name
  double placed, touch_shift;
  double motion[FixMotion::state_size];
  double force[3];
};
}  // namespace

void FixPlaten::write_restart(FILE *fp) {
  if (comm->me != 0) return;
  PlatenState state = {};
  state.surface = static_cast<double>(surface_.surface);
  state.placed = placed_ ? 1.0 : 0.0;
  state.touch_shift = touch_shift_;
  const std::vector<double> motion = motion_.state();
  std::copy(motion.begin(), motion.end(), state.motion);
  std::copy(force_, force_ + 3, state.force);
  const int size = sizeof state;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&state, sizeof state, 1, fp);
}

void FixPlaten::restart(char *buf) {
  PlatenState state;
  std::memcpy(&state, buf, sizeof state);
  if (state.surface != static_cast<double>(surface_.surface))
    stop_with_error(lmp, this, "the restart file holds a platen of this name with another surface");
  placed_ = state.placed != 0.0;
  touch_shift_ = state.touch_shift;
  motion_.set_state(state.motion);
  std::copy(state.force, state.force + 3, force_);
  stand();
}
