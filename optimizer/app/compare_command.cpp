// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab compare STUDY`: run the parameter sets of a published table on several packings and
// set our figures beside the published ones.
// Method: every case through every test its quantities name, on packings 0 .. n-1 (the study's seed
// plus the number), all in one batch; the tables are those of published_table.h.
// Units: those of the study's quantities. Failure: a failed run is left out of the mean and counted;
// exit status 2 if a case has no run left, or none with a published figure. Disagreement is a result,
// not a failure: exit status 0, and so is a figure that nobody published and no run gave.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "app/commands.h"
#include "app/published_table.h"
#include "base/write_file.h"
#include "forward/engine_forward_model.h"
#include "forward/interrupt.h"
#include "report/case_plots.h"
#include "report/gnuplot.h"
#include "response/check.h"
#include "response/envelope.h"
#include "response/response.h"
#include "response/run_quality.h"

namespace bondlab {

namespace {

struct Options {
  std::string study, out;
  std::vector<std::string> cases;
  int packings = 0, jobs = 0;
  bool heavy = false;
};

// The tests of what the case expects, or all of them if it expects nothing.
std::set<std::string> tests_of(const Study &study, const PublishedCase &one) {
  std::set<std::string> tests;
  for (const PublishedQuantity &quantity : study.quantities)
    if (one.expected.empty() || one.expected.count(quantity.name))
      for (const std::string &test : tests_of(study, quantity)) tests.insert(test);
  return tests;
}

int packings_of(const Study &study, const PublishedCase &one, const Options &options) {
  if (options.packings > 0) return options.packings;
  return one.packings > 0 ? one.packings : study.case_packings;
}

// How quasi-static the runs were: the worst of each test's.
std::string checks_table(const Study &study, const std::vector<std::string> &tests,
                         const std::vector<ForwardOutcome> &outcomes) {
  std::map<std::string, std::map<std::string, double>> worst;  // by test and figure
  for (std::size_t r = 0; r < outcomes.size(); ++r)
    for (const auto &[name, value] : run_quality(study.test(tests[r]), outcomes[r])) {
      if (quality_words(name).empty()) continue;
      double &so_far = worst[tests[r]][name];
      so_far = std::max(so_far, value);
    }
  if (worst.empty()) return "";
  std::string page = "## Checks of the runs\n\n| test | check | worst of all runs |\n|---|---|---|\n";
  std::string warnings;
  for (const auto &[test, figures] : worst)
    for (const auto &[name, value] : figures) {
      page += fmt::format("| {} | {} | {:.2g} |\n", test, quality_words(name), value);
      if (const std::string warning = quality_warning(name, value); !warning.empty())
        warnings += fmt::format("- {}, the worst run: {}.\n", test, warning);
    }
  return page + "\n" + (warnings.empty() ? "" : warnings + "\n");
}

using RunsOfCase = std::map<std::string, const ForwardOutcome *>;  // on one packing, by the study's test

// SI; a runtime_error says why there is none.
double figure_of(const Study &study, const PublishedQuantity &quantity, const RunsOfCase &runs) {
  if (!quantity.envelope.empty())
    return envelope_figure(envelope_of(study.envelope(quantity.envelope), study, runs), quantity.response);
  const ForwardOutcome &outcome = *runs.at(quantity.test);
  if (!outcome.ok) throw std::runtime_error(outcome.failure.message);
  const auto &response = study.test(quantity.test).definition.responses.at(quantity.response);
  return evaluate(response.function, outcome.curve, {outcome.deck_variables});
}

// Nothing where a test of the quantity wasn't asked for in this case.
void add_figure(const Study &study, const PublishedQuantity &quantity, const RunsOfCase &runs,
                std::map<std::string, PublishedFigure> &figures) {
  bool broke_off = false;
  for (const std::string &test : tests_of(study, quantity)) {
    const auto found = runs.find(test);
    if (found == runs.end()) return;
    broke_off = broke_off || !found->second->ok;
  }
  PublishedFigure &figure = figures[quantity.name];
  try {
    figure.add(figure_of(study, quantity, runs));
  } catch (const std::runtime_error &error) {
    ++figure.failed;
    figure.failed_runs += broke_off;
    figure.trouble = error.what();
  }
}

void compare(const Options &options) {
  const Study study = read_study(options.study);
  check_response_functions(study);
  if (study.cases.empty())
    throw UserError(options.study + ": the study has no [[cases]]; see study.md, \"A published table\"");
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < study.cases.size(); ++k)
    if (options.cases.empty() ? options.heavy || !study.cases[k].heavy
                              : std::find(options.cases.begin(), options.cases.end(), study.cases[k].name) !=
                                    options.cases.end())
      chosen.push_back(k);
  for (const std::string &name : options.cases) {
    bool found = false;
    for (const PublishedCase &one : study.cases) found = found || one.name == name;
    if (!found) throw UserError("--case: there is no case '" + name + "' in " + options.study);
  }

  struct Slot {
    std::size_t case_index;
    std::string test;
    int packing;
  };
  std::vector<ForwardRequest> requests;
  std::vector<Slot> slots;
  for (const std::size_t k : chosen)
    for (const std::string &test : tests_of(study, study.cases[k]))
      for (int packing = 0, packings = packings_of(study, study.cases[k], options); packing < packings; ++packing) {
        requests.push_back({study.cases[k].test(test), deck_variables(study, test, study.cases[k].values), packing});
        slots.push_back({k, test, packing});
      }
  ForwardSettings settings;
  settings.results = results_directory(options.out, study.name);
  settings.engine = find_engine();
  settings.jobs = options.jobs > 0 ? options.jobs : study.options.jobs;
  catch_interrupts();
  EngineForwardModel model(study, settings);
  const std::vector<ForwardOutcome> outcomes = model.run(requests, [](const BatchProgress &) {});

  std::vector<std::string> tests_run;
  std::map<std::pair<std::size_t, int>, RunsOfCase> runs;  // by case and packing
  double seconds = 0;
  int failed = 0;
  for (std::size_t r = 0; r < outcomes.size(); ++r) {
    tests_run.push_back(slots[r].test);
    runs[{slots[r].case_index, slots[r].packing}][slots[r].test] = &outcomes[r];
    seconds += outcomes[r].wall_seconds;
    failed += !outcomes[r].ok;
  }
  PublishedFigures figures(study.cases.size());
  for (const auto &[where, of_case] : runs)
    for (const PublishedQuantity &quantity : study.quantities)
      add_figure(study, quantity, of_case, figures[where.first]);
  PublishedTables tables = published_tables(study, chosen, figures);
  tables.page += checks_table(study, tests_run, outcomes);
  const std::filesystem::path folder = settings.results;
  write_file(folder / "comparison.md", tables.page);
  write_file(folder / "comparison.tsv", tables.tsv);
  fmt::print("{}\n{} runs ({} failed), {:.0f} s of engine time\ntable: {}\n", tables.page, outcomes.size(), failed,
             seconds, (folder / "comparison.md").string());
  std::vector<CaseCurve> curves;
  for (std::size_t r = 0; r < outcomes.size(); ++r)
    if (slots[r].packing == 0 && outcomes[r].ok)
      curves.push_back({slots[r].test, study.cases[slots[r].case_index].name, &outcomes[r].curve});
  if (const auto plot = case_plot(study.title, curves)) {
    const std::filesystem::path pictures = folder / "curves";
    std::filesystem::create_directories(pictures);
    try {
      draw_plot(*plot, pictures);
      fmt::print("curves: {}\n", (pictures / "curves.svg").string());
    } catch (const UserError &error) {
      fmt::print("no picture of the curves: {}\n", error.text());
    }
  }
  for (const std::size_t k : chosen)
    for (const auto &[name, figure] : figures[k])
      if (figure.count == 0 && (figure.failed_runs > 0 || study.cases[k].expected.count(name)))
        throw RunsFailed("the case '" + study.cases[k].name + "' has no figure for " + name + ": " + figure.trouble);
}

}  // namespace

void add_compare(CLI::App &app) {
  CLI::App *command = app.add_subcommand("compare", "run a published table's cases and set our figures beside it");
  const auto options = std::make_shared<Options>();
  command->add_option("study", options->study, "study file (TOML) with [[cases]]")->required();
  command->add_option("--case", options->cases, "only this case; more than once for more")->take_all();
  command->add_option("--packings", options->packings, "packings a case (default: the case's or the study's)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--heavy", options->heavy, "the heavy cases as well, which are otherwise left out");
  command->add_option("--jobs", options->jobs, "runs at a time; 0: as many as the cores take")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out, "results folder (default: bondlab-results/<study>)");
  command->callback([options] { compare(*options); });
}

}  // namespace bondlab
