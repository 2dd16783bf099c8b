// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/bond_gap_check.h"

#include <algorithm>
#include <string>

#include "base/units.h"
#include "base/user_error.h"
#include "specimen/data_file.h"
#include "specimen/neighbours.h"

namespace bondlab {

static constexpr double kFloaters = 0.01;  // largest share of particles outside the largest part

void check_bond_gap(const std::filesystem::path &specimen_file, double gap) {
  const PackingFile packing = read_packing_file(specimen_file);
  std::vector<Particle> particles;
  double mean_radius = 0;
  for (const PackingRow &row : packing.rows) {
    particles.push_back(row.particle);
    mean_radius += row.particle.r / static_cast<double>(packing.rows.size());
  }
  const Clusters parts = connected_clusters(find_pairs(particles, gap));
  std::vector<std::size_t> size(static_cast<std::size_t>(parts.count), 0);
  for (const int label : parts.label) ++size[static_cast<std::size_t>(label)];
  const std::size_t largest =
      static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const std::size_t count = particles.size(), apart = count - size[largest];
  if (static_cast<double>(apart) <= kFloaters * static_cast<double>(count)) return;

  const auto first_of = [&](auto &&is_it) {
    for (std::size_t i = 0;; ++i)
      if (is_it(static_cast<std::size_t>(parts.label[i]))) return i;
  };
  const auto alone = static_cast<std::size_t>(std::count(size.begin(), size.end(), 1));
  const std::string within = " within the bond gap of " + format_quantity(gap, "mm") +
                             " (deck variable 'gap'); usual for this packing: " +
                             format_quantity(0.05 * mean_radius, "mm", 2) +
                             ", a twentieth of the mean radius";
  if (static_cast<double>(alone) > kFloaters * static_cast<double>(count)) {
    const std::size_t first = first_of([&](std::size_t part) { return size[part] == 1; });
    throw UserError({specimen_file.string(), packing.rows[first].line, 0},
                    std::to_string(alone) + " of " + std::to_string(count) +
                        " particles, this one first, touch no other" + within);
  }
  const std::size_t first = first_of([&](std::size_t part) { return part != largest; });
  throw UserError({specimen_file.string(), packing.rows[first].line, 0},
                  "the packing is in pieces: " + std::to_string(apart) + " of " +
                      std::to_string(count) +
                      " particles, this one first, touch the largest piece nowhere" + within);
}

}  // namespace bondlab
