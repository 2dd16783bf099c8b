// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: refuse a packing that the deck's bond gap would leave in pieces, before a run is spent on
//   it.
// Method: particles that no chain of gaps below the bond gap connects to the largest part are
//   counted. A few are floaters, as real packings have them, and only add mass; more than one in a
//   hundred means that the gap doesn't suit the particles, or that the packing is two.
// Units: m.
// Failure: UserError with the file and the line of the first such particle, the gap and what would
//   do.
#pragma once

#include <filesystem>

namespace bondlab {

void check_bond_gap(const std::filesystem::path &specimen_file, double gap);

}  // namespace bondlab
