// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the diagnosis put to the test on the engine: every case of a hidden set made, diagnosed and
//   judged.
// Method: one StudyModel of the laboratory, catalogue and outsiders side by side, is made once
// about
//   the study's start; effects are taken at sizes that rise above the noise of the plan. A case's
//   sizes follow from its noise units (sizing.h), counted in what the laboratory's own specimens
//   scatter where nothing is hidden; an effect whose largest size gives less is hidden at that size
//   and the units it has are told. Data are made by hide_effect() and read back from their folder;
//   for the diagnosis the outsiders' admissible size is zero, and that of an effect left out of the
//   catalogue. What a case costs anew is its data, effects beyond the sizes run, and the engine at
//   the fits before and after.
// Judged: `right`: the one name hidden (of a pair: both, and no other); `in_set`: offered with
//   others; `outside`: not in the catalogue; `nothing`; else `wrong`.
// Source: sizes and judgement as in the closed-form benchmark (benchmark.h).
// Units: sizes SI. Failure: UserError for effects that nobody knows; a case that can't be made
//   is told and left out. Runs are kept: a trial that was cut off goes on with the same command.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "diagnose/hidden_set.h"
#include "diagnose/hide.h"

namespace bondlab::diagnose {

enum class Judgement { right, in_set, wrong, outside, nothing };
std::string to_string(Judgement judgement);

// `outside`: the diagnosis said "not in the catalogue".
Judgement judge(const std::vector<std::string> &hidden, const std::vector<std::string> &named,
                bool outside);

struct TrialCase {
  HiddenCase hidden;
  std::vector<double> sizes;  // SI
  std::vector<double> units;  // reached
  Verdict verdict = Verdict::nothing;
  Judgement judgement = Judgement::nothing;
  std::vector<std::string> named;
  std::vector<double> named_sizes;
  double margin = 0, p_trace = 1, p_omnibus = 1;
  double trace = 0, trace_alarm = 0, omnibus = 0, omnibus_alarm = 0;
  std::vector<Spot> where;
  Gap gap;
  CrossGap cross;
  double predicted_gain = 0, confirmed_gain = 0;
  double p_scatter = 1;  // scatter_block.h
  // (estimate - truth) / sd, one a parameter.
  std::vector<double> off_before, off_after;
  int parameters = 0, inside_before = 0, inside_after = 0;  // of the 95 % intervals
  // Names that others give on the same rows: largest residual, BIC, LASSO.
  std::vector<std::vector<std::string>> others;
  std::vector<Judgement> others_judged;
  int new_runs = 0;
};

struct TrialOptions {
  std::filesystem::path out;      // data of the cases go to out/data
  std::vector<std::string> only;  // ids; empty: all
  bool confirm = false;           // run the engine at the fits before and after
  StudyDiagnosisOptions diagnosis;
  std::function<void(const BatchProgress &)> progress;
};

// The engine of a study with results in a folder below out.
using EngineIn = std::function<ModelFactory(const std::filesystem::path &)>;

std::vector<TrialCase> run_trial(const HiddenSet &set, const Study &laboratory,
                                 const std::vector<EffectDefinition> &catalogue,
                                 const std::vector<EffectDefinition> &outside,
                                 const EngineIn &engine, const TrialOptions &options,
                                 const std::function<void(const std::string &)> &say,
                                 const std::function<void(const TrialCase &)> &done);

}  // namespace bondlab::diagnose
