// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab check STUDY`: everything that is wrong with a study, or what it will do and how
// long that takes. Method: the study, its tests, data and responses are read and judged; nothing is
// run or written. Seconds a run come from
//   the study's earlier runs where there are some, else from an estimate, which is marked.
// Units: shown in those of the study. Failure: exit status as in commands.h.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "base/units.h"
#include "forward/engine_forward_model.h"
#include "forward/run_cost.h"
#include "refine/fit_plan.h"
#include "response/check.h"
#include "study/parameter_space.h"

namespace bondlab {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string study, out;
  int jobs = 0;
};

std::string in_words(double seconds) {
  if (seconds < 100) return fmt::format("{:.3g} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string size_of(const SpecimenEntry &s) {
  const auto mm = [](double length) { return format_quantity(length, "mm"); };
  std::string text = shape_name(s.shape);
  for (const NamedDimension &dimension : dimensions_of(s.shape))
    text += fmt::format(", {} {}", dimension.name, mm(s.size.*dimension.value));
  if (s.size.notch_depth > 0)
    text += fmt::format(", notch {} deep, {} wide", mm(s.size.notch_depth), mm(s.size.notch_width));
  if (is_flat(s.shape)) text += ", thickness " + mm(s.thickness);
  return text;
}

// "test@case", "specimen@case" (PublishedCase::own_tests): a hundred of them would hide the rest.
bool made_for_a_case(const std::string &name) { return name.find('@') != std::string::npos; }

// Every test of the study at the parameters' start values.
std::map<std::string, std::optional<RunCost>> costs_of(const Study &study, const RunStore *store) {
  const ParameterSpace space(study.parameters);
  std::map<std::string, std::optional<RunCost>> costs;
  for (const TestEntry &test : study.tests)
    costs[test.name] = run_cost(
        plan_run(study, {test.name, deck_variables(study, test.name, space.start().x), 0}), store);
  return costs;
}

void print_specimens(const Study &study) {
  fmt::print("specimens\n");
  for (const SpecimenEntry &s : study.specimens)
    if (!made_for_a_case(s.name)) fmt::print("  {:<14} {}; radii {} to {}, about {:.0f} particles, seed {}\n", s.name, size_of(s),
               format_quantity(s.r_min, "mm"), format_quantity(s.r_min * s.r_ratio, "mm"),
               expected_particles(s), s.seed);
}

void print_tests(const Study &study, const std::map<std::string, std::optional<RunCost>> &costs) {
  fmt::print("tests\n");
  for (const TestEntry &test : study.tests) {
    if (made_for_a_case(test.name)) continue;
    const auto &cost = costs.at(test.name);
    const std::string seconds =
        !cost ? "time of a run unknown before the first"
              : in_words(cost->seconds) + (cost->measured ? " a run" : " a run (estimate)");
    fmt::print("  {:<14} {} on {}, {} {}, {}, wall limit {}\n", test.name, test.definition.name,
               test.specimen, test.ranks, test.ranks == 1 ? "rank" : "ranks", seconds,
               in_words(test.wall_limit));
  }
}

void print_identification(const Study &study) {
  if (!study.parameters.empty()) fmt::print("parameters\n");
  for (const Parameter &p : study.parameters)
    fmt::print("  {:<14} {} to {}, {}; sets {}\n", p.name, format_quantity(p.lower, p.unit),
               format_quantity(p.upper, p.unit), p.scale == Scale::logarithmic ? "log" : "linear",
               join(p.sets));
  if (!study.targets.empty()) fmt::print("targets\n");
  for (const Target &t : study.targets)
    fmt::print("  {:<14} {}, sd {} ({})\n", t.name, format_quantity(t.value, t.unit),
               format_quantity(t.sd, t.unit), source_text(t));
  if (!study.data) return;
  fmt::print("measured curves\n");
  for (const Measurement &series : study.data->measurements)
    fmt::print("  {:<14} {}({}), {} {}\n", series.name, series.y, series.x,
               series.replicates.size(), series.replicates.size() == 1 ? "specimen" : "specimens");
}

// Runs and time of each fit. The runs of a fit are spread over its tests evenly: near enough for a
// plan.
void print_fits(const Study &study, const std::map<std::string, std::optional<RunCost>> &costs,
                int jobs, int cores) {
  if (study.fits.empty()) return;
  fmt::print("fits\n");
  double core_seconds = 0;
  bool known = true, measured = true;
  int runs = 0, most_at_a_time = cores;
  std::vector<std::string> before;
  for (const FitEntry &fit : study.fits) {
    double sum = 0;
    std::vector<std::string> tests, all = fit.targets;
    all.insert(all.end(), fit.predicted.begin(), fit.predicted.end());
    for (const std::string &name : all)
      for (const std::string &test : tests_of(study, study.target(name)))
        if (std::find(tests.begin(), tests.end(), test) == tests.end()) tests.push_back(test);
    for (const std::string &name : tests) {
      const auto &cost = costs.at(name);
      known = known && cost;
      measured = measured && cost && cost->measured;
      sum += cost ? cost->seconds * study.test(name).ranks : 0;
      most_at_a_time = std::min(most_at_a_time, std::max(1, cores / study.test(name).ranks));
    }
    before.push_back(fit.name);
    const int up_to_here = expected_runs(study, before), of_this = up_to_here - runs;
    runs = up_to_here;
    core_seconds += of_this * sum / static_cast<double>(tests.size());
    fmt::print("  {:<14} {}{}: about {} runs\n", fit.name, join(fit.targets),
               fit.predicted.empty() ? "" : "; predicted: " + join(fit.predicted), of_this);
  }
  const int at_a_time = jobs > 0 ? jobs : most_at_a_time;
  if (known)
    fmt::print("total: about {} runs x {} = {} of computing, about {} with {} at a time{}\n", runs,
               in_words(core_seconds / runs), in_words(core_seconds),
               in_words(core_seconds / at_a_time), at_a_time,
               measured ? "" : " (estimate; the first runs will tell)");
  else
    fmt::print("total: about {} runs, {} at a time\n", runs, at_a_time);
}

void check(const Options &options) {
  const Study study = read_study(options.study);
  check_response_functions(study);
  const int jobs = options.jobs > 0 ? options.jobs : study.options.jobs, cores = available_cores();
  check_cores(study, jobs, cores);

  std::unique_ptr<RunStore> store;
  const fs::path file = fs::path(results_directory(options.out, study.name)) / "store.sqlite";
  std::error_code error;
  if (fs::exists(file, error)) store = std::make_unique<RunStore>(file);
  const auto costs = costs_of(study, store.get());

  fmt::print("{}: {}\n", study.name, study.title.empty() ? "(no title)" : study.title);
  print_specimens(study);
  print_tests(study, costs);
  print_identification(study);
  print_fits(study, costs, jobs, cores);
  try {
    find_engine();
  } catch (const UserError &missing) {
    fmt::print("note: {}\n", missing.text());
  }
  fmt::print("{}: nothing wrong\n", options.study);
}

}  // namespace

void add_check(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "check", "look for everything that is wrong with a study, and say how long it will take");
  const auto options = std::make_shared<Options>();
  command->add_option("study", options->study, "study file (TOML)")->required();
  command->add_option("--jobs", options->jobs, "runs at a time; 0: as many as the cores take")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out,
                      "results folder with earlier runs (default: bondlab-results/<study>)");
  command->callback([options] { check(*options); });
}

}  // namespace bondlab
