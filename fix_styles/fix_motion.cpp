// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_motion.h.
#include "fix_motion.h"

#include <algorithm>
#include <cmath>

#include "domain.h"
#include "fix_arguments.h"
#include "fix_drive.h"
#include "modify.h"
#include "platen_motion.h"
#include "update.h"

using namespace LAMMPS_NS;

FixMotion::FixMotion(LAMMPS *lmp, Fix *owner)
    : Pointers(lmp),
      owner_(owner),
      drive_(NULL),
      way_{0, 0, 0},
      ramp_(0.0),
      prescribed_(false),
      at_rest_(false),
      servo_(-1),
      servo_force_(0.0),
      servo_gain_(0.0),
      servo_limit_(0.0),
      mass_(0.0),
      frame_(false),
      free_{false, false, false},
      frame_stiffness_(0.0),
      frame_damping_(1.0),
      moved_{0, 0, 0},
      velocity_{0, 0, 0},
      step_{0, 0, 0} {}

bool FixMotion::read(FixArguments &a) {
  if (a.next_is("velocity")) {
    if (prescribed_) a.fail("velocity or follow is given twice");
    prescribed_ = true;
    for (double &s : way_) s = a.number("a component of the velocity (m/s)");
    if (a.next_is("ramp")) ramp_ = a.number("ramp (s)", FixArguments::NOT_NEGATIVE);
  } else if (a.next_is("follow")) {
    if (prescribed_) a.fail("velocity or follow is given twice");
    prescribed_ = true;
    drive_name_ = a.word("the id of a fix drive to follow");
    for (double &s : way_) s = a.number("a component of the share of the drive's displacement");
  } else if (a.next_is("servo")) {
    servo_ = a.choice("the force of the servo", "fx|fy|fz");
    servo_force_ = a.number("the force of the servo (N)");
    if (!a.next_is("gain")) a.fail("servo needs `gain G` (m/s per N) after the force");
    servo_gain_ = a.number("gain (m/s per N)", FixArguments::POSITIVE);
    if (!a.next_is("vmax")) a.fail("servo needs `vmax V` (m/s) after the gain");
    servo_limit_ = a.number("vmax (m/s)", FixArguments::POSITIVE);
  } else if (a.next_is("free")) {
    if (dynamic()) a.fail("free or frame is given twice");
    mass_ = a.number("the mass of a free body (kg)", FixArguments::POSITIVE);
    const char *names[] = {"x", "y", "z"};
    int chosen = -1;
    for (int c = 0; c < 3; c++)
      if (chosen < 0 && a.next_is(names[c])) chosen = c;
    for (int c = 0; c < 3; c++)
      free_[c] = chosen < 0 ? c < domain->dimension : c == chosen;
  } else if (a.next_is("frame")) {
    if (dynamic()) a.fail("free or frame is given twice");
    frame_stiffness_ = a.number("the stiffness of the frame (N/m)", FixArguments::NOT_NEGATIVE);
    if (!a.next_is("mass")) a.fail("frame needs `mass M` (kg) after the stiffness");
    const double mass = a.number("the mass on the frame (kg)", FixArguments::POSITIVE);
    frame_ = frame_stiffness_ > 0.0;
    if (frame_) mass_ = mass;
    if (a.next_is("damping"))
      frame_damping_ = a.number("the damping of the frame", FixArguments::NOT_NEGATIVE);
  } else if (a.next_is("at_rest")) {
    at_rest_ = true;
  } else {
    return false;
  }
  return true;
}

void FixMotion::check(const FixArguments &a) const {
  if (at_rest_ && (prescribed_ || servo_ >= 0 || dynamic()))
    a.fail("at_rest can't be used with velocity, follow, servo, free or frame");
  if (servo_ >= 0 && way_[servo_] != 0.0)
    a.fail("velocity and servo are both given for the same direction");
  if (servo_ >= 0 && dynamic()) a.fail("servo can't be used with free or frame");
  if (frame_ && !prescribed_) a.fail("frame needs velocity or follow: the way of its drive");
  if (dynamic() && !frame_ && (!drive_name_.empty() || ramp_ > 0.0))
    a.fail("a free body has a velocity at the start, no ramp and no drive");
  if (domain->dimension == 2 && (way_[2] != 0.0 || servo_ == 2 || (!frame_ && free_[2])))
    a.fail("can't move along z in 2D");
}

void FixMotion::init() {
  if (frame_) {
    const double limit = 2.0 * std::sqrt(mass_ / frame_stiffness_);
    if (!(update->dt < 0.5 * limit))
      stop_with_error(lmp, owner_,
                      "keyword frame: the time step " + std::to_string(update->dt) +
                          " s is above half of the frame's limit 2 sqrt(M/K) = " +
                          std::to_string(limit) + " s; give a larger mass");
  }
  drive_ = NULL;
  if (drive_name_.empty()) return;
  const int self = modify->find_fix(owner_->id);
  const int found = modify->find_fix(drive_name_.c_str());
  if (found >= 0) drive_ = dynamic_cast<FixDrive *>(modify->fix[found]);
  if (!drive_)
    stop_with_error(lmp, owner_, "follow: there is no fix drive with the id '" + drive_name_ + "'");
  if (found > self)
    stop_with_error(lmp, owner_,
                    "follow: fix drive '" + drive_name_ + "' must be defined before this fix");
}

void FixMotion::start(bigint step, double dt) {
  clock_.start(0.0, step, dt);
  for (int c = 0; c < 3; c++)
    if (!frame_ && free_[c]) velocity_[c] = way_[c];
}

double FixMotion::prescribed_place(int c) const {
  return way_[c] *
         (drive_ ? drive_->displacement() : bondlab::ramp_distance(clock_.now, ramp_));
}

double FixMotion::prescribed_speed(int c) const {
  return way_[c] * (drive_ ? drive_->speed() : bondlab::ramp_speed(clock_.now, ramp_));
}

double FixMotion::acceleration(int c, double force) const {
  if (!frame_) return force / mass_;
  const double dashpot = 2.0 * frame_damping_ * std::sqrt(frame_stiffness_ * mass_);
  return (force + frame_stiffness_ * (prescribed_place(c) - moved_[c]) +
          dashpot * (prescribed_speed(c) - velocity_[c])) /
         mass_;
}

void FixMotion::advance(bigint step, double dt, const double *force) {
  if (dynamic())  // first half of the kick, with the drive still where it was
    for (int c = 0; c < 3; c++)
      if (dynamic(c)) velocity_[c] += 0.5 * dt * acceleration(c, force[c]);
  clock_.advance(step, dt);
  for (int c = 0; c < 3; c++) {
    double to;
    if (c == servo_) {
      velocity_[c] = bondlab::servo_speed(force[c], servo_force_, servo_gain_, servo_limit_);
      to = moved_[c] + velocity_[c] * dt;
    } else if (dynamic() && dynamic(c)) {
      to = moved_[c] + velocity_[c] * dt;
    } else if (dynamic() && !frame_) {
      to = moved_[c];  // guided: doesn't move across the free direction
    } else {
      to = prescribed_place(c);
    }
    step_[c] = to - moved_[c];
    moved_[c] = to;
  }
}

void FixMotion::finish(double dt, const double *force) {
  if (!dynamic()) return;
  for (int c = 0; c < 3; c++)
    if (dynamic(c)) velocity_[c] += 0.5 * dt * acceleration(c, force[c]);
}

double FixMotion::speed(int c) const {
  if (c == servo_ || (dynamic() && dynamic(c))) return velocity_[c];
  return dynamic() && !frame_ ? 0.0 : prescribed_speed(c);
}

std::vector<double> FixMotion::state() const {
  return {clock_.base, clock_.base_step, clock_.dt,    clock_.now,   clock_.step,
          moved_[0],   moved_[1],        moved_[2],    velocity_[0], velocity_[1],
          velocity_[2], started() ? 1.0 : 0.0};
}

void FixMotion::set_state(const double *s) {
  clock_.base = s[0];
  clock_.base_step = s[1];
  clock_.dt = s[2];
  clock_.now = s[3];
  clock_.step = s[4];
  std::copy(s + 5, s + 8, moved_);
  std::copy(s + 8, s + 11, velocity_);
}
