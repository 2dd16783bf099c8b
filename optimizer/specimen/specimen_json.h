// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the JSON of a specimen: one line for the data file, and the record beside it.
// Method: plain text in and out, so that the JSON library stays in one source file.
// Units: SI, named in the keys of the record where they aren't m.
// Failure: the parse functions return nothing for text that isn't what was written here.
#pragma once

#include <optional>
#include <string>

#include "specimen/specimen.h"

namespace bondlab {

// Container, seed, radii as packed, count, porosity, coordination at the bond gap, key: one line,
// shorter than `most` characters (what can be spared is left out to keep it so).
std::string metadata_line(const Specimen &specimen, std::size_t most);

struct MetadataLine {
  SpecimenRequest request;
  std::string key;
};
std::optional<MetadataLine> parse_metadata_line(const std::string &text);

// NAME.json: request, all statistics, key, hash of the data file.
std::string specimen_record(const Specimen &specimen, const std::string &data_hash);

struct RecordHeader {
  std::string key, data_hash;
};
std::optional<RecordHeader> parse_specimen_record(const std::string &text);

}  // namespace bondlab
