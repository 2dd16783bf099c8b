// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
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
constexpr const char *generator = "radius-expansion-1", *filler = "filling-1",
                     *inserter = "insertion-1";

constexpr double fewest_across = 5;      // mean diameters in the smallest size of a container
constexpr double narrowest_notch = 0.5;  // mean radii; bonds reach over gaps of 0.05 to 0.15
constexpr long most_particles =
    2000000;  // about 2 GB and an hour; beyond it a slip in a unit is likelier than a wish
constexpr double least_ratio = 2;  // of radii inserted: at 1.66 discs fall apart (specimen.md)
constexpr double least_overlap = 1e-7, largest_overlap = 1e-2;

std::string in_metres(double value) { return format_quantity(value, "m"); }

bool is_size(double value) { return std::isfinite(value) && value > 0; }

}  // namespace

std::vector<std::string> packing_methods() { return {"expansion", "filling", "insertion"}; }

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
      errors.add(Place{},
                 "a " + shape + " can't have a notch (allowed: rectangle, cylinder, prism)");
    } else {
      check_size("notch_depth", request.notch_depth);
      check_size("notch_width", request.notch_width);
    }
  }
  try {
    check_sizes(request.size_settings());
  } catch (const UserErrors &several) {
    for (const UserError &error : several.errors()) errors.add(Place{}, error.text());
  } catch (const UserError &error) {
    errors.add(Place{}, error.text());
  }
  const std::vector<std::string> methods = packing_methods();
  if (std::find(methods.begin(), methods.end(), request.method) == methods.end())
    errors.add(Place{},
               "unknown method \"" + request.method + "\" (allowed: " + join(methods) + ")");
  if (request.method == "insertion" && (request.tries < 1 || request.tries > most_tries))
    errors.add(Place{}, "tries is " + std::to_string(request.tries) + " (allowed: 1 to " +
                            std::to_string(most_tries) + ")");
  if (!is_size(request.density))
    errors.add(Place{},
               "density is " + canonical_number(request.density) + " kg/m3 (allowed: > 0)");
  if (!(request.overlap >= least_overlap && request.overlap <= largest_overlap))
    errors.add(Place{}, "locked-in overlap is " + canonical_number(request.overlap) +
                            " mean radii (allowed: " + canonical_number(least_overlap) + " to " +
                            canonical_number(largest_overlap) + ")");
  errors.throw_if_any();

  const auto sizes = size_distribution(request.size_settings(), is_flat(request.shape) ? 2 : 3);
  if (request.method == "insertion" && sizes->largest() < least_ratio * sizes->smallest())
    throw UserError("the largest radius is " +
                    format_quantity(sizes->largest() / sizes->smallest(), "", 4) +
                    " times the smallest; between sizes so alike insertion fits too few "
                    "(allowed: at least " +
                    canonical_number(least_ratio) + " times)");
  const Container container = request.container();
  // A filling is mostly small particles, whatever its distribution: it needs room for the largest.
  const bool filling = request.method != "expansion";
  const double r_mean = sizes->moment(1);
  const double needed =
      filling ? std::max(2 * sizes->largest(), fewest_across * 2 * sizes->smallest())
              : fewest_across * 2 * r_mean;
  if (container.has_notch() && request.notch_width < narrowest_notch * r_mean)
    throw UserError("the notch is " + in_metres(request.notch_width) +
                    " wide, so narrow that bonds would cross it (allowed: at least " +
                    in_metres(narrowest_notch * r_mean) + ", half a mean radius)");
  if (container.smallest_size() < needed)
    throw UserError("the " + shape + " is " + in_metres(container.smallest_size()) +
                    " in its smallest direction" +
                    (container.has_notch() ? " (above or beside the notch included)" : "") +
                    ", too small for particles of " +
                    (filling ? "up to " + in_metres(2 * sizes->largest())
                             : "mean diameter " + in_metres(2 * r_mean)) +
                    " (allowed: at least " + in_metres(needed) +
                    (filling ? ", the largest particle and five of the smallest)"
                             : ", five particles across)"));
  const int dimension = container.dimension();
  const double one = dimension == 2 ? 4 * sizes->moment(2) : 8 * sizes->moment(3);
  if (container.measure() / one > static_cast<double>(most_particles))
    throw UserError("the " + shape + " would take more than " + std::to_string(most_particles) +
                    " particles of mean radius " + in_metres(r_mean) +
                    " (allowed: at most that many)");
}

SpecimenRequest canonical_request(const SpecimenRequest &request) {
  SpecimenRequest rounded = request;
  std::vector<double *> more = {&rounded.r_median, &rounded.r_spread, &rounded.d10, &rounded.d50,
                                &rounded.d90};
  for (SizeClass &c : rounded.classes) more.insert(more.end(), {&c.r, &c.share});
  const auto round_off = [](double *number) {
    const std::string text = format_quantity(*number, "", 12);
    std::from_chars(text.data(), text.data() + text.size(), *number);
  };
  for (double *number : more) round_off(number);
  for (double *number :
       {&rounded.width, &rounded.height, &rounded.diameter, &rounded.length, &rounded.notch_depth,
        &rounded.notch_width, &rounded.r_min, &rounded.r_ratio, &rounded.density, &rounded.overlap})
    round_off(number);
  return rounded;
}

std::string canonical_text(const SpecimenRequest &given) {
  const SpecimenRequest request = canonical_request(given);
  const char *maker = request.method == "filling"     ? filler
                      : request.method == "insertion" ? inserter
                                                      : generator;
  std::string text = "bondlab specimen 1\ngenerator " + std::string(maker);
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
  // Likewise of the distribution.
  if (request.sizes == "log-normal") {
    line("r_median", canonical_number(request.r_median));
    line("r_spread", canonical_number(request.r_spread));
  } else if (request.sizes == "discrete") {
    for (const SizeClass &c : request.classes)
      line("class", canonical_number(c.r) + " " + canonical_number(c.share));
  } else if (request.sizes == "d10-d50-d90") {
    line("d10", canonical_number(request.d10));
    line("d50", canonical_number(request.d50));
    line("d90", canonical_number(request.d90));
  } else {
    line("r_min", canonical_number(request.r_min));
    line("r_ratio", canonical_number(request.r_ratio));
  }
  line("sizes", request.sizes);
  line("seed", std::to_string(request.seed));
  line("density", canonical_number(request.density));
  if (request.method == "expansion") line("overlap", canonical_number(request.overlap));
  if (request.method == "insertion") line("tries", std::to_string(request.tries));
  return text + "\n";
}

std::string specimen_key(const SpecimenRequest &request) {
  return sha256(canonical_text(request)).substr(0, 16);
}

}  // namespace bondlab
