// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: turn what a fit found out (SI, with whole curves in memory) into what the report and
//   result.json hold.
// Method: numbers go into the units that the study shows them in; curves stay in the files of their
//   runs, named relative to the result's directory so that the directory can be moved; measured
//   curves are copied, because their folder may go.
// Units: SI in, shown units out.
// Failure: UserError when a target names a test or a response that isn't there (a study that
//   read_study() accepted never does).
#pragma once

#include <filesystem>

#include "refine/fit_result.h"
#include "report/report.h"
#include "study/study.h"

namespace bondlab {

// Everything but confirm_command, which is the caller's to give. `directory` is the result's: runs/
// and specimens/ in it give the ledger and the figures of the packings.
ReportInput report_input(const Study &study, const FitResult &result,
                         const std::filesystem::path &directory);

// With the study's targets for it as what was measured.
ReportEnvelope report_envelope(const Study &study, const StrengthEnvelope &envelope);

// The path as the report names it: relative to `directory` when it lies in it.
std::string path_in_result(const std::filesystem::path &path,
                           const std::filesystem::path &directory);

}  // namespace bondlab
