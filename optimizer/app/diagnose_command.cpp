// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab diagnose STUDY`: is it the parameters or the model, and what is missing.
//   `bondlab hide STUDY`: make data in which an effect is hidden, to try the other on.
// Method: see optimizer/diagnose/diagnose.md. Runs are kept in the result's directory, so that the
//   same command goes on where it was cut off.
// Units: --size in the effect's own SI unit. Failure: exit status as in commands.h.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/progress_line.h"
#include "report/diagnosis_files.h"
#include "report/trial_table.h"
#include "diagnose/hidden_trial.h"
#include "diagnose/hide.h"
#include "forward/engine_forward_model.h"
#include "forward/interrupt.h"
#include "response/check.h"
#include "study/input_folders.h"

namespace bondlab {

namespace {

namespace fs = std::filesystem;

struct Common {
  std::string study, out;
  std::vector<std::string> effects;  // folders
  int jobs = 0;
};

// `came` are the folders below inputs/ that are read when none is named.
std::vector<EffectDefinition> effects_from(const std::vector<std::string> &named,
                                           const std::vector<fs::path> &came) {
  std::vector<fs::path> folders(named.begin(), named.end());
  for (const auto &inputs : input_folders())
    for (const auto &folder : came)
      if (folders.size() < came.size() && named.empty() && fs::is_directory(inputs / folder))
        folders.push_back(inputs / folder);
  if (folders.empty())
    throw UserError("--effects: no folder of effects came with this program; name one");
  std::vector<EffectDefinition> effects;
  for (const auto &folder : folders)
    for (auto &effect : read_effects(folder)) {
      for (const auto &other : effects)
        if (other.name == effect.name)
          throw UserError(effect.place,
                          "effect '" + effect.name + "' is also in " + other.place.file);
      effects.push_back(std::move(effect));
    }
  return effects;
}

// Those of these names, each of which must be there.
std::vector<EffectDefinition> only_these(std::vector<EffectDefinition> effects,
                                         const std::vector<std::string> &names) {
  if (names.empty()) return effects;
  std::vector<std::string> known;
  for (const auto &effect : effects) known.push_back(effect.name);
  for (const auto &name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UserError("--only: there is no effect '" + name + "' (allowed: " + join(known) + ")");
  effects.erase(std::remove_if(effects.begin(), effects.end(),
                               [&](const EffectDefinition &effect) {
                                 return std::find(names.begin(), names.end(), effect.name) ==
                                        names.end();
                               }),
                effects.end());
  return effects;
}

diagnose::ModelFactory engine_on(const Study &study, const fs::path &results, int jobs) {
  ForwardSettings settings;
  settings.results = results;
  settings.engine = find_engine();
  settings.jobs = jobs > 0 ? jobs : study.options.jobs;
  return [settings](const Study &expanded) {
    return std::make_unique<EngineForwardModel>(expanded, settings);
  };
}

void add_common(CLI::App &command, Common &common) {
  command.add_option("STUDY", common.study, "study file (TOML)")->required();
  command.add_option(
      "--effects", common.effects,
      "folder of effects, may be given again (default: those that came with BondLab)");
  command.add_option("--jobs", common.jobs, "forward runs at a time")->check(CLI::PositiveNumber);
}

struct Diagnosing : Common {
  std::string data;
  int rounds = 1;
  std::vector<std::string> only;  // names of effects; empty: all
  diagnose::StudyDiagnosisOptions options;
};

// Whether the model with what was named is another one to diagnose: an error of measuring is mended
// in the data, and a set is not for a program to choose from.
bool goes_on(const diagnose::StudyDiagnosis &result) {
  const auto &d = result.diagnosis;
  if (d.verdict != diagnose::Verdict::one && d.verdict != diagnose::Verdict::two) return false;
  return std::all_of(d.effects.begin(), d.effects.end(), [&](const diagnose::NamedEffect &e) {
    return result.effects[e.effect].scales_test.empty();
  });
}

void run_diagnose(const Diagnosing &asked) {
  Study study = read_study(asked.study);
  check_response_functions(study);
  if (!asked.data.empty()) study.data = read_data_folder(asked.data);
  const auto effects = only_these(effects_from(asked.effects, {"effects"}), asked.only);
  const fs::path first = results_directory(asked.out, study.name);
  catch_interrupts();
  ProgressLine line;
  diagnose::StudySinks sinks;
  sinks.progress = [&](const BatchProgress &progress) { line.show(progress); };
  sinks.say = [](const std::string &line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  for (int round = 1;; ++round) {
    const fs::path out = round == 1 ? first : first / fmt::format("round_{}", round);
    const auto result = diagnose::diagnose_study(study, effects, engine_on(study, out, asked.jobs),
                                                 asked.options, sinks);
    const auto file = diagnose::write_diagnosis(study, result, out);
    fmt::print("\n{}\npage: {}\n", diagnose::diagnosis_text(study, result),
               (out / "diagnosis.html").string());
    if (!goes_on(result)) return;
    const std::string again = fmt::format("bondlab diagnose {}{}", file.string(),
                                          asked.data.empty() ? "" : " --data " + asked.data);
    if (round == asked.rounds) {
      fmt::print("is anything left? {}\n", again);
      return;
    }
    fmt::print("\nround {}, with what was named: {}\n", round + 1, again);
    auto data = std::move(study.data);
    study = read_study(file);
    study.data = std::move(data);
  }
}

struct Hiding : Common {
  diagnose::HideOptions options;
};

void run_hide(Hiding asked) {
  if (asked.options.effects == std::vector<std::string>{"none"}) asked.options.effects.clear();
  if (asked.options.effects.empty()) asked.options.sizes.clear();
  const Study study = read_study(asked.study);
  check_response_functions(study);
  const auto effects = effects_from(asked.effects, {"effects", "hidden/outside"});
  catch_interrupts();
  ProgressLine line;
  // Not in the data folder: what was run would tell what is hidden.
  const fs::path runs = fs::path(asked.out).lexically_normal().string() + ".runs";
  diagnose::hide_effect(study, effects, engine_on(study, runs, asked.jobs), asked.options,
                        asked.out, [&](const BatchProgress &progress) { line.show(progress); });
  fmt::print("data: {}\ntruth, not for diagnose: {}\n", asked.out,
             (fs::path(asked.out) / "sealed_truth.json").string());
}

struct Trying {
  std::string set, out;
  std::vector<std::string> effects, outside;  // folders
  int jobs = 0;
  diagnose::TrialOptions options;
};

void run_trial_command(const Trying &asked) {
  const auto set = diagnose::read_hidden_set(asked.set);
  const Study laboratory = read_study(set.laboratory);
  check_response_functions(laboratory);
  const auto catalogue = effects_from(asked.effects, {"effects"});
  const auto outside = effects_from(asked.outside, {"hidden/outside"});
  for (const auto &id : asked.options.only)
    if (std::none_of(set.cases.begin(), set.cases.end(),
                     [&](const diagnose::HiddenCase &c) { return c.id == id; }))
      throw UserError("--case: '" + id + "' is not in " + asked.set);
  catch_interrupts();
  diagnose::TrialOptions options = asked.options;
  options.out = results_directory(asked.out, "trial");
  options.diagnosis.holdout = "none";
  ProgressLine line;
  options.progress = [&](const BatchProgress &progress) { line.show(progress); };
  std::vector<diagnose::TrialCase> done;
  const auto say = [](const std::string &line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  diagnose::run_trial(
      set, laboratory, catalogue, outside,
      [&](const fs::path &folder) { return engine_on(laboratory, folder, asked.jobs); }, options,
      say,
      [&](const diagnose::TrialCase &trial) {
        done.push_back(trial);
        say(diagnose::trial_line(trial));
        diagnose::write_trial(done, options.out);
      });
  fmt::print("\n{}\ntable: {}\n", diagnose::trial_markdown(done),
             (options.out / "trial.md").string());
}

}  // namespace

void add_diagnose(CLI::App &app) {
  CLI::App *command =
      app.add_subcommand("diagnose", "Is it the parameters or the model? Name what is missing");
  const auto asked = std::make_shared<Diagnosing>();
  add_common(*command, *asked);
  command->add_option("--out", asked->out,
                      "directory of the results (default: bondlab-results/STUDY-NAME)");
  command->add_option("--data", asked->data, "data folder instead of the study's own");
  command
      ->add_option("--only", asked->only,
                   "effects that are tried, with commas between (default: all of the folders)")
      ->delimiter(',');
  command->add_option("--holdout", asked->options.holdout,
                      "series not used until the end, or none (default: the last of five or more)");
  command
      ->add_option("--packings", asked->options.packings, "packings that differences are taken on")
      ->check(CLI::Range(4, 100));
  command
      ->add_option("--scatter", asked->options.scatter,
                   "packings of the model's mean and its scatter")
      ->check(CLI::Range(6, 1000));
  command->add_option("--seed", asked->options.seed, "of the null and the resamples");
  command
      ->add_option(
          "--rounds", asked->rounds,
          "diagnose the model with what was named again, until nothing is named, so many times")
      ->check(CLI::Range(1, 9));
  command->callback([asked] { run_diagnose(*asked); });
}

void add_hide(CLI::App &app) {
  CLI::App *command =
      app.add_subcommand("hide", "Make laboratory data in which an effect is hidden");
  const auto asked = std::make_shared<Hiding>();
  add_common(*command, *asked);
  command
      ->add_option("--effect", asked->options.effects,
                   "name of the effect, or of two with a comma between, or none")
      ->delimiter(',')
      ->required();
  command->add_option("--size", asked->options.sizes, "size of each, SI")->delimiter(',');
  command
      ->add_option("--spread", asked->options.spread,
                   "sd of the parameters about the study's starts, on the scale of the fit")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--seed", asked->options.seed, "of parameters, packings and sensors")
      ->check(CLI::Range(0, 9999));
  command->add_option("--replicates", asked->options.replicates, "specimens a test")
      ->check(CLI::Range(2, 99));
  command->add_option("--out", asked->out, "data folder to write")->required();
  command->callback([asked] { run_hide(*asked); });
}

void add_trial(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "trial", "Hide the effects of a set one by one, and see whether diagnose finds them");
  const auto asked = std::make_shared<Trying>();
  command->add_option("SET", asked->set, "hidden set (TOML)")->required();
  command->add_option("--out", asked->out,
                      "directory of the results (default: bondlab-results/trial)");
  command->add_option("--effects", asked->effects,
                      "folder of the catalogue, may be given again (default: inputs/effects)");
  command->add_option("--outside", asked->outside,
                      "folder of what the catalogue lacks (default: inputs/hidden/outside)");
  command->add_option("--case", asked->options.only, "id of a case; may be given again")
      ->delimiter(',');
  command->add_option("--jobs", asked->jobs, "forward runs at a time")->check(CLI::PositiveNumber);
  command->add_flag("--confirm", asked->options.confirm,
                    "run the engine itself at the fits before and after");
  command
      ->add_option("--packings", asked->options.diagnosis.packings,
                   "packings that differences are taken on")
      ->check(CLI::Range(4, 100));
  command
      ->add_option("--scatter", asked->options.diagnosis.scatter,
                   "packings of the model's mean and its scatter")
      ->check(CLI::Range(6, 1000));
  command->callback([asked] { run_trial_command(*asked); });
}

}  // namespace bondlab
