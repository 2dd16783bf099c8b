// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/switch_on.h"

#include <algorithm>
#include <cmath>

namespace bondlab::diagnose {

namespace {

constexpr double size_low = 5, size_high = 25, size_aim = 8;  // noise units
constexpr double hardly_another = 0.2;                        // in the logarithm
constexpr std::size_t most_growths = 2;
constexpr double clear = 0.3;  // share of noise that leaves no doubt of a change

}  // namespace

std::optional<double> next_switch_on(const std::vector<SizeTried> &tried, double largest) {
  const auto &last = tried.back();
  if (tried.size() > 1) {
    const auto &before = tried[tried.size() - 2];
    const double growth = std::abs(last.size / before.size);
    if (before.noise < clear && growth > 1 && last.norm < before.norm * std::sqrt(growth))
      return before.size;
  }
  if (tried.size() > most_growths || (last.norm >= size_low && last.norm <= size_high)) return {};
  const double wanted =
      std::clamp(size_aim / std::max(0.1, last.norm), 1 / longest_growth, longest_growth);
  const double size =
      std::copysign(std::min(std::abs(last.size) * wanted, std::abs(largest)), last.size);
  if (std::abs(std::log(size / last.size)) <= hardly_another) return {};
  return size;
}

}  // namespace bondlab::diagnose
