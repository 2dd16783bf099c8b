// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: packings in the forms other programs read and write: text of x y z r, VTK for ParaView.
// Method: the LIGGGHTS data file (data_file.h) is the form the house keeps; these carry places and
//   radii only. Numbers are the shortest text that reads back to the same bits.
// Units: m.
// Failure: UserError with the file for one that can't be read, or whose name says no known form.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "specimen/data_file.h"

namespace bondlab {

std::string xyzr_text(const std::vector<Particle> &particles);
std::string packing_vtp_text(const std::vector<Particle> &particles);

// Writes the packing as the file's name says: .xyzr or .txt, .vtp.
void export_packing(const PackingFile &packing, const std::filesystem::path &out);

// Reads a packing into the container of `request` as the file's name says: .vtp or .vtu with an
// array radius (radius_m, r) or diameter (diameter_m) at the points; .data; else x y z r.
Specimen import_packing(const std::filesystem::path &file, const SpecimenRequest &request);

}  // namespace bondlab
