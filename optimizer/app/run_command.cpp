// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab run STUDY`: one point of a study through its tests, with the responses beside what
// was measured. Method: parameters have their start values unless --set gives others (also outside
// the bounds, which are the fit's); runs
//   go through the study's run store, so that a point known already costs nothing. --half-speed runs
//   every test a second time with its platens at half the speed and shows what that shifts: the part
//   of a response that is the run's haste and not the specimen's (some per cent are usual for a
//   strength, 1 % for a modulus; more means that the speed is too high). Below the responses of every
//   run stand how far it was from rest, below the tests the study's envelopes with a picture of them.
//   All of it goes into run.json, too (run_record.h).
// Units: --set takes quantities with units; responses are shown in the units of their targets.
// Failure: exit status 2 with
//   cause, folder and last log lines when a run fails.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/progress_line.h"
#include "app/run_record.h"
#include "base/units.h"
#include "base/write_file.h"
#include "forward/engine_forward_model.h"
#include "forward/interrupt.h"
#include "forward/run_plan.h"
#include "report/envelope_plot.h"
#include "report/from_fit.h"
#include "report/gnuplot.h"
#include "response/check.h"
#include "response/response.h"
#include "response/run_quality.h"
#include "study/parameter_space.h"

namespace bondlab {

namespace {

struct Options {
  std::string study, out;
  std::vector<std::string> set, tests;
  int packing = 0, jobs = 0;
  bool half_speed = false;
};

// "E_c=25 GPa" into the values, which stand in the order of the study's parameters.
void set_parameter(const Study &study, const std::string &text, std::vector<double> &values) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw UserError("--set '" + text + "': write NAME=VALUE, for example E_c=\"25 GPa\"");
  const std::string name = text.substr(0, equals);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    names.push_back(study.parameters[i].name);
    if (study.parameters[i].name != name) continue;
    try {
      values[i] = parse_quantity(text.substr(equals + 1), study.parameters[i].unit);
    } catch (const UnitError &error) {
      throw UserError("--set " + name + ": " + error.text());
    }
    return;
  }
  const std::string near = nearest_word(name, names);
  throw UserError("--set: the study has no parameter '" + name + "'" +
                  (near.empty() ? "" : " (did you mean '" + near + "'?)") +
                  "; it has: " + (names.empty() ? "none" : join(names)));
}

const Target *target_of(const Study &study, const std::string &test, const std::string &response) {
  for (const Target &target : study.targets)
    if (target.test == test && target.response == response) return &target;
  return nullptr;
}

std::string beside_measured(const Target &target, double value) {
  return fmt::format("measured {}, {:+.1f} %, {:+.1f} sd", format_quantity(target.value, target.unit),
                     100 * (value / target.value - 1), (value - target.value) / target.sd);
}

// The platens' speed in a deck; empty where nothing is driven (impact).
std::string speed_variable(const TestEntry &test) {
  for (const char *name : {"platen_speed", "shear_speed"})
    if (test.definition.variables.count(name)) return name;
  return "";
}

// How far a response moves when the platens go half as fast.
std::string shift_at_half_speed(const std::string &function, double value, const ForwardOutcome &half) {
  if (!half.ok) return "half speed: " + half.failure.message;
  try {
    return fmt::format("half speed {:+.1f} %", 100 * (evaluate(function, half.curve, {half.deck_variables}) / value - 1));
  } catch (const ResponseError &error) {
    return std::string("half speed: none: ") + error.what();
  }
}

void print_responses(const Study &study, const TestEntry &test, const ForwardOutcome &outcome,
                     const ForwardOutcome *half) {
  fmt::print("{}: run {}, {:.1f} s{}{}\n", test.name, outcome.run_id, outcome.wall_seconds,
             outcome.from_store ? " (from the store)" : "",
             outcome.cost ? ", " + cost_text(*outcome.cost) : "");
  for (const auto &[name, response] : test.definition.responses) {
    const Target *target = target_of(study, test.name, name);
    std::string shown, beside;
    try {
      const double value = evaluate(response.function, outcome.curve, {outcome.deck_variables});
      const std::string unit = target ? target->unit : readable_unit(value, response.unit);
      shown = format_quantity(value, unit);
      if (target)
        beside = beside_measured(*target, value);
      if (half) beside += (beside.empty() ? "" : "; ") + shift_at_half_speed(response.function, value, *half);
    } catch (const ResponseError &error) {
      shown = std::string("none: ") + error.what();
    }
    fmt::print("  {:<16} {:<16} {}\n", name, shown, beside);
  }
  std::string checks, warnings;
  for (const auto &[name, value] : run_quality(test, outcome)) {
    if (const std::string words = quality_words(name); !words.empty())
      checks += fmt::format("{}{} {:.2g}", checks.empty() ? "" : "; ", words, value);
    if (const std::string warning = quality_warning(name, value); !warning.empty())
      warnings += "  note: " + warning + "\n";
  }
  if (!checks.empty()) fmt::print("  checks: {}\n{}", checks, warnings);
  fmt::print("  {}\n  replay: {}\n", outcome.run_directory, outcome.replay_command);
}

// The study's envelopes through these tests; those of which no test was asked for are left out.
std::vector<StrengthEnvelope> envelopes_through(const Study &study, const std::vector<std::string> &tests,
                                        const std::vector<ForwardOutcome> &outcomes) {
  std::map<std::string, const ForwardOutcome *> by_test;
  for (std::size_t i = 0; i < tests.size(); ++i) by_test[tests[i]] = &outcomes[i];
  std::vector<StrengthEnvelope> envelopes;
  for (const EnvelopeEntry &entry : study.envelopes)
    if (std::any_of(entry.tests.begin(), entry.tests.end(),
                    [&](const std::string &test) { return by_test.count(test) > 0; }))
      envelopes.push_back(envelope_of(entry, study, by_test));
  return envelopes;
}

// The figures of an envelope that the study has targets for.
void print_targets(const Study &study, const StrengthEnvelope &envelope) {
  for (const Target &target : study.targets) {
    if (target.envelope != envelope.name) continue;
    try {
      const double value = envelope_figure(envelope, target.response);
      fmt::print("  {:<16} {:<16} {}\n", target.response, format_quantity(value, target.unit),
                 beside_measured(target, value));
    } catch (const ResponseError &error) {
      fmt::print("  {:<16} none: {}\n", target.response, error.what());
    }
  }
}

void show_envelopes(const Study &study, const std::vector<StrengthEnvelope> &envelopes,
                    const std::filesystem::path &folder) {
  if (envelopes.empty()) return;
  std::vector<ReportEnvelope> drawn;
  for (const StrengthEnvelope &envelope : envelopes) {
    drawn.push_back(report_envelope(study, envelope));
    fmt::print("envelope {}: {}\n", envelope.name, envelope_text(envelope));
    print_targets(study, envelope);
    for (const EnvelopePoint &point : envelope.points)
      fmt::print("  {:<16} {} {}, {} {}\n", point.test, envelope.over,
                 format_quantity(point.over, envelope.unit), envelope.response,
                 format_quantity(point.value, envelope.unit));
    for (const std::string &sentence : envelope.left_out) fmt::print("  left out: {}\n", sentence);
  }
  try {
    const Plot plot = envelope_plot(drawn);
    draw_plot(plot, folder);
    fmt::print("  {}\n", (folder / (plot.name + ".svg")).string());
  } catch (const UserError &error) {
    fmt::print("  no picture: {}\n", error.text());
  }
}

void run(const Options &options) {
  const Study study = read_study(options.study);
  check_response_functions(study);
  std::vector<double> values = ParameterSpace(study.parameters).start().x;
  for (const std::string &text : options.set) set_parameter(study, text, values);
  std::vector<std::string> tests = options.tests;
  if (tests.empty())
    for (const TestEntry &test : study.tests) tests.push_back(test.name);
  std::vector<ForwardRequest> requests;
  for (const std::string &test : tests)
    requests.push_back({test, deck_variables(study, test, values), options.packing});
  const std::size_t asked = requests.size();
  std::vector<std::size_t> half(asked, 0);  // where the run at half the speed stands; 0: nowhere
  for (std::size_t i = 0; options.half_speed && i < asked; ++i) {
    const std::string speed = speed_variable(study.test(tests[i]));
    if (speed.empty()) continue;
    ForwardRequest slow = requests[i];
    slow.variables[speed] = 0.5 * plan_run(study, requests[i]).numeric.at(speed);
    half[i] = requests.size();
    requests.push_back(slow);
  }

  ForwardSettings settings;
  settings.results = results_directory(options.out, study.name);
  settings.engine = find_engine();
  settings.jobs = options.jobs > 0 ? options.jobs : study.options.jobs;
  catch_interrupts();
  EngineForwardModel model(study, settings);
  std::vector<ForwardOutcome> outcomes;
  {
    ProgressLine line;
    outcomes = model.run(requests, [&](const BatchProgress &progress) { line.show(progress); });
  }

  for (std::size_t i = 0; i < study.parameters.size(); ++i)
    fmt::print("{:<18} {}\n", study.parameters[i].name,
               format_quantity(values[i], study.parameters[i].unit, 6));
  std::string failures;
  for (std::size_t i = 0; i < asked; ++i) {
    if (outcomes[i].ok) {
      print_responses(study, study.test(tests[i]), outcomes[i], half[i] ? &outcomes[half[i]] : nullptr);
      continue;
    }
    const Failure &failure = outcomes[i].failure;
    failures += fmt::format("{}the test '{}' failed ({}): {}", failures.empty() ? "" : "\n",
                            tests[i], to_string(failure.cause), failure.message);
    if (!failure.run_directory.empty())
      failures +=
          fmt::format("\n  kept in {}\n  replay: {}", failure.run_directory, failure.command);
    if (!failure.log_tail.empty()) failures += "\n  last lines of its log:\n" + failure.log_tail;
  }
  const std::vector<StrengthEnvelope> envelopes = envelopes_through(study, tests, outcomes);
  const std::filesystem::path folder = settings.results;
  show_envelopes(study, envelopes, folder);
  write_file(folder / "run.json", run_record(study, values, tests, outcomes, envelopes));
  if (!failures.empty()) throw RunsFailed(failures);
}

}  // namespace

void add_run(CLI::App &app) {
  CLI::App *command = app.add_subcommand("run", "run one point of a study and show its responses");
  const auto options = std::make_shared<Options>();
  command->add_option("study", options->study, "study file (TOML)")->required();
  command
      ->add_option("--set", options->set,
                   "a parameter's value, such as E_c=\"25 GPa\"; more than once for more")
      ->take_all();
  command->add_option("--test", options->tests, "only this test; more than once for more")
      ->take_all();
  command
      ->add_option("--packing", options->packing,
                   "another packing: the study's seed plus this number")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--half-speed", options->half_speed,
                    "run each test at half the speed as well and show what that shifts");
  command->add_option("--jobs", options->jobs, "runs at a time; 0: as many as the cores take")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out, "results folder (default: bondlab-results/<study>)");
  command->callback([options] { run(*options); });
}

}  // namespace bondlab
