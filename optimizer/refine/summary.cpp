// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "refine/feasibility.h"
#include "refine/polish.h"
#include "refine/uncertainty.h"
#include "response/run_quality.h"

namespace bondlab {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double unlikely = 0.01;           // a joint misfit less probable than this is called one
constexpr double noticeable_noise = 0.005;  // of the measured value: a sixth of what counts as met

TargetResult target_result(const Evaluator &evaluator, std::size_t index, double noise,
                           const TransformedPoint &point, bool in_fit) {
  const auto &target = evaluator.study().targets[index];
  const auto figure = evaluator.value(point, index);
  TargetResult result;
  result.name = target.name;
  result.test = target.test;
  result.envelope = target.envelope;
  result.response = target.response;
  result.unit = target.unit;
  result.measured = target.value;
  result.sd = target.sd;
  result.tolerance = target_tolerance(target);
  result.simulated = figure.value;
  result.why_missing = figure.why;
  result.noise_sd = noise;
  result.packing_mean = result.packing_sd = nan;
  result.in_fit = in_fit;
  result.met = figure.had() && std::fabs(figure.value - target.value) <= result.tolerance;
  result.source = target.source;
  result.sd_source = target.sd_source;
  return result;
}

PackingScatter packing_scatter(const Evaluator &evaluator, std::size_t index,
                               const TransformedPoint &point) {
  const auto &target = evaluator.study().targets[index];
  PackingScatter row;
  row.target = target.name;
  row.unit = target.unit;
  row.reference = evaluator.value(point, index).value;
  for (int k = 1; k <= evaluator.study().options.packings; ++k) {
    const auto figure = evaluator.value(point, index, k);
    if (figure.had())
      row.values.push_back(figure.value);
    else
      ++row.failed;
  }
  const double n = static_cast<double>(row.values.size());
  row.mean = row.values.empty() ? nan : 0.0;
  for (const double value : row.values) row.mean += value / n;
  double sum = 0;
  for (const double value : row.values) sum += (value - row.mean) * (value - row.mean);
  row.sd = row.values.size() < 2 ? nan : std::sqrt(sum / (n - 1));
  return row;
}

void add_outcomes(const Evaluator &evaluator, const TransformedPoint &point, SingleFit &result) {
  const Study &study = evaluator.study();
  std::vector<std::string> tests;
  for (const auto &target : result.targets)
    for (const std::string &test : tests_of(study, study.target(target.name)))
      if (std::find(tests.begin(), tests.end(), test) == tests.end()) tests.push_back(test);
  for (const std::string &test : tests) {
    const auto *outcome = evaluator.outcome(point, test);
    if (!outcome) continue;
    TestOutcome best;
    best.test = test;
    best.outcome = *outcome;
    best.quality = run_quality(study.test(test), *outcome);
    for (const auto &[name, value] : best.quality) {
      const std::string warning = quality_warning(name, value);
      if (warning.empty()) continue;
      Finding finding;
      finding.kind = FindingKind::quality;
      finding.text = fmt::format("test {}: {}", test, warning);
      result.findings.push_back(std::move(finding));
    }
    result.best.push_back(std::move(best));
  }
  for (const EnvelopeEntry &entry : study.envelopes)
    if (auto envelope = evaluator.envelope(point, entry)) result.envelopes.push_back(std::move(*envelope));
}

// Parameters, judged with measurement and packings together.
void add_parameters(const Evaluator &evaluator, const FitProblem &problem,
                    const std::vector<double> &noise, const MarquardtResult &found,
                    SingleFit &result) {
  FitProblem final = problem;
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const double simulated = simulation_sd(noise[problem.targets[i]], result.packings[i].sd);
    final.sd[i] = combined_sd(evaluator.study().targets[problem.targets[i]].sd, simulated);
  }
  const auto rows = standardised(evaluator, final, found.point);
  auto judged = judge_parameters(
      evaluator.space(), final, reweighted(found.jacobian, problem, final), found.point,
      rows.value_or(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(final.sd.size()))));
  result.parameters = std::move(judged.parameters);
  result.correlation = std::move(judged.correlation);
  result.findings.insert(result.findings.end(), judged.ridges.begin(), judged.ridges.end());
  for (const auto &parameter : result.parameters) {
    if (parameter.at_bound == BoundSide::none) continue;
    Finding finding;
    finding.kind = FindingKind::at_bound;
    finding.text = parameter.name + " " + parameter.reason;
    result.findings.push_back(std::move(finding));
  }
}

void add_joint_misfit(const FitProblem &problem, SingleFit &result) {
  if (result.degrees_of_freedom <= 0) return;
  const double p = boost::math::cdf(boost::math::complement(
      boost::math::chi_squared(static_cast<double>(result.degrees_of_freedom)), result.misfit));
  if (p >= unlikely) return;
  Finding finding;
  finding.kind = FindingKind::joint_misfit;
  for (const auto &target : result.targets)
    if (target.in_fit) finding.targets.push_back(target.name);
  finding.measured = result.misfit;
  finding.text = fmt::format(
      "The {} targets together leave a misfit of {:.3g} for {} degree{} of freedom; scatter of "
      "measurement and simulation "
      "alone would give as much with a probability of {:.1g}. The model lacks something that the "
      "specimen has",
      problem.targets.size(), result.misfit, result.degrees_of_freedom,
      result.degrees_of_freedom == 1 ? "" : "s", p);
  result.findings.push_back(std::move(finding));
  result.notes.push_back(
      "the parameters' sd and intervals hold for a model that can meet the targets; with this "
      "misfit "
      "they are too small");
}

// Says how much of the closeness of the best run may be chance.
void add_noise_note(SingleFit &result) {
  std::vector<std::string> scatter;
  for (const auto &target : result.targets)
    if (target.in_fit && target.noise_sd > noticeable_noise * std::fabs(target.measured))
      scatter.push_back(fmt::format("{} by {:.1f} %", target.name,
                                    100 * target.noise_sd / std::fabs(target.measured)));
  if (scatter.empty()) return;
  result.notes.push_back(fmt::format(
      "single runs scatter under tiny changes of the parameters ({} of the measured value, "
      "one sd): part of the closeness of a single run is chance, the other packings "
      "show what the set is worth",
      fmt::join(scatter, ", ")));
}

std::string list_names(const std::vector<std::string> &names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string verdict_in_words(const SingleFit &result) {
  std::vector<std::string> met, missed;
  for (const auto &target : result.targets)
    if (target.in_fit) (target.met ? met : missed).push_back(target.name);
  const std::size_t all = met.size() + missed.size();
  const std::string within = fmt::format("within {:.0f} %", 100 * relative_tolerance);
  std::string text;
  if (missed.empty())
    text = fmt::format("All {} targets of the fit are met {}: {}.", all, within, list_names(met));
  else if (met.empty())
    text = fmt::format("None of the {} targets of the fit is met {}.", all, within);
  else
    text = fmt::format("{} of {} targets of the fit are met {}: {}.", met.size(), all, within,
                       list_names(met));
  for (const auto &target : result.targets)
    if (target.in_fit && !target.met) text += " Not met: " + difference_in_words(target) + ".";
  for (const auto &finding : result.findings) {
    const bool impossible = finding.kind == FindingKind::unreachable_target ||
                            finding.kind == FindingKind::unreachable_ratio;
    // What concerns predicted targets only is a finding, not part of this fit's verdict.
    bool about_fit = impossible;
    for (const auto &name : finding.targets)
      for (const auto &target : result.targets)
        about_fit = about_fit && (target.name != name || target.in_fit);
    if (about_fit) text += " " + finding.text + ".";
  }
  for (const auto &target : result.targets)
    if (!target.in_fit) text += " Predicted, not fitted: " + difference_in_words(target) + ".";
  if (!result.converged) text += " The search did not converge: see the notes.";
  return text;
}

}  // namespace

std::string difference_in_words(const TargetResult &target) {
  const std::string measured = format_quantity(target.measured, target.unit);
  if (!target.why_missing.empty())
    return fmt::format("{} could not be computed ({}); measured {}", target.name,
                       target.why_missing, measured);
  const std::string simulated = format_quantity(target.simulated, target.unit);
  const std::string sds = fmt::format("{:.1f} sd", std::fabs(target.off_in_sd()));
  if (target.measured == 0)
    return fmt::format("{} is {} against {} measured, {}", target.name, simulated, measured, sds);
  return fmt::format("{} is {} against {} measured, {:+.1f} % or {}", target.name, simulated,
                     measured, 100 * target.off(), sds);
}

void summarise(const Evaluator &evaluator, const FitEntry &entry, const FitProblem &problem,
               const std::vector<double> &noise, const MarquardtResult &found, SingleFit &result) {
  const auto &study = evaluator.study();
  result.converged = found.converged;
  result.misfit = misfit(evaluator, problem, found.point);
  result.degrees_of_freedom =
      static_cast<int>(problem.targets.size()) - static_cast<int>(evaluator.space().n());

  TargetIndices all = problem.targets;
  for (const auto &name : entry.predicted)
    for (std::size_t i = 0; i < study.targets.size(); ++i)
      if (study.targets[i].name == name) all.push_back(i);
  result.all_met = true;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool in_fit = i < problem.targets.size();
    auto target = target_result(evaluator, all[i], noise[all[i]], found.point, in_fit);
    auto row = packing_scatter(evaluator, all[i], found.point);
    target.packing_mean = row.mean;
    target.packing_sd = row.sd;
    if (in_fit && !target.met) result.all_met = false;
    result.targets.push_back(std::move(target));
    result.packings.push_back(std::move(row));
  }

  std::vector<std::string> names = entry.targets;
  names.insert(names.end(), entry.predicted.begin(), entry.predicted.end());
  result.findings = judge_feasibility(study, names, evaluator.ledger());
  add_joint_misfit(problem, result);
  add_noise_note(result);
  add_outcomes(evaluator, found.point, result);
  add_parameters(evaluator, problem, noise, found, result);
  for (const auto &failure : evaluator.failures()) {
    Finding finding;
    finding.kind = FindingKind::failure;
    finding.text = fmt::format("a forward run failed ({}): {}; kept in {}; again: {}",
                               to_string(failure.cause), failure.message, failure.run_directory,
                               failure.command);
    result.findings.push_back(std::move(finding));
  }
  result.verdict = verdict_in_words(result);
}

}  // namespace bondlab
