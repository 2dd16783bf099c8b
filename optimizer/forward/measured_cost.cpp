// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/measured_cost.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>

#include "forward/failure.h"

namespace bondlab {

std::optional<MeasuredCost> measured_cost(const std::filesystem::path &run_folder) {
  std::ifstream log(run_folder / kLogName);
  MeasuredCost cost;
  for (std::string line; std::getline(log, line);) {
    double seconds = 0, ranks = 0, steps = 0, atoms = 0, bonds = 0;
    if (std::sscanf(line.c_str(), "Loop time of %lf on %lf procs for %lf steps with %lf atoms",
                    &seconds, &ranks, &steps, &atoms) == 4) {
      cost.loop_seconds += seconds;
      cost.steps += steps;
      cost.particles = atoms;
      cost.ranks = static_cast<int>(ranks);
    } else if (line.find(" bonds installed") != std::string::npos &&
               std::sscanf(line.c_str(), " %lf", &bonds) == 1) {
      cost.bonds += bonds;
    }
  }
  if (!(cost.steps > 0)) return std::nullopt;
  return cost;
}

std::string cost_text(const MeasuredCost &cost) {
  std::string text = fmt::format("{:.0f} steps, {:.0f} particles, {:.0f} bonds", cost.steps,
                                 cost.particles, cost.bonds);
  if (cost.bonds > 0) text += fmt::format(", {:.0f} ns a bond and step", cost.ns_per_bond_and_step());
  return text + (cost.ranks > 1 ? fmt::format(" on {} ranks", cost.ranks) : "");
}

}  // namespace bondlab
