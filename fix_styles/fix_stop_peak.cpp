// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_stop_peak.h.
#include "fix_stop_peak.h"

#include <algorithm>
#include <cmath>

#include "comm.h"
#include "error.h"
#include "fix_arguments.h"
#include "modify.h"
#include "signal_handling.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using bondlab::PeakWatch;

FixStopPeak::FixStopPeak(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), stopped_(PeakWatch::go_on), ended_this_run_(false) {
  vector_flag = 1;
  size_vector = 2;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;

  FixArguments a(lmp, this, narg, arg);
  nevery = a.count("the number of steps between two looks");
  value_.reset(new FixValueSource(lmp, this, a.word("the value to watch")));
  bool drop = false, minimum = false;
  while (a.more()) {
    if (a.next_is("drop")) {
      watch_.drop = a.number_in("drop (fraction of the peak)", 0.0, 1.0);
      drop = true;
    } else if (a.next_is("min")) {
      watch_.minimum = a.number("min (unit of the value)", FixArguments::NOT_NEGATIVE);
      minimum = true;
    } else if (a.next_is("max_abs")) {
      second_.reset(new FixValueSource(lmp, this, a.word("the second value")));
      watch_.limit = a.number("the limit of the second value", FixArguments::NOT_NEGATIVE);
    } else if (a.next_is("unless")) {
      excuse_.reset(new FixValueSource(lmp, this, a.word("the value that excuses a fall")));
    } else {
      a.unknown_keyword("drop, min, max_abs, unless");
    }
  }
  if (!drop) a.fail("needs `drop FRACTION`");
  if (!minimum) a.fail("needs `min VALUE`, below which nothing counts as a peak");
}

int FixStopPeak::setmask() { return END_OF_STEP | POST_RUN; }

void FixStopPeak::init() {
  value_->init(nevery);
  if (second_) second_->init(nevery);
  if (excuse_) excuse_->init(nevery);
  ended_this_run_ = false;
}

void FixStopPeak::setup(int) {
  modify->addstep_compute_all((update->ntimestep / nevery) * nevery + nevery);
}

void FixStopPeak::end_of_step() {
  if (stopped_) return;
  modify->clearstep_compute();
  const double value = value_->evaluate();
  const bool excused = excuse_ && excuse_->evaluate() != 0.0;
  const double second = second_ ? std::fabs(second_->evaluate()) : 0.0;
  modify->addstep_compute(update->ntimestep + nevery);

  if (excused) {
    stopped_ = second_ && second > watch_.limit ? PeakWatch::limit_reached : PeakWatch::go_on;
  } else {
    stopped_ = second_ ? watch_.look(value, second) : watch_.look(value);
  }
  if (stopped_ == PeakWatch::go_on) return;
  if (comm->me == 0) {
    const char *form = "Fix stop/peak (id %s) ends the run at step " BIGINT_FORMAT ": %s\n";
    const char *why = stopped_ == PeakWatch::dropped ? "the value has dropped from its peak"
                                                     : "the second value is beyond its limit";
    if (screen) fprintf(screen, form, id, update->ntimestep, why);
    if (logfile) fprintf(logfile, form, id, update->ntimestep, why);
  }
  if (SignalHandler::request_quit) return;  // a signal was first: leave the flag to it
  ended_this_run_ = true;
  SignalHandler::request_quit = true;
}

void FixStopPeak::post_run() {
  if (!ended_this_run_) return;
  SignalHandler::request_quit = false;
  update->nsteps = static_cast<int>(update->ntimestep - update->firststep);  // for the statistics
}

std::string FixStopPeak::reason_of_end(LAMMPS *lmp) {
  struct Modules : protected Pointers {
    explicit Modules(LAMMPS *l) : Pointers(l) {}
    Modify *modify_of_run() { return modify; }
  };
  const Modify *modify = Modules(lmp).modify_of_run();
  for (int i = 0; i < modify->nfix; i++) {
    const FixStopPeak *stop = dynamic_cast<const FixStopPeak *>(modify->fix[i]);
    if (stop && stop->ended_this_run_)
      return stop->stopped_ == PeakWatch::dropped ? "stop_after_peak" : "stop_at_limit";
  }
  return SignalHandler::request_quit ? "" : "end_of_run";
}

double FixStopPeak::compute_vector(int n) { return n == 0 ? watch_.peak : stopped_; }

void FixStopPeak::write_restart(FILE *fp) {
  if (comm->me != 0) return;
  const double state[] = {watch_.peak, watch_.seen ? 1.0 : 0.0, static_cast<double>(stopped_)};
  const int size = sizeof state;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(state, sizeof state, 1, fp);
}

void FixStopPeak::restart(char *buf) {
  double state[3];
  std::copy(buf, buf + sizeof state, reinterpret_cast<char *>(state));
  watch_.peak = state[0];
  watch_.seen = state[1] != 0.0;
  stopped_ = static_cast<int>(state[2]);
}
