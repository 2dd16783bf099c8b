// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a diagnosis as files: diagnosis.json for programs, diagnosis.txt and diagnosis.html for
//   people, model_with_effect.toml and model.diff when an effect was named.
// Method: JSON keys are those of the workflow: verdict, effects (name, size, interval, p, margin),
//   where, advice, gap (before, after, holdout_before, holdout_after, placebo_after, noise_floor),
//   parameters (name, unit, before, after, with their sd); what could not be had is null. Paths in
//   the new model are such that it reads where it lies. The page draws with SVG of its own, no program needed.
// Units: sizes in SI; gaps in noise units. Failure: UserError when a file can't be written.
#pragma once

#include <filesystem>

#include "diagnose/study_diagnosis.h"

namespace bondlab::diagnose {

std::string diagnosis_json(const Study &study, const StudyDiagnosis &d);
std::string diagnosis_text(const Study &study, const StudyDiagnosis &d);
std::string diagnosis_page(const Study &study, const StudyDiagnosis &d);
// The file of the new model; empty when there is none.
std::filesystem::path write_diagnosis(const Study &study, const StudyDiagnosis &d,
                                      const std::filesystem::path &out);

}  // namespace bondlab::diagnose
