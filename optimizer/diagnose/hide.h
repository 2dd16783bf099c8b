// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: laboratory data out of the engine in which an effect is hidden, as a data folder.
// Method: every test of the study is run with the effect on, at parameters drawn about the study's
//   starts, on packings far from those that a fit uses (offset 1000 and the seed), one a replicate.
//   Load and strain carry what sensors add: a gain a specimen and a jitter a point. The truth goes
//   into sealed_truth.json beside the data, which diagnose never opens.
// Units: SI. Failure: UserError for an effect that no test shows; a run that fails is an error.
// Limits: two calls whose seeds differ by less than the replicates share no packing: seeds are a
//   hundred packings apart.
#pragma once

#include <filesystem>

#include "diagnose/study_diagnosis.h"

namespace bondlab::diagnose {

struct HideOptions {
  std::string effect;  // empty: none, a null case
  double size = 0;     // SI
  std::uint64_t seed = 1;
  int replicates = 4;
  double spread = 0.3;  // sd of the parameters about their starts, in z
};

void hide_effect(const Study &study, const std::vector<EffectDefinition> &effects,
                 const ModelFactory &model, const HideOptions &options,
                 const std::filesystem::path &out,
                 const std::function<void(const BatchProgress &)> &progress = {});

}  // namespace bondlab::diagnose
