// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: everything a fit found out, as plain data: what report/ shows and result.json holds.
// Method: one FitResult a study, one SingleFit for each [[fits]] entry in the order they were run.
//   Every simulated figure comes from a run that was really made (its id stands beside it), never
//   from a regression.
// Units: SI; `unit` says how a person wants to see a quantity. NaN means "could not be had", with
//   the reason beside it.
// Failure: none; these are data.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "forward/forward_model.h"
#include "response/envelope.h"
#include "study/parameter_space.h"

namespace bondlab {

struct TargetResult {
  std::string name, test, envelope, response, unit;  // of test and envelope one is empty
  double measured = 0;
  double sd = 0;         // of the measurement
  double tolerance = 0;  // |simulated - measured| that counts as met
  double simulated = 0;  // NaN: the run or the response failed, see `why_missing`
  double noise_sd =
      0;  // scatter of the simulated figure under tiny changes of the parameters; NaN: not measured
  double packing_mean = 0, packing_sd = 0;  // over the other packings; NaN: fewer than 1, 2 of them
  bool in_fit = false;                      // false: predicted
  bool met = false;
  std::string why_missing;
  std::string source, sd_source;
  double off() const { return simulated / measured - 1; }           // relative
  double off_in_sd() const { return (simulated - measured) / sd; }  // standardised
};

struct ParameterResult {
  std::string name, unit;
  double value = 0;
  double sd = 0;  // NaN: not identifiable
  double interval_lower = 0,
         interval_upper = 0;    // 95 %, from transformed space, inside the bounds; NaN with sd
  double lower = 0, upper = 0;  // bounds
  BoundSide at_bound = BoundSide::none;
  bool identifiable = true;
  std::string reason;  // in words: why not identifiable, what the data say at a bound
};

struct HistoryEntry {
  int runs = 0;             // different forward runs asked for until then, of this fit
  double wall_seconds = 0;  // since this fit began
  std::string phase;        // design, noise, refine, polish
  double misfit =
      0;  // sum of squares of the standardised differences, prior left out; NaN: failed point
  double best_misfit = 0;
  bool accepted = false;
  std::vector<double> parameters;  // physical
  std::string note;
};

struct PackingScatter {
  std::string target, unit;
  double reference = 0;        // on the packing used in the fit
  std::vector<double> values;  // one a packing that worked
  double mean = 0, sd = 0;     // NaN: fewer than 1, 2 values
  int failed = 0;
};

struct TestOutcome {
  std::string test;
  ForwardOutcome outcome;  // the curve included
  std::map<std::string, double>
      quality;  // figures of response/: platen_imbalance, tangent_modulus_platen ...
};

enum class FindingKind {
  unreachable_target,  // no run reached the measured value
  unreachable_ratio,   // no run reached the measured ratio of two targets: they exclude each other
  joint_misfit,        // each can be met, all together cannot
  ridge,               // a direction in parameter space that the data do not fix
  at_bound,
  quality,   // e.g. platens out of balance
  failure,   // forward runs that failed and what was done
  reachable  // for the record: the span of a target over all runs
};

struct Finding {
  FindingKind kind = FindingKind::reachable;
  std::string text;  // plain words, units included
  std::vector<std::string> targets;
  double measured = 0, low = 0,
         high = 0;  // the measured figure or ratio and its span over all runs
  int points = 0;   // parameter sets behind the span
};

struct FitCounts {
  int forward = 0;     // different runs asked for
  int from_store = 0;  // of these, taken from the store
  int failed = 0;
  double wall_seconds = 0;  // of this call
  double run_seconds = 0;   // sum over the runs
};

struct SingleFit {
  std::string name;
  bool converged = false;             // the gradient is zero within the noise of the responses
  bool all_met = false;               // every target in the fit is met
  std::string verdict;                // one or two sentences a person reads first
  double misfit = 0;                  // as in HistoryEntry
  int degrees_of_freedom = 0;         // targets in the fit minus parameters
  std::vector<TargetResult> targets;  // those in the fit, then those predicted
  std::vector<ParameterResult> parameters;
  std::vector<std::vector<double>>
      correlation;  // of the parameters in transformed space; empty: not known
  std::vector<HistoryEntry> history;
  std::vector<PackingScatter> packings;
  std::vector<TestOutcome> best;  // one a test, on the packing used in the fit
  std::vector<StrengthEnvelope> envelopes;  // the study's, through the tests of `best`
  std::vector<Finding> findings;
  std::vector<std::string> notes;  // what was done and why, plain words, in order
  FitCounts runs;
};

// One parameter set with what came out, for scatter plots and evidence.
struct LedgerPoint {
  std::string phase;
  std::vector<double> parameters;           // physical
  std::map<std::string, double> responses;  // by target name; only those that could be had
};

struct FitResult {
  std::string study, title, study_file;
  std::string tolerance_text;  // what "met" means, in words
  std::vector<std::string> parameter_names, parameter_units;
  std::vector<SingleFit> fits;
  std::vector<LedgerPoint> ledger;  // all parameter sets run on the packing of the fit
  FitCounts runs;                   // of all fits together
  std::string replay;               // the command that repeats the whole
};

}  // namespace bondlab
