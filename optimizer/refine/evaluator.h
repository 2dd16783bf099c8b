// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: from parameter points to the figures of all targets, in batches, each run asked for once in
//   a session.
// Method: a batch of points and the targets wanted becomes one batch of forward requests: one a
//   test, point and packing that was not asked for before, keyed by the exact bits of the physical
//   values. Everything above (design, Jacobian, Marquardt, a second fit with more targets) goes
//   through here, so that no run is made twice even beneath a solver that asks for the same point
//   again, and every run ever made can serve as evidence. A figure of an envelope needs the runs of
//   all its tests and is had once the last of them is there.
// Units: SI. Failure: a run that failed, or a curve that a response refuses, is a value with a
//   reason. FitFailed when more runs failed than the study allows; UserError and Interrupted of the
//   forward model pass through.
// Limits: outcomes with their curves stay in memory (some 200 kB a run).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "forward/forward_model.h"
#include "misfit/residual.h"
#include "refine/fit_result.h"
#include "response/envelope.h"
#include "study/parameter_space.h"
#include "study/study.h"

namespace bondlab {

// Too many forward runs failed, or none that a fit could start from. The text says which and where
// they are kept.
class FitFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using TargetIndices = std::vector<std::size_t>;  // into Study::targets

class Evaluator {
 public:
  using Progress = std::function<void(const BatchProgress &)>;

  // All three must outlive the evaluator.
  Evaluator(const Study &study, const ParameterSpace &space, ForwardModel &model);

  const Study &study() const { return study_; }
  const ParameterSpace &space() const { return space_; }

  // Makes what is missing so that every target of `targets` is known at every point. `phase` labels
  // new points.
  void run(const std::vector<TransformedPoint> &points, const TargetIndices &targets,
           const std::string &phase, int packing = 0);
  // The same for several packings in one batch.
  void run(const std::vector<TransformedPoint> &points, const std::vector<int> &packings,
           const TargetIndices &targets, const std::string &phase);

  // A figure that run() has made before; "not run" otherwise.
  ResponseValue value(const TransformedPoint &point, std::size_t target, int packing = 0) const;

  // Whether every target of the list could be had at the point.
  bool complete(const TransformedPoint &point, const TargetIndices &targets, int packing = 0) const;

  // The outcome of one test; nullptr when it was not run.
  const ForwardOutcome *outcome(const TransformedPoint &point, const std::string &test,
                                int packing = 0) const;

  // The envelope through those of its tests that were run; nothing when none was.
  std::optional<StrengthEnvelope> envelope(const TransformedPoint &point, const EnvelopeEntry &entry,
                                           int packing = 0) const;

  // Points of packing 0 in the order they were first asked for.
  const std::vector<TransformedPoint> &points() const { return points_; }

  std::vector<LedgerPoint> ledger() const;
  FitCounts counts() const { return counts_; }
  const std::vector<Failure> &failures() const { return failures_; }

  void set_progress(Progress progress) { progress_ = std::move(progress); }

 private:
  using Key = std::tuple<std::string, int, std::vector<double>>;  // test, packing, physical values

  struct Run {
    ForwardOutcome outcome;
    std::map<std::string, ResponseValue> responses;  // by target name; those of this test
  };

  Key key(const std::string &test, int packing, const TransformedPoint &point) const;
  void keep(const Key &key, ForwardOutcome outcome);
  void add_envelope_figures(const TransformedPoint &point, int packing);

  const Study &study_;
  const ParameterSpace &space_;
  ForwardModel &model_;
  Progress progress_;
  std::map<Key, Run> runs_;
  std::map<Key, ResponseValue> of_envelopes_;  // the key's name is the target's
  std::vector<TransformedPoint> points_;
  std::vector<std::string> phases_;                      // of points_
  std::map<std::vector<double>, std::size_t> position_;  // physical values -> index into points_
  std::vector<Failure> failures_;
  FitCounts counts_;
};

}  // namespace bondlab
