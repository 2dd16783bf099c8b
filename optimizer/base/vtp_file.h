// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: points, and lines between them, with named values, as a VTK XML file (.vtp) that ParaView
//   reads; and such a file back.
// Method: PolyData in plain text ("ascii"): it can be read by eye and by any XML reader, and no
//   library is needed (VTK's are 166 packages). Without lines every point is a vertex cell, so that
//   it is drawn. Numbers are the shortest text that reads back to the same bits. The reader takes
//   .vtp and .vtu with ascii arrays, and of them the points and the values at points.
// Source: VTK file formats, "XML file formats": https://docs.vtk.org (PolyData, UnstructuredGrid).
// Units: the caller's; names should carry them.
// Failure: UserError with the file, and the line where it is known, for a file that isn't read.
// Limits: no appended or compressed data (ParaView: Save Data, Data Mode Ascii).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace bondlab {

struct VtpArray {
  std::string name;
  int components = 1;
  bool whole = false;  // Int32 instead of Float64
  std::vector<double> values;
};

struct VtpData {
  std::vector<double> points;             // x y z, x y z, ...
  std::vector<std::array<int, 2>> lines;  // between points, from 0
  std::vector<VtpArray> point_data;
  std::vector<VtpArray> cell_data;  // of the lines
  std::size_t size() const { return points.size() / 3; }
  const VtpArray *find(const std::string &name) const;  // at points; nullptr when absent
};

// Not-a-number has no ascii form that all readers take: values must be finite (assertion).
std::string vtp_text(const VtpData &data);

VtpData read_vtk_points(const std::filesystem::path &file);

}  // namespace bondlab
