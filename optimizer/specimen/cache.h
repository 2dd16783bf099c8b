// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: make a specimen once and use its file ever after.
// Method: the file's name is the shape and the key of the request. It is taken as it is when the
//   record beside it has the same key and the hash of the file's bytes; else it is made anew. Two
//   processes may make the same one at the same time: both write the same bytes and rename them
//   into place.
// Units: none.
// Failure: as make_specimen and write_data_file; UserError when the directory can't be made.
#pragma once

#include <filesystem>

#include "specimen/specimen.h"

namespace bondlab {

// Returns directory / SHAPE-KEY.data, which then exists and is intact. The directory is made when
// absent.
std::filesystem::path ensure_specimen(const SpecimenRequest &request,
                                      const std::filesystem::path &directory,
                                      const SpecimenProgressCallback &progress = {});

// Whether the file and its record are there, whole and made from a request with this key.
bool specimen_is_intact(const std::filesystem::path &data_file, const std::string &key);

}  // namespace bondlab
