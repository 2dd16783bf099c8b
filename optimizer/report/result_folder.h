// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what lies in a result's directory besides the fit's own result: the runs made and the
//   figures of the packings.
// Method: runs/*/manifest.json and specimens/SHAPE-KEY.json are read as they stand. The files are
//   the record: they move with the directory and need neither the study nor the store.
// Units: SI.
// Failure: none; a file that is missing or damaged is left out, since the result stands without it.
#pragma once

#include <filesystem>
#include <vector>

#include "report/report.h"
#include "study/study.h"

namespace bondlab {

// Runs that ended by themselves, well or not, by their number. Runs that were cut off were made
// again and are left out.
std::vector<ReportRun> read_ledger(const std::filesystem::path &directory);

// The study's specimens, with particle count, radii as packed, porosity and coordination where the
// packing is there.
std::vector<ReportSpecimen> read_specimens(const Study &study,
                                           const std::filesystem::path &directory);

}  // namespace bondlab
