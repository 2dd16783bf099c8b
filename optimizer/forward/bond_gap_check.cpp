// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/bond_gap_check.h"

#include <algorithm>
#include <string>

#include "base/units.h"
#include "base/user_error.h"
#include "specimen/data_file.h"
#include "specimen/neighbours.h"

namespace bondlab {

static constexpr double kFloaters = 0.01;  // largest share of particles without a neighbour

static std::vector<bool> has_neighbour(const std::vector<Particle> &particles, double gap) {
  std::vector<bool> found(particles.size(), false);
  const PairList pairs = find_pairs(particles, gap);
  for (std::size_t i = 0; i + 1 < pairs.start.size(); ++i)
    for (std::size_t k = pairs.start[i]; k < pairs.start[i + 1]; ++k)
      found[i] = found[static_cast<std::size_t>(pairs.other[k])] = true;
  return found;
}

void check_bond_gap(const std::filesystem::path &specimen_file, double gap) {
  const PackingFile packing = read_packing_file(specimen_file);
  std::vector<Particle> particles;
  double mean_radius = 0;
  for (const PackingRow &row : packing.rows) {
    particles.push_back(row.particle);
    mean_radius += row.particle.r / static_cast<double>(packing.rows.size());
  }
  const std::vector<bool> bonded = has_neighbour(particles, gap);
  const auto alone = static_cast<std::size_t>(std::count(bonded.begin(), bonded.end(), false));
  if (static_cast<double>(alone) <= kFloaters * static_cast<double>(bonded.size())) return;
  const std::size_t first =
      static_cast<std::size_t>(std::find(bonded.begin(), bonded.end(), false) - bonded.begin());
  throw UserError(
      {specimen_file.string(), packing.rows[first].line, 0},
      std::to_string(alone) + " of " + std::to_string(bonded.size()) +
          " particles, this one first, touch no other within the bond gap of " +
          format_quantity(gap, "mm") + " (deck variable 'gap'); usual for this packing: " +
          format_quantity(0.05 * mean_radius, "mm", 2) + ", a twentieth of the mean radius");
}

}  // namespace bondlab
