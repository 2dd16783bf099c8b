// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the diagnosis of a study from its data to the gap that the named effect closes.
// Method: emulator of the parameters at the start -> fit, and the centre moved after it until the
//   fit lies within the steps made -> every effect switched on there -> what the tests cannot tell
//   apart (isolability, from the model and the plan, no residual used) -> null -> diagnose() on all
//   series but the one held out -> the engine itself at the fits before and after -> the gap.
//   The held-out series is fixed before anything runs: the one named, else the last of five or
//   more, else none. The gap is the root mean square of the whitened rows, in noise units; the gain
//   realised is that of the engine, the one predicted that of the score. The placebo has the trace
//   of the first effect named with the signs of its rows drawn at random, so that it has the same
//   freedom and size; the mean over 200 such draws stands.
// Units: SI. Failure: UserError for names that aren't there; runs that fail are NaN rows.
// Limits: one effect or pair a call: run it again on the new study for the next.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "diagnose/cross_gap.h"
#include "diagnose/diagnose.h"
#include "diagnose/isolability.h"
#include "diagnose/scatter_block.h"
#include "diagnose/study_evidence.h"
#include "diagnose/study_model.h"

namespace bondlab::diagnose {

struct StudyDiagnosisOptions {
  int packings = 6;  // that differences are taken on
  int scatter = 40;  // that the simulation's mean is over, and its scatter
  std::string holdout;
  std::uint64_t seed = 1;
};

struct Gap {  // NaN: not to be had
  double before = 0, after = 0, holdout_before = 0, holdout_after = 0, placebo_after = 0,
         noise_floor = 0;
};

struct SeriesGap {
  std::string name;
  bool held_out = false;
  double before = 0, after = 0;
  int rows = 0;
};

struct ShownSeries {
  std::string name;
  std::vector<Curve> measured;
  Curve before, after;  // empty when the run failed
};

struct StudyDiagnosis {
  Diagnosis diagnosis;
  std::vector<EffectDefinition> effects;
  std::vector<EffectEntry> catalogue;
  std::string holdout;  // empty: none
  std::vector<Confusable> isolability;
  std::vector<double> trace_noise;  // share of each effect's trace at switch-on that is noise
  std::vector<std::string> hidden;  // effects that these tests cannot show
  std::vector<double> parameters_before, parameters_after;
  std::vector<double> sd_before, sd_after;  // physical, linear
  std::vector<double> sizes;                // of all effects, after
  Gap gap;
  CrossGap cross;                         // of what was named, every series held out in turn
  double confirmed_gain = 0;              // in chi squared, of the engine's own rows; NaN: not run
  std::vector<double> z_before, z_after;  // parameters, transformed
  std::vector<SeriesGap> by_series;
  std::vector<RowKey> rows;  // those diagnosed
  ScatterTest scatter;       // of specimens' strengths against packings'
  std::vector<ShownSeries> shown;
  std::vector<std::string> advice;
  // Names by largest residual, BIC and LASSO (comparators.h) on the same rows.
  std::vector<std::vector<std::size_t>> others;
  int runs = 0;
};

struct StudySinks {
  std::function<void(const BatchProgress &)> progress;
  std::function<void(const std::string &)> say;  // a line for a person, as things are known
};

StudyDiagnosis diagnose_study(const Study &study, const std::vector<EffectDefinition> &effects,
                              const ModelFactory &model, const StudyDiagnosisOptions &options,
                              const StudySinks &sinks = {});

// Takes effects whose change at switch-on is lost in the plan's noise at a size that is not, and
// those far above it at a smaller one: what is near the noise is where a name is in doubt.
void scale_to_noise(StudyModel &model, Prober &prober, const Evidence &evidence,
                    const std::function<void(const std::string &)> &say);

// The same for data of a plan that `model` was made for, with its effects added. `confirm`: the
// engine is run at the fits; else the emulator's word stands for it.
StudyDiagnosis diagnose_measured(StudyModel &model, std::vector<MeasuredSeries> series,
                                 const StudyDiagnosisOptions &options, bool confirm = true,
                                 const StudySinks &sinks = {});

}  // namespace bondlab::diagnose
