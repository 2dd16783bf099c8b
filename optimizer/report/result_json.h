// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: result.json, the machine-readable result of a study: everything the report shows, for other
//   programs and for `bondlab report`.
// Method: one JSON object. The first fit stands at the top (`targets`, `parameters`, `runs`,
//   `packings`, `replay` ...), the second under `tradeoff` in the same shape, any further under
//   `more_fits`. Numbers are written so that they read back to the same bits; NaN is null. Written
//   to a temporary file that is renamed, so that no half of a result is ever seen.
// Units: each number with a `unit` beside it is in that unit, everything else in SI.
// Failure: UserError with the file, and the key where one is missing or of another type, or another
//   format version.
#pragma once

#include <filesystem>
#include <string>

#include "report/report.h"

namespace bondlab {

// The JSON text, two blanks a level, keys in a fixed order.
std::string to_json(const ReportInput &input);
ReportInput from_json(const std::string &text, const std::string &file);

// DIRECTORY/result.json. Returns the path.
std::filesystem::path write_result(const ReportInput &input,
                                   const std::filesystem::path &directory);
ReportInput read_result(const std::filesystem::path &directory);

}  // namespace bondlab
