// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_advice.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/plain_math.h"
#include "diagnose/further_tests.h"

namespace bondlab::diagnose {

namespace {

constexpr double beyond_chance = 3;  // sd of a chi squared

bool is_beyond_chance(double chi2, double expected) {
  return chi2 > expected + beyond_chance * std::sqrt(2 * expected);
}

// Whether what was named fails on the series held out.
bool fails_held_out(const StudyDiagnosis &out) {
  for (const auto &series : out.by_series) {
    if (!series.held_out) continue;
    const double rows = series.rows, before = rows * series.before * series.before,
                 after = rows * series.after * series.after;
    const double allowed = is_beyond_chance(before, rows) ? 0 : margin_needed;
    return is_beyond_chance(after, rows) && after - before >= allowed;
  }
  return false;
}

}  // namespace

void take_back(StudyDiagnosis &out) {
  auto &d = out.diagnosis;
  if (d.effects.empty() || out.cross.after - out.cross.before <= margin_needed) return;
  // Within the noise there is nothing to hold against it: the model made right at a fit has noise
  // of its own there, that of the parameters alone has not.
  if (!is_beyond_chance(out.cross.after, out.cross.floor)) return;
  std::vector<std::string> names;
  for (const auto &named : d.effects) names.push_back(out.catalogue[named.effect].name);
  out.advice.push_back(
      fmt::format("nearest was {}, but series held out in turn are worse with it (chi squared "
                  "{:.1f} before, {:.1f} "
                  "after): it is not named",
                  join(names), out.cross.before, out.cross.after));
  d.verdict = Verdict::not_in_catalogue;
  d.effects.clear();
  d.margin = 0;
}

void give_not_alone(StudyDiagnosis &out) {
  auto &d = out.diagnosis;
  if (d.verdict != Verdict::one || !fails_held_out(out)) return;
  out.advice.push_back(fmt::format(
      "'{}' was best by a margin of {:.1f} in chi squared, but the series held out is no better "
      "with it ({:.2f} before, {:.2f} after): it is not given alone",
      out.catalogue[d.effects.front().effect].name, d.margin, out.gap.holdout_before,
      out.gap.holdout_after));
  for (const auto &tried : d.tried) {
    if (tried.effects.size() != 1 || tried.effects.front() == d.effects.front().effect) continue;
    NamedEffect other;
    other.effect = tried.effects.front();
    other.size = tried.amplitudes.front() * out.catalogue[other.effect].switch_on;
    other.low = other.high = std::numeric_limits<double>::quiet_NaN();
    other.margin = tried.behind;
    d.effects.push_back(other);
  }
  d.verdict = d.effects.size() > 1 ? Verdict::set : Verdict::not_in_catalogue;
  if (d.verdict == Verdict::not_in_catalogue) d.effects.clear();
  d.margin = 0;
}

void advise_tests(StudyModel &model, const std::vector<MeasuredSeries> &measured,
                  StudyDiagnosis &out) {
  const auto &d = out.diagnosis;
  const auto tests = tests_not_measured(model.study(), measured);
  if (d.verdict != Verdict::set || tests.empty()) return;
  std::vector<std::size_t> rivals;
  std::vector<double> amplitudes;
  for (const auto &named : d.effects) {
    rivals.push_back(named.effect);
    amplitudes.push_back(named.size / out.catalogue[named.effect].switch_on);
  }
  const auto specimens =
      static_cast<int>(std::max<Eigen::Index>(1, measured.front().replicates.rows()));
  for (const auto &advice : further_tests(model, tests, specimens, d.model, rivals, amplitudes))
    out.advice.push_back(fmt::format(
        "measuring '{}' on {} specimens would set the two that are hardest to tell apart {:.1f} in "
        "chi squared apart: {}",
        advice.test, specimens, advice.separation,
        advice.enough ? "enough"
                      : fmt::format("not enough (a name takes {:.1f})", 2 * margin_needed)));
}

// The scatter of strengths is among the places where something shows, but explains nothing.
void add_scatter(StudyDiagnosis &out) {
  const auto *worst = out.scatter.worst();
  if (!worst || out.scatter.p >= out.diagnosis.false_alarm) return;
  const double z = -plain_normal_quantile(out.scatter.p / 2);
  out.diagnosis.where.push_back({worst->name, worst->ratio > 1 ? z : -z});
  out.advice.push_back(fmt::format(
      "{}: strengths scatter {:.2f} times as much from specimen to specimen as from packing to "
      "packing of the model (p {:.2g}), which no parameter and no row tells of: {}",
      worst->name, std::sqrt(worst->ratio), out.scatter.p,
      worst->ratio > 1 ? "look at strength_scatter, missing_bonds, open_cracks, and at how alike "
                         "the specimens are"
                       : "the model's grains are too few or too coarse for these specimens"));
}

void advise_on(StudyDiagnosis &out) {
  const auto &d = out.diagnosis;
  if (d.verdict == Verdict::set)
    for (const auto &named : d.effects) {
      const auto &entry = out.catalogue[named.effect];
      out.advice.push_back(entry.name + ": " + entry.separating_test);
    }
  if (d.verdict == Verdict::not_in_catalogue)
    out.advice.push_back(
        "no effect of the catalogue leaves nothing: look at where it shows, repeat that test, or "
        "add an effect as one file in inputs/effects");
  if (d.verdict == Verdict::one || d.verdict == Verdict::two)
    out.advice.push_back("confirm on a test that was not used: " +
                         out.catalogue[d.effects.front().effect].separating_test);
}

}  // namespace bondlab::diagnose
