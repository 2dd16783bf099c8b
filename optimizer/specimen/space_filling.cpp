// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/space_filling.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

namespace bondlab {

std::vector<std::size_t> space_filling_order(const std::vector<Particle> &particles) {
  constexpr int bits = 20;
  double lo[3], extent = 0;
  std::fill(lo, lo + 3, std::numeric_limits<double>::infinity());
  for (const Particle &p : particles) {
    lo[0] = std::min(lo[0], p.x);
    lo[1] = std::min(lo[1], p.y);
    lo[2] = std::min(lo[2], p.z);
  }
  for (const Particle &p : particles)
    extent = std::max({extent, p.x - lo[0], p.y - lo[1], p.z - lo[2]});
  const double scale = extent > 0 ? ((1 << bits) - 1) / extent : 0;
  std::vector<std::uint64_t> code(particles.size(), 0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle &p = particles[i];
    const std::uint64_t at[3] = {static_cast<std::uint64_t>((p.x - lo[0]) * scale),
                                 static_cast<std::uint64_t>((p.y - lo[1]) * scale),
                                 static_cast<std::uint64_t>((p.z - lo[2]) * scale)};
    for (int b = 0; b < bits; ++b)
      for (int k = 0; k < 3; ++k) code[i] |= ((at[k] >> b) & 1) << (3 * b + k);
  }
  std::vector<std::size_t> order(particles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return code[a] < code[b]; });
  return order;
}

}  // namespace bondlab
