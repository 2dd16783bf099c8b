// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what a run cost, from its own log: how many steps, particles and bonds, and the time of a bond
//   and step.
// Method: the engine's "Loop time of S on P procs for N steps with A atoms", summed over the run
//   commands of the deck, and "B bonds installed". The time of a bond and step is loop time over
//   steps and bonds at the start: time on the clock, whatever the number of ranks; start-up (mpirun,
//   reading, installing bonds) is in the wall time only. It can be set beside tools/bench.
// Units: s, and ns where the name says so.
// Failure: nothing when the log isn't there or no run command came to its end.
// Limits: bonds that broke are still counted; 0 bonds where the deck installs none.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace bondlab {

struct MeasuredCost {
  double loop_seconds = 0, steps = 0, particles = 0, bonds = 0;
  int ranks = 1;
  double ns_per_bond_and_step() const {  // 0 without bonds
    return bonds > 0 ? 1e9 * loop_seconds / steps / bonds : 0;
  }
};

std::optional<MeasuredCost> measured_cost(const std::filesystem::path &run_folder);

// "14900 steps, 573 particles, 1226 bonds, 31 ns a bond and step on 2 ranks".
std::string cost_text(const MeasuredCost &cost);

}  // namespace bondlab
