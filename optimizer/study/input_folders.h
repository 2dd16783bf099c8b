// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: find what came with BondLab: the folder of a virtual test, and programs beside our own.
// Method: a name with a '/' is a path from the study file's folder; a plain name is looked for in
// BONDLAB_INPUTS (environment),
//   then in ../share/bondlab/inputs beside the program's folder (installed), then in the source
//   tree it was built from.
// Units: none. Failure: an absent folder gives an empty path; the caller says where it is named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bondlab {

// Folder of the running program, from /proc/self/exe.
std::filesystem::path program_folder();

// Where plain test names are looked for, in order; only those that exist.
std::vector<std::filesystem::path> input_folders();

std::filesystem::path find_test_folder(const std::string &name,
                                       const std::filesystem::path &study_folder);

// Names of the tests in input_folders(), for messages.
std::vector<std::string> known_tests();

}  // namespace bondlab
