// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_drive.h.
#include "fix_drive.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "comm.h"
#include "fix_arguments.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using bondlab::DriveEvent;
using bondlab::DriveState;

FixDrive::FixDrive(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;

  FixArguments a(lmp, this, narg, arg);
  bool speed = false;
  while (a.more()) {
    if (a.next_is("speed")) {
      program_.speed = a.number("speed (m/s)", FixArguments::POSITIVE);
      speed = true;
    } else if (a.next_is("ramp")) {
      program_.ramp = a.number("ramp (s)", FixArguments::NOT_NEGATIVE);
    } else if (a.next_is("load")) {
      load_.reset(new FixValueSource(lmp, this, a.word("the load")));
    } else if (a.next_is("at")) {
      read_event(a, DriveEvent::Trigger::displacement);
    } else if (a.next_is("at_load")) {
      read_event(a, DriveEvent::Trigger::load);
    } else if (a.next_is("cycles")) {
      read_cycles(a);
    } else {
      a.unknown_keyword("speed, ramp, load, at, at_load, cycles");
    }
  }
  if (program_.events.size() > bondlab::DriveProgram::most_events)
    a.fail("has " + std::to_string(program_.events.size()) + " events, at most " +
           std::to_string(bondlab::DriveProgram::most_events) + " are possible");
  if (!speed) a.fail("needs `speed V` (m/s)");
  if (program_.needs_load() && !load_)
    a.fail("at_load, keep and unload need `load VALUE`, for instance v_load");
  program_.start(state_);
}

void FixDrive::read_event(FixArguments &a, DriveEvent::Trigger trigger) {
  DriveEvent e;
  e.trigger = trigger;
  e.where = a.number(trigger == DriveEvent::Trigger::load ? "the load of an event"
                                                          : "the displacement of an event (m)");
  switch (a.choice("what happens there", "speed|hold|keep|unload|end")) {
    case 0:
      e.action = DriveEvent::Action::speed;
      e.value = a.number("the new speed (m/s)", FixArguments::POSITIVE);
      break;
    case 1:
      e.action = DriveEvent::Action::hold;
      e.value = a.number("the time to hold (s)", FixArguments::NOT_NEGATIVE);
      break;
    case 2:
      e.action = DriveEvent::Action::keep;
      e.value = a.number("the time to keep the load (s)", FixArguments::NOT_NEGATIVE);
      if (!a.next_is("gain")) a.fail("keep needs `gain G` (m/s per unit of load) after the time");
      e.gain = a.number("gain", FixArguments::POSITIVE);
      if (!a.next_is("vmax")) a.fail("keep needs `vmax V` (m/s) after the gain");
      e.limit = a.number("vmax (m/s)", FixArguments::POSITIVE);
      e.load_given = a.next_is("value");
      if (e.load_given) e.load = a.number("the load to keep");
      break;
    case 3:
      e.action = DriveEvent::Action::unload;
      e.value = a.number_in("the share of the load to unload to", 0.0, 1.0);
      break;
    default:
      e.action = DriveEvent::Action::end;
  }
  // a hold or a load kept for no time is left out, so that a deck can switch it off by a number
  const bool timed = e.action == DriveEvent::Action::hold || e.action == DriveEvent::Action::keep;
  if (!timed || e.value > 0.0) program_.events.push_back(e);
}

void FixDrive::read_cycles(FixArguments &a) {
  const double count = a.number("the number of cycles", FixArguments::NOT_NEGATIVE);
  if (count != static_cast<int>(count)) a.fail("the number of cycles must be an integer");
  if (!a.next_is("every")) a.fail("cycles needs `every F` (load between two) after the number");
  DriveEvent e;
  e.trigger = DriveEvent::Trigger::load;
  e.action = DriveEvent::Action::unload;
  const double every = a.number("the load between two cycles");
  if (!a.next_is("to")) a.fail("cycles needs `to S` (share of the load) after `every F`");
  e.value = a.number_in("the share of the load to unload to", 0.0, 1.0);
  for (int k = 1; k <= count; k++) {
    e.where = k * every;
    program_.events.push_back(e);
  }
}

int FixDrive::setmask() { return INITIAL_INTEGRATE; }

void FixDrive::init() {
  if (load_) load_->init(1);
}

void FixDrive::setup(int) {
  if (!clock_.started()) clock_.start(0.0, update->ntimestep, update->dt);
  if (load_) modify->addstep_compute_all(update->ntimestep + 1);
}

void FixDrive::initial_integrate(int) {
  double load = 0.0;
  if (load_ && program_.needs_load(state_)) {
    modify->clearstep_compute();
    load = load_->evaluate();
    modify->addstep_compute(update->ntimestep + 1);
  }
  const double before = clock_.now;
  clock_.advance(update->ntimestep, update->dt);
  program_.advance(state_, clock_.now, clock_.now - before, load);
}

void FixDrive::reset_timestep(bigint to, bigint from) { clock_.renumber(to, from); }

double FixDrive::compute_vector(int n) {
  const double values[] = {state_.displacement, state_.speed, state_.phase,
                           state_.phase == DriveState::ended ? 1.0 : 0.0, state_.excused};
  return values[n];
}

void FixDrive::write_restart(FILE *fp) {
  if (comm->me != 0) return;
  const int size = sizeof state_ + sizeof clock_;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&state_, sizeof state_, 1, fp);
  fwrite(&clock_, sizeof clock_, 1, fp);
}

void FixDrive::restart(char *buf) {
  std::memcpy(&state_, buf, sizeof state_);
  std::memcpy(&clock_, buf + sizeof state_, sizeof clock_);
}
