// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_advice.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/further_tests.h"

namespace bondlab::diagnose {

namespace {

constexpr double beyond_chance = 3;  // sd of a chi squared

// Whether what was named fails on the series held out.
bool fails_held_out(const StudyDiagnosis &out) {
  for (const auto &series : out.by_series) {
    if (!series.held_out) continue;
    const double rows = series.rows, before = rows * series.before * series.before,
                 after = rows * series.after * series.after;
    const bool open = before > rows + beyond_chance * std::sqrt(2 * rows);
    return after - before > margin_needed || (open && after >= before);
  }
  return false;
}

}  // namespace

void take_back(StudyDiagnosis &out) {
  auto &d = out.diagnosis;
  if (d.effects.empty() || out.cross.after - out.cross.before <= margin_needed) return;
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
