// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the files a virtual test writes, as data: the curve, the log of broken bonds, the particles
// at the end. Method: strict readers: header lines `# bondlab-curve 1`, `# names:`, `# units:`,
// every row with as many finite numbers
//   as there are names, `# complete: WHY` as the last line (its absence means a truncated file,
//   which is data, not an error).
// Units: SI, as the file's units line says; other units are refused. Failure: UserError with
// file:line:column.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/user_error.h"

namespace bondlab {

struct Curve {
  std::vector<std::string> names, units;
  std::vector<std::vector<double>> columns;
  bool complete = false;
  std::string completion;  // stop_after_peak, end_of_run

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  bool has(const std::string &name) const;
  const std::vector<double> &column(
      const std::string &name) const;  // UserError that lists the columns when absent
};

struct BrokenBond {
  long step = 0;
  double time = 0;
  int id1 = 0, id2 = 0, type = 0;
  double x = 0, y = 0, z = 0;
  std::string mode;  // tension, shear
  double sigma = 0, tau = 0, sigma_c = 0, tau_c = 0;
};

struct EndParticle {
  int id = 0, type = 0;
  double radius = 0, x = 0, y = 0, z = 0;
  std::array<double, 6> stress{};  // Pa, xx yy zz xy xz yz; where the dump has c_stress[1] to [6]
  bool has_stress = false;
};

Curve read_curve(const std::filesystem::path &file);
std::vector<BrokenBond> read_broken_bonds(const std::filesystem::path &file);
std::vector<EndParticle> read_particles(
    const std::filesystem::path &file);  // last frame of a dump, sorted by id

}  // namespace bondlab
