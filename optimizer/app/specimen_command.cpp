// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab specimen rectangle|disc|cylinder|prism|sphere` makes a packing and prints its
//   statistics; `bondlab specimen check` looks whether a specimen file can be used.
// Units: lengths with a unit ("50 mm") or plain in m; statistics are printed in mm.
// Failure: UserError for bad sizes, files that can't be written or read, packings that can't be
//   tested.
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "app/commands.h"
#include "base/units.h"
#include "base/user_error.h"
#include "specimen/check_packing.h"
#include "specimen/data_file.h"
#include "specimen/exchange.h"
#include "specimen/size_distribution.h"
#include "specimen/specimen.h"

namespace bondlab {

namespace {

// The options as typed; quantities are parsed when the command runs, so that their errors are
// UserErrors like all others.
struct Options {
  std::map<std::string, std::string> sizes_of_body;  // by the names of container.h
  std::string r_min, density = "2600 kg/m3", from, out;
  double ratio = 1.66, overlap = SpecimenRequest().overlap;
  std::string sizes = "uniform", method = "expansion", r_median, d10, d50, d90, classes;
  double spread = 0;
  std::optional<long> tries;
  std::uint64_t seed = 1;
};

constexpr NamedDimension notch_dimensions[] = {{"notch_depth", &Dimensions::notch_depth},
                                               {"notch_width", &Dimensions::notch_width}};

std::string option_name(std::string dimension) {
  std::replace(dimension.begin(), dimension.end(), '_', '-');
  return "--" + dimension;
}

double quantity(const char *option, const std::string &text, const char *unit) {
  if (text.empty()) return 0;
  try {
    const Quantity parts = split_quantity(text);
    return parts.unit.empty() ? parts.number : parse_quantity(text, unit);
  } catch (const UserError &error) {
    throw UserError(std::string(option) + ": " + error.text());
  }
}

SpecimenRequest request_from(ContainerShape shape, const Options &options) {
  SpecimenRequest request;
  request.shape = shape;
  Dimensions size;
  const auto take = [&](const NamedDimension &dimension) {
    const auto given = options.sizes_of_body.find(dimension.name);
    if (given != options.sizes_of_body.end())
      size.*dimension.value = quantity(option_name(dimension.name).c_str(), given->second, "m");
  };
  for (const NamedDimension &dimension : dimensions_of(shape)) take(dimension);
  for (const NamedDimension &dimension : notch_dimensions) take(dimension);
  request.set_dimensions(size);
  request.r_min = quantity("--r-min", options.r_min, "m");
  request.density = quantity("--density", options.density, "kg/m3");
  request.r_ratio = options.ratio;
  request.overlap = options.overlap;
  request.sizes = options.sizes;
  request.method = options.method;
  if (options.tries && options.method != "insertion")
    throw UserError("--tries belongs to --method insertion; here it is " + options.method);
  request.tries = options.tries.value_or(request.tries);
  request.r_median = quantity("--r-median", options.r_median, "m");
  request.r_spread = options.spread;
  request.d10 = quantity("--d10", options.d10, "m");
  request.d50 = quantity("--d50", options.d50, "m");
  request.d90 = quantity("--d90", options.d90, "m");
  std::istringstream classes(options.classes);
  for (std::string text; std::getline(classes, text, ',');)
    request.classes.push_back(parse_size_class(text));
  request.seed = options.seed;
  return request;
}

void print_statistics(const Specimen &specimen) {
  const SpecimenStatistics &s = specimen.statistics;
  const bool flat = specimen.request.container().dimension() == 2;
  const auto line = [](const char *name, const std::string &value) {
    fmt::print("{:<22}{}\n", name, value);
  };
  line("particles", fmt::format("{} {}", s.count, flat ? "discs" : "spheres"));
  line("radii", fmt::format("{:.4g} to {:.4g} mm, mean {:.4g} mm", 1e3 * s.r_min, 1e3 * s.r_max,
                            1e3 * s.r_mean));
  line("porosity",
       fmt::format("{:.4f}, inside the wall layer {:.4f}", s.porosity, s.porosity_inner));
  std::string coordination;
  for (std::size_t g = 0; g < coordination_gaps.size(); ++g)
    coordination +=
        fmt::format("{}{:.3f} at {:g}", g > 0 ? ", " : "", s.coordination[g], coordination_gaps[g]);
  line("bonds per particle", coordination + " mean radii of gap");
  line("overlap", fmt::format("mean {:.2g}, largest {:.2g} of the radius; over the walls {:.2g}",
                              s.mean_overlap, s.max_overlap, s.stick_out));
  line("isotropy", fmt::format("eigenvalue ratio of fabric {:.3f}, of stress {:.3f}",
                               s.fabric_ratio, s.stress_ratio));
  line("locked-in stress", fmt::format("{:.2g} of the contact modulus E_c", s.stress_over_modulus));
  line("floaters", fmt::format("{} left, {} grown until held", s.floaters, s.floaters_grown));
  if (specimen.request.shape != ContainerShape::disc &&
      specimen.request.shape != ContainerShape::sphere)
    line("touching the ends", fmt::format("{} bottom, {} top", s.on_bottom, s.on_top));
}

// A line on the terminal while a packing is made; nothing in a log.
void show_progress(const SpecimenProgress &progress) {
  if (!::isatty(STDERR_FILENO)) return;
  fmt::print(stderr, "\r{:<24}{:3.0f} %", progress.stage, 100 * progress.fraction);
  if (progress.fraction >= 1) fmt::print(stderr, "\r{:30}\r", "");
  std::fflush(stderr);
}

void make(ContainerShape shape, const Options &options) {
  const std::filesystem::path out = options.out;
  // Before the work, not after it.
  const std::filesystem::path folder = out.has_parent_path() ? out.parent_path() : ".";
  if (!std::filesystem::is_directory(folder))
    throw UserError("--out: there is no directory " + folder.string());
  if (std::filesystem::is_directory(out))
    throw UserError("--out: " + out.string() + " is a directory (allowed: a file)");
  SpecimenRequest request = request_from(shape, options);
  Specimen specimen;
  if (options.from.empty()) {
    if (options.r_min.empty() && options.sizes == "uniform")
      throw UserError("--r-min is missing (the smallest radius, such as \"0.66 mm\")");
    specimen = make_specimen(request, show_progress);
  } else {
    specimen = import_packing(options.from, request);
  }
  check_packing(specimen);
  write_data_file(specimen, out);
  print_statistics(specimen);
}

void add_shape(CLI::App &specimen, ContainerShape shape) {
  const char *const about[] = {
      "discs in a rectangle of width x and height y", "discs in a circle, loaded along y",
      "spheres in a cylinder with axis z", "spheres in a prism of width x, height y and length z",
      "spheres in a sphere"};
  CLI::App *command = specimen.add_subcommand(shape_name(shape), about[static_cast<int>(shape)]);
  const auto options = std::make_shared<Options>();
  for (const NamedDimension &dimension : dimensions_of(shape))
    command
        ->add_option(option_name(dimension.name), options->sizes_of_body[dimension.name],
                     std::string(dimension.name) + ", such as \"50 mm\" (plain numbers: m)")
        ->required();
  if (can_have_notch(shape)) {
    CLI::Option *depth =
        command->add_option("--notch-depth", options->sizes_of_body["notch_depth"],
                            "depth of a notch in the middle of the long side, open to -y");
    CLI::Option *width =
        command->add_option("--notch-width", options->sizes_of_body["notch_width"], "its width");
    depth->needs(width);
    width->needs(depth);
  }
  command->add_option("--r-min", options->r_min, "smallest particle radius");
  command->add_option("--ratio", options->ratio, "largest over smallest radius")
      ->capture_default_str();
  command
      ->add_option("--sizes", options->sizes,
                   "distribution of radii: " + join(size_distribution_names()))
      ->capture_default_str();
  command->add_option("--r-median", options->r_median, "log-normal: median radius");
  command->add_option("--spread", options->spread, "log-normal: standard deviation of ln r");
  command->add_option("--classes", options->classes,
                      "discrete: radii and shares of the number, \"0.5 mm: 30 %, 0.8 mm: 70 %\"");
  command->add_option("--d10", options->d10,
                      "d10-d50-d90: diameter below which 10 % of the mass is");
  command->add_option("--d50", options->d50, "the same, 50 %");
  command->add_option("--d90", options->d90, "the same, 90 %");
  command
      ->add_option("--method", options->method,
                   "way of packing: " + join(packing_methods()) + " (filling: touching, no stress; insertion: the same with holes left, as by GenGeo)")
      ->capture_default_str();
  command->add_option("--tries", options->tries,
                      "insertion: failures in a row until it gives up (default " +
                          std::to_string(default_tries) + ")");
  command->add_option("--seed", options->seed, "another seed is another packing")
      ->capture_default_str();
  command->add_option("--density", options->density, "density of the particles")
      ->capture_default_str();
  command
      ->add_option("--overlap", options->overlap,
                   "locked-in stress as mean overlap over mean radius")
      ->capture_default_str();
  command->add_option("--from", options->from,
                      "take the particles from a file: text of x y z r in m, .vtp, .vtu or .data");
  command
      ->add_option("--out", options->out,
                   "specimen file to write; its record NAME.json goes beside it")
      ->required();
  command->callback([shape, options] { make(shape, *options); });
}

}  // namespace

void add_specimen(CLI::App &app) {
  CLI::App *specimen =
      app.add_subcommand("specimen", "make a packing of discs or spheres, or check one");
  specimen->require_subcommand(1);
  for (const std::string &name : container_shape_names())
    add_shape(*specimen, shape_from_name(name));

  CLI::App *exported =
      specimen->add_subcommand("export", "write a specimen file as x y z r or for ParaView");
  const auto in = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  exported->add_option("file", *in, "specimen file")->required();
  exported->add_option("--out", *out, "file to write: NAME.vtp, NAME.xyzr or NAME.txt")->required();
  exported->callback([in, out] { export_packing(read_packing_file(*in), *out); });

  CLI::App *check = specimen->add_subcommand("check", "look whether a specimen file can be tested");
  const auto file = std::make_shared<std::string>(), gap = std::make_shared<std::string>();
  check->add_option("file", *file, "specimen file")->required();
  check->add_option("--gap", *gap,
                    "gap within which bonds will be installed (default: 0.05 mean radii)");
  check->callback([file, gap] {
    PackingLimits limits;
    limits.gap = quantity("--gap", *gap, "m");
    const PackingFile packing = read_packing_file(*file);
    check_packing(packing, limits);
    if (packing.made_from)
      print_statistics(read_data_file(*file));
    else
      fmt::print("{:<22}{}\n", "particles", packing.rows.size());
  });
}

}  // namespace bondlab
