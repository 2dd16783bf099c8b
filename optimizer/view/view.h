// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: all pictures and ParaView files of a run, written into a folder.
// Method: every picture that the run has data for, of its end or of one frame; in 3D each of a slice, and cracks, displacement
//   and fragments of the whole body too. The frames on the way, where the run has some, as a series
//   for ParaView. PNG by rsvg-convert where it is asked for.
// Units: none.
// Failure: UserError when a file can't be written, gnuplot is missing, or rsvg-convert is missing
//   and PNG was asked for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "view/run_data.h"

namespace bondlab {

struct ViewOutput {
  std::string plane;  // of slices: "xz"; empty: chosen
  std::string state;  // of frame_of_state(); empty: the end
  bool png = false;
  bool paraview = true;
  std::vector<std::string> bond_columns;  // of the frames' bond files, as in ViewOptions
};

struct ViewWritten {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> missing;  // what there was no picture of and why
};

ViewWritten write_view(const RunView &run, const std::filesystem::path &folder,
                       const ViewOutput &output = {});

}  // namespace bondlab
