// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab fit STUDY`: identify the parameters of a study and write result.json and the
//   report.
// Method: all of the study's [[fits]] in their order, or those named. result.json is written after
//   each fit, the report at the end; runs are kept in the result's directory, so that the same
//   command goes on where it was cut off.
// Units: none of its own. Failure: exit status as in commands.h; when a later fit fails, the result
//   of those before is there.
#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "base/units.h"
#include "forward/engine_forward_model.h"
#include "forward/interrupt.h"
#include "refine/evaluator.h"
#include "refine/fit_driver.h"
#include "report/from_fit.h"
#include "report/report.h"
#include "report/result_json.h"
#include "response/check.h"
#include "study/study.h"

namespace bondlab {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string study, out;
  std::vector<std::string> fits;
  int jobs = 0;
};

std::string time_in_words(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 5400) return fmt::format("{:.0f} min", std::ceil(seconds / 60));
  return fmt::format("{:.1f} h", seconds / 3600);
}

// One line that is written over on a terminal; in a log, a new line twice a minute.
class ProgressLine {
 public:
  ~ProgressLine() { clear(); }

  void show(const FitProgress &progress) {
    const auto now = std::chrono::steady_clock::now();
    const auto pause =
        terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(30000);
    if (shown_ && now - last_ < pause) return;
    last_ = now;
    std::string line = fmt::format("fit {}, {}: {} of about {} runs", progress.fit, progress.phase,
                                   progress.runs_done, progress.runs_expected);
    if (progress.failed > 0) line += fmt::format(" ({} failed)", progress.failed);
    if (progress.best_misfit >= 0)
      line += fmt::format(", best misfit {:.3g}", progress.best_misfit);
    if (progress.seconds_left >= 0)
      line += fmt::format(", about {} left", time_in_words(progress.seconds_left));
    if (terminal_)
      fmt::print(stderr, "\r\033[K{}", line);
    else
      fmt::print(stderr, "{}\n", line);
    std::fflush(stderr);
    shown_ = true;
  }

  void clear() {
    if (terminal_ && shown_) fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
    shown_ = false;
  }

 private:
  const bool terminal_ = ::isatty(STDERR_FILENO);
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

std::string quoted(const std::string &text) {
  const bool plain = text.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/+=") ==
                     std::string::npos;
  return plain && !text.empty() ? text : "'" + text + "'";
}

std::string replay_of(const Options &options) {
  std::string command = "bondlab fit " + quoted(options.study);
  for (const auto &fit : options.fits) command += " --fit " + quoted(fit);
  if (!options.out.empty()) command += " --out " + quoted(options.out);
  return command;
}

// STUDY_fine.toml beside STUDY.toml is the same study at a finer resolution, there to confirm a
// result.
std::string confirm_command(const Study &study, const SingleFit &fit) {
  const fs::path fine = study.file.parent_path() / (study.file.stem().string() + "_fine.toml");
  if (!fs::exists(fine)) return "";
  std::string command = "bondlab run " + quoted(fine.string());
  for (const auto &parameter : fit.parameters)
    command += fmt::format(" --set {}=\"{}\"", parameter.name,
                           format_quantity(parameter.value, parameter.unit, 6));
  return command;
}

void print_summary(const FitResult &result) {
  for (const auto &fit : result.fits) {
    fmt::print("fit {}: {}\n", fit.name, fit.verdict);
    for (const auto &p : fit.parameters) {
      const std::string sd =
          std::isnan(p.sd) ? "not identifiable" : "sd " + format_quantity(p.sd, p.unit, 2);
      fmt::print("  {:<10} {:<14} {}{}\n", p.name, format_quantity(p.value, p.unit), sd,
                 p.reason.empty() ? "" : ": " + p.reason);
    }
  }
  fmt::print("runs: {} ({} from the store, {} failed), {}\n", result.runs.forward,
             result.runs.from_store, result.runs.failed, time_in_words(result.runs.wall_seconds));
}

void fit(const Options &options) {
  const Study study = read_study(options.study);
  check_response_functions(study);
  if (study.fits.empty())
    throw UserError(Place{options.study, 0, 0}, "there is no [[fits]] in this study");
  for (const auto &name : options.fits)
    study.fit(name);  // a name that isn't there is an error before anything runs

  const fs::path out = results_directory(options.out, study.name);
  ForwardSettings settings;
  settings.results = out;
  settings.engine = find_engine();
  settings.jobs = options.jobs > 0 ? options.jobs : study.options.jobs;
  catch_interrupts();
  EngineForwardModel model(study, settings);

  ReportInput input;
  const auto keep = [&](const FitResult &so_far) {
    FitResult result = so_far;
    result.replay = replay_of(options);
    input = report_input(study, result, out);
    input.confirm_command = confirm_command(study, result.fits.front());
    write_result(input, out);
  };
  FitResult result;
  {
    ProgressLine line;
    try {
      result = run_fits(
          study, options.fits, model, [&](const FitProgress &progress) { line.show(progress); },
          keep);
    } catch (const FitFailed &failed) {
      line.clear();
      throw RunsFailed(failed.what());
    }
  }
  const fs::path page = write_report(input, out);
  print_summary(result);
  fmt::print("report: {}\n", page.string());
}

}  // namespace

void add_fit(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "fit", "Identify a study's parameters and write result.json and report.html");
  const auto options = std::make_shared<Options>();
  command->add_option("STUDY", options->study, "study file (TOML)")->required();
  command
      ->add_option("--fit", options->fits,
                   "name of a fit of the study; may be repeated (default: all, in order)")
      ->allow_extra_args(false);
  command
      ->add_option("--jobs", options->jobs,
                   "forward runs at a time (default: as many as the cores take)")
      ->check(CLI::PositiveNumber);
  command->add_option("--out", options->out,
                      "directory of the results (default: bondlab-results/STUDY-NAME)");
  command->callback([options] { fit(*options); });
}

}  // namespace bondlab
