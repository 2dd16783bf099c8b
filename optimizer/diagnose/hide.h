// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: laboratory data out of the engine in which one or two effects are hidden, as a data folder.
// Method: every test of the study is run with the effects on, at parameters drawn about the study's
//   starts, on packings far from those that a fit uses (offset 1000 and the seed), one a replicate.
//   Load and strain carry what sensors add: a gain a specimen and a jitter a point; errors of
//   measuring that an effect's file names come before that, the specimens taken in the order of the
//   series. Each series' conditions (strain rate of axial tests, confinement, temperature, size) are
//   those that the study asks for. The truth goes into sealed_truth.json beside the data, which
//   diagnose never opens.
// Units: SI. Failure: UserError for an effect that no test shows; a run that fails is an error.
// Limits: two calls whose seeds differ by less than the replicates share no packing: seeds are a
//   hundred packings apart.
#pragma once

#include <filesystem>

#include "diagnose/study_diagnosis.h"

namespace bondlab::diagnose {

struct HideOptions {
  std::vector<std::string> effects;  // none: a null case
  std::vector<double> sizes;         // SI, one an effect
  std::uint64_t seed = 1;
  int replicates = 4;
  double spread = 0.3;  // sd of the parameters about their starts, in z
};

// Parameters in a data folder's sealed truth, in the study's order, SI. Nothing but a trial's
// judgement calls this.
std::vector<double> sealed_parameters(const std::filesystem::path &folder, const Study &study);

// Largest size of an effect that every deck of the study takes, SI.
double admissible_size(const Study &study, const EffectDefinition &effect);

void hide_effect(const Study &study, const std::vector<EffectDefinition> &effects,
                 const ModelFactory &model, const HideOptions &options,
                 const std::filesystem::path &out,
                 const std::function<void(const BatchProgress &)> &progress = {});

}  // namespace bondlab::diagnose
