// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: refuse a packing that can't be tested, before anything is run on it.
// Method: what the engine would lose (outside its box), what a platen would hit first (outside
//   the container), what would burst (large overlaps), and what bonds wouldn't hold (particles
//   without a neighbour within the bond gap; several separate parts), and what they mustn't hold
//   (the two sides of a notch). Text errors (numbers,
//   duplicate ids, columns) are found by the reader.
// Units: gap in m; other limits relative to the particle's radius.
// Failure: UserErrors with file and line of each particle; of each kind at most ten are listed
//   and the rest counted.
#pragma once

#include <filesystem>

#include "specimen/data_file.h"

namespace bondlab {

struct PackingLimits {
  double gap =
      0;  // m; bonds are installed where surfaces are nearer; 0: bond_gap times the mean radius
  double stick_out = 1e-3;  // how far a particle may stick out of its container, over its radius
  double overlap = 2e-2;    // of two particles, over the smaller radius
};

void check_packing(const PackingFile &packing, const PackingLimits &limits = {});
void check_packing(const std::filesystem::path &path, const PackingLimits &limits = {});
// Without a file: errors name particles only.
void check_packing(const Specimen &specimen, const PackingLimits &limits = {});

}  // namespace bondlab
