// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/size_distribution.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "base/user_error.h"
#include "specimen/sizes_by_mass.h"
#include "specimen/sizes_discrete.h"
#include "specimen/sizes_log_normal.h"
#include "specimen/sizes_uniform.h"

namespace bondlab {

namespace {

// Cells of the neighbour search are as large as the largest particle.
constexpr double largest_ratio = 10;
constexpr double z_at_the_ends = 1.96;  // of the log-normal one

bool positive(double value) { return std::isfinite(value) && value > 0; }

std::string ratio_allowed() {
  return "(allowed: largest over smallest up to " + canonical_number(largest_ratio) + ")";
}

}  // namespace

std::vector<std::string> size_distribution_names() {
  return {"uniform", "log-normal", "discrete", "d10-d50-d90"};
}

void check_sizes(const SizeSettings &s) {
  ErrorCollector errors;
  const auto length = [&](const char *name, double value) {
    if (!positive(value))
      errors.add(Place{},
                 std::string(name) + " is " + canonical_number(value) + " m (allowed: > 0)");
    return positive(value);
  };
  if (s.name == "uniform") {
    length("r_min", s.r_min);
    if (!(std::isfinite(s.r_ratio) && s.r_ratio >= 1 && s.r_ratio <= largest_ratio))
      errors.add(Place{}, "ratio of largest to smallest radius is " + canonical_number(s.r_ratio) +
                              " (allowed: 1 to " + canonical_number(largest_ratio) + ")");
  } else if (s.name == "log-normal") {
    length("r_median", s.r_median);
    const double most = std::log(largest_ratio) / (2 * z_at_the_ends);
    if (!(s.r_spread > 0 && s.r_spread <= most))
      errors.add(Place{}, "r_spread, the standard deviation of ln r, is " +
                              canonical_number(s.r_spread) + " (allowed: > 0, up to " +
                              format_quantity(most, "", 3) + ")");
  } else if (s.name == "discrete") {
    if (s.classes.empty())
      errors.add(Place{}, "no classes of radii (allowed: such as \"0.5 mm: 30 %\")");
    double low = INFINITY, high = 0;
    for (const SizeClass &c : s.classes) {
      length("a class's radius", c.r);
      if (!positive(c.share))
        errors.add(Place{}, "a class's share is " + canonical_number(c.share) + " (allowed: > 0)");
      low = std::min(low, c.r), high = std::max(high, c.r);
    }
    if (errors.empty() && high > largest_ratio * low)
      errors.add(Place{}, "classes of radii from " + format_quantity(low, "mm") + " to " +
                              format_quantity(high, "mm") + " " + ratio_allowed());
  } else if (s.name == "d10-d50-d90") {
    const bool all = length("d10", s.d10) & length("d50", s.d50) & length("d90", s.d90);
    if (all && !(s.d10 < s.d50 && s.d50 < s.d90))
      errors.add(Place{}, "d10, d50 and d90 are " + format_quantity(s.d10, "mm") + ", " +
                              format_quantity(s.d50, "mm") + " and " +
                              format_quantity(s.d90, "mm") + " (allowed: increasing)");
    else if (all) {
      const SizesByMass sizes(s.d10, s.d50, s.d90, 3);
      if (sizes.largest() > largest_ratio * sizes.smallest())
        errors.add(Place{}, "d10, d50 and d90 ask for diameters from " +
                                format_quantity(2 * sizes.smallest(), "mm", 3) + " to " +
                                format_quantity(2 * sizes.largest(), "mm", 3) + " " +
                                ratio_allowed());
    }
  } else {
    errors.add(Place{}, "unknown size distribution \"" + s.name +
                            "\" (allowed: " + join(size_distribution_names()) + ")");
  }
  errors.throw_if_any();
}

SizeSettings in_units_of(SizeSettings s, double unit) {
  for (double *length : {&s.r_min, &s.r_median, &s.d10, &s.d50, &s.d90}) *length /= unit;
  for (SizeClass &c : s.classes) c.r /= unit;
  return s;
}

std::unique_ptr<SizeDistribution> size_distribution(const SizeSettings &s, int dimension) {
  if (s.name == "uniform") return std::make_unique<UniformSizes>(s.r_min, s.r_min * s.r_ratio);
  if (s.name == "log-normal") return std::make_unique<LogNormalSizes>(s.r_median, s.r_spread);
  if (s.name == "discrete") return std::make_unique<DiscreteSizes>(s.classes);
  if (s.name == "d10-d50-d90") return std::make_unique<SizesByMass>(s.d10, s.d50, s.d90, dimension);
  throw UserError("unknown size distribution \"" + s.name +
                  "\" (allowed: " + join(size_distribution_names()) + ")");
}

std::unique_ptr<SizeDistribution> size_distribution(const std::string &name, double r_min,
                                                    double r_ratio) {
  SizeSettings settings;
  settings.name = name, settings.r_min = r_min, settings.r_ratio = r_ratio;
  return size_distribution(settings, 3);
}

SizeClass parse_size_class(const std::string &text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw UserError("\"" + text + "\" isn't a class of radii (allowed: such as \"0.5 mm: 30 %\")");
  const Quantity size = split_quantity(text.substr(0, colon));
  const Quantity share = split_quantity(text.substr(colon + 1));
  SizeClass c;
  c.r = size.unit.empty() ? size.number : parse_quantity(text.substr(0, colon), "m");
  if (!share.unit.empty() && share.unit != "%")
    throw UserError("\"" + text + "\": a share has no unit '" + share.unit +
                    "' (allowed: a number, %)");
  c.share = share.number;
  return c;
}

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
