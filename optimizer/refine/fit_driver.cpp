// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/fit_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "design/latin_hypercube.h"
#include "refine/fit_plan.h"
#include "refine/noise_floor.h"
#include "refine/polish.h"
#include "refine/propose.h"
#include "refine/response_model.h"
#include "refine/summary.h"

namespace bondlab {

namespace {

constexpr int most_starts = 2;
constexpr double small_gain = 2;  // of the misfit: a step of 1.4 sd of the parameters
// Or this share of a misfit that stays, as where targets exclude each other.
constexpr double small_share = 0.1;
constexpr double apart = 0.2;  // of the bounds: starts nearer to one that failed are not tried
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double better_of(double a, double b) { return std::isnan(a) || b < a ? b : a; }

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Driver {
 public:
  Driver(const Study &study, ForwardModel &model, const FitProgressSink &sink)
      : study_(study), space_(study.parameters), evaluator_(study, space_, model), sink_(sink) {
    noise_.assign(study.targets.size(), nan);
    evaluator_.set_progress([this](const BatchProgress &batch) { report(batch); });
  }

  SingleFit fit(const FitEntry &entry, bool first);
  void expect(int runs_after_this_fit) { later_fits_ = runs_after_this_fit; }
  Evaluator &evaluator() { return evaluator_; }
  double wall_seconds() const { return seconds_since(start_); }

 private:
  void make_design(const TargetIndices &targets);
  void measure_noise_at(const TransformedPoint &point);
  void set_weights();
  MarquardtResult search();
  void move_to(const TransformedPoint &point, MarquardtResult &search);
  void settle(MarquardtResult &search);
  void record(const std::string &phase, const MarquardtStep &step);
  void report(const BatchProgress &batch);
  std::optional<TransformedPoint> next_start(const std::vector<TransformedPoint> &tried) const;

  const Study &study_;
  const ParameterSpace space_;
  Evaluator evaluator_;
  const FitProgressSink &sink_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<double> noise_;  // one a target of the study; NaN: not measured
  std::optional<TransformedPoint> noise_centre_;
  int later_fits_ = 0;

  // Of the fit at work:
  FitProblem problem_;
  SingleFit result_;
  std::chrono::steady_clock::time_point fit_start_;
  int runs_before_ = 0, left_in_plan_ = 0;
  std::string phase_;
  std::vector<TransformedPoint> history_points_;  // of result_.history
};

void Driver::report(const BatchProgress &batch) {
  if (!sink_) return;
  FitProgress progress;
  progress.fit = result_.name;
  progress.phase = phase_;
  const auto counts = evaluator_.counts();
  progress.runs_done = counts.forward + batch.done + batch.failed;
  progress.failed = counts.failed + batch.failed;
  const int left =
      std::max(left_in_plan_ - batch.done - batch.failed, batch.total - batch.done - batch.failed) +
      later_fits_;
  progress.runs_expected = progress.runs_done + left;
  if (!result_.history.empty()) progress.best_misfit = result_.history.back().best_misfit;
  const int computed =
      counts.forward - counts.from_store + batch.done + batch.failed - batch.from_store;
  if (computed > 0) progress.seconds_left = left * seconds_since(start_) / computed;
  sink_(progress);
}

void Driver::record(const std::string &phase, const MarquardtStep &step) {
  history_points_.push_back(step.point);
  HistoryEntry entry;
  entry.runs = evaluator_.counts().forward - runs_before_;
  entry.wall_seconds = seconds_since(fit_start_);
  entry.phase = phase;
  entry.misfit = step.misfit;
  entry.accepted = step.accepted;
  entry.parameters = space_.to_physical(step.point).x;
  entry.note = step.note;
  entry.best_misfit =
      better_of(result_.history.empty() ? nan : result_.history.back().best_misfit, step.misfit);
  result_.history.push_back(std::move(entry));
}

// The noise enters the weights; what was recorded before it was known is judged again, so that one
// history has one scale.
void Driver::set_weights() {
  for (std::size_t i = 0; i < problem_.targets.size(); ++i) {
    const std::size_t target = problem_.targets[i];
    problem_.noise[i] = simulation_sd(noise_[target], nan);
    problem_.sd[i] = combined_sd(study_.targets[target].sd, noise_[target]);
  }
  double best = nan;
  for (std::size_t i = 0; i < result_.history.size(); ++i) {
    auto &entry = result_.history[i];
    entry.misfit = misfit(evaluator_, problem_, history_points_[i]);
    entry.best_misfit = best = better_of(best, entry.misfit);
  }
}

void Driver::make_design(const TargetIndices &targets) {
  phase_ = "design";
  std::vector<TransformedPoint> design;
  for (const auto &u : latin_hypercube(study_.options.lhs_points, static_cast<int>(space_.n()),
                                       study_.options.seed))
    design.push_back(space_.to_transformed(space_.from_unit_cube(u)));
  evaluator_.run(design, targets, phase_);
  // All earlier points count: a later fit begins with what the fits before have run.
  const auto known = evaluator_.points();
  for (const auto &point : known) {
    const double value = misfit(evaluator_, problem_, point);
    if (!std::isnan(value)) record(phase_, {point, value, false, ""});
  }
  const auto best = best_point(evaluator_, problem_);
  if (!best) return;
  if (const auto proposal = propose_from_all(evaluator_, problem_, *best)) {
    evaluator_.run({proposal->point}, targets, phase_);
    record(phase_, {proposal->point, misfit(evaluator_, problem_, proposal->point), false,
                    "proposed by a regression over the design points"});
  }
}

void Driver::measure_noise_at(const TransformedPoint &point) {
  phase_ = "noise";
  if (!noise_centre_) noise_centre_ = point;
  TargetIndices unknown;
  for (const std::size_t target : problem_.targets)
    if (std::isnan(noise_[target])) unknown.push_back(target);
  if (unknown.empty()) return;
  const auto floor =
      measure_noise(evaluator_, unknown, *noise_centre_, noise_repeats, study_.options.seed);
  for (const std::size_t target : unknown) noise_[target] = floor.sd[target];
  result_.notes.insert(result_.notes.end(), floor.notes.begin(), floor.notes.end());
}

std::optional<TransformedPoint> Driver::next_start(
    const std::vector<TransformedPoint> &tried) const {
  std::optional<TransformedPoint> best;
  double lowest = 0;
  for (const auto &point : evaluator_.points()) {
    const double cost = misfit_with_prior(evaluator_, problem_, point);
    if (std::isnan(cost) || (best && cost >= lowest)) continue;
    const auto u = unit_positions(space_, point);
    const bool near = std::any_of(tried.begin(), tried.end(), [&](const TransformedPoint &other) {
      const auto v = unit_positions(space_, other);
      double squared = 0;
      for (std::size_t k = 0; k < u.size(); ++k) squared += (u[k] - v[k]) * (u[k] - v[k]);
      return squared < apart * apart;
    });
    if (near) continue;
    best = point;
    lowest = cost;
  }
  return best;
}

MarquardtResult Driver::search() {
  phase_ = "refine";
  MarquardtOptions options;
  options.max_iterations = study_.options.max_iterations;
  options.relative_step = study_.options.difference_step;
  std::optional<MarquardtResult> best;
  std::vector<TransformedPoint> tried;
  for (int attempt = 0; attempt < most_starts; ++attempt) {
    const auto start = next_start(tried);
    if (!start) break;
    record(phase_, {*start, misfit(evaluator_, problem_, *start), true, "start"});
    auto found = marquardt(evaluator_, problem_, *start, options,
                           [this](const MarquardtStep &step) { record(phase_, step); });
    result_.notes.insert(result_.notes.end(), found.notes.begin(), found.notes.end());
    if (!found.converged)
      result_.notes.push_back(fmt::format("the search from start {} stopped before its goal: {}",
                                          attempt + 1, found.ended));
    tried.push_back(*start);
    tried.push_back(found.point);
    const bool better = !best || misfit_with_prior(evaluator_, problem_, found.point) <
                                     misfit_with_prior(evaluator_, problem_, best->point);
    if (better) best = std::move(found);
    // A search that stopped in the noise near a minimum is as good as it gets: settle() looks
    // through the noise.
    const double enough =
        std::max(small_gain, small_share * misfit(evaluator_, problem_, best->point));
    const bool near =
        best->started && !best->jacobian.any_frozen() && best->stationarity.gain < enough;
    // Another start helps where a search got stuck, not where it only ran out of steps.
    if (best->converged || near || best->limit_reached ||
        all_met(evaluator_, problem_, best->point))
      break;
  }
  if (!best) throw FitFailed(fmt::format("fit '{}': no point is left to start from", result_.name));
  return std::move(*best);
}

// A Jacobian for a point that the search didn't end at: the search's own within its steps, else a
// new one.
void Driver::move_to(const TransformedPoint &point, MarquardtResult &search) {
  search.point = point;
  bool near = !search.jacobian.any_frozen();
  for (std::size_t k = 0; k < point.z.size(); ++k)
    near = near && std::fabs(point.z[k] - search.jacobian.point.z[k]) <= search.jacobian.steps[k];
  if (!near) {
    search.jacobian =
        difference_jacobian(evaluator_, problem_, point,
                            difference_steps(space_, problem_, point, search.jacobian.rows,
                                             study_.options.difference_step));
    result_.notes.insert(result_.notes.end(), search.jacobian.notes.begin(),
                         search.jacobian.notes.end());
  }
  hold_at_bounds(evaluator_, problem_, point, search.jacobian);
  search.stationarity = judge_stationarity(evaluator_, problem_, point, search.jacobian);
  search.converged = search.stationarity.stationary;
}

// Takes the best of all runs as the solution, or the smooth minimum where single runs cannot say
// what is best.
void Driver::settle(MarquardtResult &search) {
  phase_ = "polish";
  const auto step = [this](const MarquardtStep &taken) { record(phase_, taken); };
  const auto notes =
      polish(evaluator_, problem_, best_point(evaluator_, problem_).value_or(search.point),
             study_.options.seed, step);
  result_.notes.insert(result_.notes.end(), notes.begin(), notes.end());
  const auto best = best_point(evaluator_, problem_).value_or(search.point);
  if (best.z != search.point.z) move_to(best, search);
  const bool met = all_met(evaluator_, problem_, best);
  if (!met || !search.converged) {
    const auto smooth = smooth_minimum(evaluator_, problem_, best);
    if (smooth && smooth->z != best.z && (!met || all_met(evaluator_, problem_, *smooth))) {
      move_to(*smooth, search);
      result_.notes.push_back(
          "single runs scatter, so the parameter set is the minimum of a regression over the runs "
          "near "
          "the best one; its figures are those of its own run");
    }
  }
  record(phase_,
         {search.point, misfit(evaluator_, problem_, search.point), true, "taken as the solution"});
}

SingleFit Driver::fit(const FitEntry &entry, bool first) {
  fit_start_ = std::chrono::steady_clock::now();
  const FitCounts before = evaluator_.counts();
  runs_before_ = before.forward;
  result_ = SingleFit{};
  history_points_.clear();
  result_.name = entry.name;
  problem_ = FitProblem{};
  problem_.targets = indices_of(study_, entry.targets);
  problem_.noise.resize(problem_.targets.size());
  problem_.sd.resize(problem_.targets.size());
  problem_.prior_sd = study_.options.prior_sd;
  set_weights();
  const TargetIndices predicted = indices_of(study_, entry.predicted);
  TargetIndices all = problem_.targets;
  all.insert(all.end(), predicted.begin(), predicted.end());

  const FitPlan plan = plan_of(study_, entry, first);
  left_in_plan_ = plan.all();
  make_design(all);
  left_in_plan_ -= plan.design;
  const auto best = best_point(evaluator_, problem_);
  if (!best) {
    std::string text = fmt::format("fit '{}': none of {} design points gave all of its targets",
                                   entry.name, evaluator_.points().size());
    if (!evaluator_.points().empty())
      for (const std::size_t target : problem_.targets) {
        const auto value = evaluator_.value(evaluator_.points().front(), target);
        if (!value.had()) text += fmt::format("\n  {}: {}", study_.targets[target].name, value.why);
      }
    throw FitFailed(text);
  }
  measure_noise_at(*best);
  set_weights();
  left_in_plan_ -= plan.noise;
  auto found = search();
  settle(found);
  phase_ = "prediction";
  evaluator_.run({found.point}, all, phase_);
  left_in_plan_ -= plan.refine;
  phase_ = "packings";
  std::vector<int> packings;
  for (int k = 1; k <= study_.options.packings; ++k) packings.push_back(k);
  evaluator_.run({found.point}, packings, all, phase_);
  left_in_plan_ = 0;

  summarise(evaluator_, entry, problem_, noise_, found, result_);
  const FitCounts after = evaluator_.counts();
  result_.runs.forward = after.forward - before.forward;
  result_.runs.from_store = after.from_store - before.from_store;
  result_.runs.failed = after.failed - before.failed;
  result_.runs.run_seconds = after.run_seconds - before.run_seconds;
  result_.runs.wall_seconds = seconds_since(fit_start_);
  return result_;
}

}  // namespace

FitResult run_fits(const Study &study, const std::vector<std::string> &names, ForwardModel &model,
                   const FitProgressSink &progress, const FitCheckpoint &checkpoint) {
  FitResult result;
  result.study = study.name;
  result.title = study.title;
  result.study_file = study.file.string();
  result.tolerance_text = tolerance_in_words();
  for (const auto &parameter : study.parameters) {
    result.parameter_names.push_back(parameter.name);
    result.parameter_units.push_back(parameter.unit);
  }
  Driver driver(study, model, progress);
  const auto chosen = fits_or_all(study, names);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    int later = 0;
    for (std::size_t j = i + 1; j < chosen.size(); ++j)
      later += plan_of(study, study.fit(chosen[j]), false).all();
    driver.expect(later);
    result.fits.push_back(driver.fit(study.fit(chosen[i]), i == 0));
    result.ledger = driver.evaluator().ledger();
    result.runs = driver.evaluator().counts();
    result.runs.wall_seconds = driver.wall_seconds();
    if (checkpoint) checkpoint(result);
  }
  return result;
}

}  // namespace bondlab
