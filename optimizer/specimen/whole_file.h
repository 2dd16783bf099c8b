// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a file appears with its whole text or not at all.
// Method: the text goes to a temporary file of this process in the same directory, is flushed to
//   the disk and renamed.
// Units: none.
// Failure: UserError with the path and the system's reason; the temporary file is removed.
#pragma once

#include <filesystem>
#include <string>

namespace bondlab {

void write_specimen_file(const std::filesystem::path &path, const std::string &text);

}  // namespace bondlab
