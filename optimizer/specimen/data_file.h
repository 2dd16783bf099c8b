// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: write and read the specimen file that decks read with read_data.
// Method: a LIGGGHTS data file for atom_style bonded/sphere, rows `id type diameter density x y
//   z`; line 1 is a comment with the container and the main figures as JSON. Line 1 stays under
//   255 characters: the engine reads lines into 256 bytes, and the rest of a longer one would be
//   its second line. Numbers are the shortest text that reads back to the same bits.
// Units: m, kg/m3. The box is twice the body in each direction about its middle, z from -r_max to
//   r_max in 2D.
// Failure: UserErrors with file:line for everything wrong with a file's text; UserError when a
//   file can't be written. Files are written whole (temporary file, then rename) or not at all.
// Limits: reads what it writes and plain files of that form (one Atoms section, no images, no
//   other sections).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/user_error.h"
#include "specimen/specimen.h"

namespace bondlab {

struct PackingRow {
  long id = 0;
  Particle particle;   // m
  double density = 0;  // kg/m3
  int line = 0;        // in the file
};

// A specimen file as it stands, rows in the file's order.
struct PackingFile {
  std::filesystem::path path;
  std::optional<SpecimenRequest>
      made_from;    // from line 1; r_min and r_ratio are those of the packing
  std::string key;  // from line 1
  std::array<double, 3> box_lo{}, box_hi{};  // m
  std::array<int, 3> box_line{};             // where they stand
  std::vector<PackingRow> rows;
};

std::string data_file_text(const Specimen &specimen);
// Also writes NAME.json beside NAME.data: request, statistics, key and a hash of the data file's
// bytes.
void write_data_file(const Specimen &specimen, const std::filesystem::path &path);

PackingFile read_packing_file(const std::filesystem::path &path);
// Particles in the order of their ids, which must be 1 .. N; the file must name its container in
// line 1.
Specimen read_data_file(const std::filesystem::path &path);

// Particles made elsewhere in the container of `request`, in space-filling order.
Specimen packing_in(const SpecimenRequest &request, const std::vector<Particle> &particles);

// Particles of a text file with `x y z r` in m in each line ('#' starts a comment) in the container
// of `request`, in space-filling order.
Specimen read_xyzr(const std::filesystem::path &path, const SpecimenRequest &request);

}  // namespace bondlab
