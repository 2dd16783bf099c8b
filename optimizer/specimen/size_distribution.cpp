// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/size_distribution.h"

#include "base/user_error.h"
#include "specimen/sizes_uniform.h"

namespace bondlab {

std::unique_ptr<SizeDistribution> size_distribution(const std::string &name, double r_min,
                                                    double r_ratio) {
  if (name == "uniform") return std::make_unique<UniformSizes>(r_min, r_min * r_ratio);
  throw UserError("unknown size distribution \"" + name +
                  "\" (allowed: " + join(size_distribution_names()) + ")");
}

std::vector<std::string> size_distribution_names() { return {"uniform"}; }

std::vector<double> draw_radii(const SizeDistribution &sizes, std::size_t count,
                               RandomStream &random) {
  std::vector<double> radii(count);
  for (std::size_t i = 0; i < count; ++i)
    radii[i] =
        sizes.quantile((static_cast<double>(i) + random.uniform()) / static_cast<double>(count));
  random.shuffle(radii);
  return radii;
}

}  // namespace bondlab
