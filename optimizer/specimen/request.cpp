// SPDX-License-Identifier: GPL-2.0-or-later
#include <charconv>
#include <cmath>

#include "base/units.h"
#include "base/user_error.h"
#include "base/sha256.h"
#include "specimen/size_distribution.h"
#include "specimen/specimen.h"

namespace bondlab {

namespace {

// Changes when the generator gives another packing for the same request: old files are then made
// anew.
constexpr const char *generator = "radius-expansion-1";

constexpr double fewest_across = 5;  // mean diameters in the smallest size of a container
constexpr double narrowest_notch = 0.5;  // mean radii; bonds reach over gaps of 0.05 to 0.15
constexpr double largest_ratio =
    10;  // cells of the neighbour search are as large as the largest particle
constexpr long most_particles =
    2000000;  // about 2 GB and an hour; beyond it a slip in a unit is likelier than a wish
constexpr double least_overlap = 1e-7, largest_overlap = 1e-2;

std::string in_metres(double value) { return format_quantity(value, "m"); }

bool is_size(double value) { return std::isfinite(value) && value > 0; }

}  // namespace

void check_request(const SpecimenRequest &request) {
  ErrorCollector errors;
  const std::string shape = shape_name(request.shape);
  const auto check_size = [&](const char *name, double value) {
    if (!is_size(value))
      errors.add(Place{}, std::string(name) + " of a " + shape + " is " + canonical_number(value) +
                              " m (allowed: > 0)");
  };
  const Dimensions size = request.dimensions();
  for (const NamedDimension &dimension : dimensions_of(request.shape))
    check_size(dimension.name, size.*dimension.value);
  if (request.notch_depth != 0 || request.notch_width != 0) {
    if (!can_have_notch(request.shape)) {
      errors.add(Place{}, "a " + shape + " can't have a notch (allowed: rectangle, cylinder, prism)");
    } else {
      check_size("notch_depth", request.notch_depth);
      check_size("notch_width", request.notch_width);
    }
  }
  check_size("r_min", request.r_min);
  if (!(std::isfinite(request.r_ratio) && request.r_ratio >= 1 && request.r_ratio <= largest_ratio))
    errors.add(Place{}, "ratio of largest to smallest radius is " +
                            canonical_number(request.r_ratio) + " (allowed: 1 to " +
                            canonical_number(largest_ratio) + ")");
  if (!is_size(request.density))
    errors.add(Place{},
               "density is " + canonical_number(request.density) + " kg/m3 (allowed: > 0)");
  if (!(request.overlap >= least_overlap && request.overlap <= largest_overlap))
    errors.add(Place{}, "locked-in overlap is " + canonical_number(request.overlap) +
                            " mean radii (allowed: " + canonical_number(least_overlap) + " to " +
                            canonical_number(largest_overlap) + ")");
  errors.throw_if_any();

  const auto sizes = size_distribution(request.sizes, request.r_min, request.r_ratio);
  const Container container = request.container();
  const double r_mean = sizes->moment(1), needed = fewest_across * 2 * r_mean;
  if (container.has_notch() && request.notch_width < narrowest_notch * r_mean)
    throw UserError("the notch is " + in_metres(request.notch_width) +
                    " wide, so narrow that bonds would cross it (allowed: at least " +
                    in_metres(narrowest_notch * r_mean) + ", half a mean radius)");
  if (container.smallest_size() < needed)
    throw UserError("the " + shape + " is " + in_metres(container.smallest_size()) +
                    " in its smallest direction" +
                    (container.has_notch() ? " (above or beside the notch included)" : "") +
                    ", too small for particles of mean diameter " +
                    in_metres(2 * r_mean) + " (allowed: at least " + in_metres(needed) +
                    ", five particles across)");
  const int dimension = container.dimension();
  const double one = dimension == 2 ? 4 * sizes->moment(2) : 8 * sizes->moment(3);
  if (container.measure() / one > static_cast<double>(most_particles))
    throw UserError("the " + shape + " would take more than " + std::to_string(most_particles) +
                    " particles of mean radius " + in_metres(r_mean) +
                    " (allowed: at most that many)");
}

SpecimenRequest canonical_request(const SpecimenRequest &request) {
  SpecimenRequest rounded = request;
  for (double *number :
       {&rounded.width, &rounded.height, &rounded.diameter, &rounded.length, &rounded.notch_depth,
        &rounded.notch_width, &rounded.r_min, &rounded.r_ratio, &rounded.density,
        &rounded.overlap}) {
    const std::string text = format_quantity(*number, "", 12);
    std::from_chars(text.data(), text.data() + text.size(), *number);
  }
  return rounded;
}

std::string canonical_text(const SpecimenRequest &given) {
  const SpecimenRequest request = canonical_request(given);
  std::string text = "bondlab specimen 1\ngenerator " + std::string(generator);
  const auto line = [&](const char *name, const std::string &value) {
    text += "\n" + std::string(name) + " " + value;
  };
  line("shape", shape_name(request.shape));
  // Only what the shape has: a stray width given with a disc isn't another disc.
  const Dimensions size = request.dimensions();
  for (const NamedDimension &dimension : dimensions_of(request.shape))
    line(dimension.name, canonical_number(size.*dimension.value));
  if (request.container().has_notch()) {
    line("notch_depth", canonical_number(request.notch_depth));
    line("notch_width", canonical_number(request.notch_width));
  }
  line("r_min", canonical_number(request.r_min));
  line("r_ratio", canonical_number(request.r_ratio));
  line("sizes", request.sizes);
  line("seed", std::to_string(request.seed));
  line("density", canonical_number(request.density));
  line("overlap", canonical_number(request.overlap));
  return text + "\n";
}

std::string specimen_key(const SpecimenRequest &request) {
  return sha256(canonical_text(request)).substr(0, 16);
}

}  // namespace bondlab
