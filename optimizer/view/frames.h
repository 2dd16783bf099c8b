// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a run at the times between its start and its end, and those times as a series for ParaView.
// Method: the frames are the deck's particles_STEP.txt (`-var shots`). The state at a frame is the
//   finished run with the particles where they were then, the bonds that broke later whole again, the
//   fragments found anew, and the forces of bonds_STEP.txt where there is one. Times come from the
//   curve, which has step and time. A series is a .pvd file: one name and time a frame.
// Source: ParaView's PVD format, https://www.paraview.org/Wiki/ParaView/Data_formats (PVD File Format).
// Units: SI; times in s.
// Failure: UserError for a frame that can't be read or that has other particles than the run, and for
//   a state that isn't there (with those that are).
// Limits: without a curve the time is the number of the step.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "view/run_data.h"

namespace bondlab {

struct RunFrame {
  long step = 0;
  double time = 0;  // s
  std::filesystem::path particles, bonds;  // bonds may be empty
};

std::vector<RunFrame> find_frames(const RunView &run);  // by step

// The frame of a state in words: "first", "last", "peak" (the frame nearest to the largest load of the
// curve) or a step.
RunFrame frame_of_state(const RunView &run, const std::string &state);

// `columns` of the bond file, as in ViewOptions.
RunView run_at(const RunView &run, const RunFrame &frame,
               const std::vector<std::string> &columns = {});

// (time, file) as a ParaView collection; files are relative to the collection's.
std::string pvd_text(const std::vector<std::pair<double, std::string>> &files);

}  // namespace bondlab
