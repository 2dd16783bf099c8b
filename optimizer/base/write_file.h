// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a file appears with its whole text or not at all.
// Method: written beside its place under a name of this process, then renamed. Not flushed to the
// disk: for files whose
//   loss in a power cut only means doing a run again (the run store has the last word).
// Units: none. Failure: UserError with the file and the system's reason; nothing is left behind.
#pragma once

#include <filesystem>
#include <string>

namespace bondlab {

void write_file(const std::filesystem::path &file, const std::string &text);

// create_directories with a UserError that names the folder and the reason.
void make_folder(const std::filesystem::path &folder);

}  // namespace bondlab
