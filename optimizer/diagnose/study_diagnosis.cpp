// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_diagnosis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "base/random.h"
#include "base/units.h"
#include "diagnose/comparators.h"
#include "diagnose/null_table.h"
#include "diagnose/omnibus.h"
#include "diagnose/row_selection.h"
#include "diagnose/study_null.h"

namespace bondlab::diagnose {

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr int null_draws = 2000, placebo_draws = 200, most_moves = 5;
constexpr std::size_t least_for_holdout = 5;
constexpr int most_rounds = 3;
constexpr double contender = 40;            // behind the best in deviance
constexpr double size_low = 5, size_aim = 8;  // noise units that an effect is switched on at
constexpr double longest_growth = 8;
constexpr double alarm_rate = 0.01, table_size = 10;

std::string choose_holdout(const std::vector<MeasuredSeries> &series, const std::string &wanted) {
  if (wanted == "none") return "";
  if (wanted.empty()) return series.size() >= least_for_holdout ? series.back().probed.name : "";
  std::vector<std::string> names;
  for (const auto &s : series) names.push_back(s.probed.name);
  if (std::find(names.begin(), names.end(), wanted) == names.end())
    throw UserError("--holdout: nothing named '" + wanted +
                    "' was measured (allowed: " + join(names) + ", none)");
  if (series.size() < 2)
    throw UserError("--holdout: this is all that was measured, nothing would be left to diagnose");
  return wanted;
}

double rms(const Eigen::VectorXd &residual) {
  return residual.size() == 0 ? nan_value
                              : std::sqrt(residual.squaredNorm() /
                                          static_cast<double>(residual.size()));
}

// The rows of a data set among the model's, and those that are not held out.
struct Parts {
  std::vector<MeasuredSeries> training;
  std::vector<Eigen::Index> all_rows, training_rows;
};

Parts split(const std::vector<MeasuredSeries> &all, const std::vector<Eigen::Index> &rows,
            const std::string &holdout) {
  Parts out;
  out.all_rows = rows;
  auto next = rows.begin();
  for (const auto &s : all) {
    const auto end = next + static_cast<std::ptrdiff_t>(s.probed.quantities.size());
    if (s.probed.name != holdout) {
      out.training.push_back(s);
      out.training_rows.insert(out.training_rows.end(), next, end);
    }
    next = end;
  }
  return out;
}

void isolability(const ScoreTable &scores, StudyDiagnosis &out) {
  const auto count = out.catalogue.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (scores.hidden(i)) {
      out.hidden.push_back(out.catalogue[i].name);
      continue;
    }
    for (std::size_t j = i + 1; j < count; ++j) {
      if (scores.hidden(j)) continue;
      const double cosine =
          scores.cosines()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      const double chance = confusion_chance(cosine, table_size);
      if (chance > 0.05)
        out.isolability.push_back({out.catalogue[i].name, out.catalogue[j].name, cosine, chance});
    }
  }
  std::sort(out.isolability.begin(), out.isolability.end(),
            [](const Confusable &a, const Confusable &b) { return a.chance > b.chance; });
}

std::vector<double> physical_sd(const ParameterSpace &space, const Refit &fit) {
  std::vector<double> out;
  for (std::size_t i = 0; i < space.n(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out.push_back(std::abs(space.dx_dz(i, fit.point.z(k))) * std::sqrt(fit.covariance(k, k)));
  }
  return out;
}

// Gap after the refit of the parameters and a placebo, over the rows judged: those held out where
// there are any, else all.
double placebo_gap(const Linearisation &model, std::size_t effect, const Eigen::VectorXd &training,
                   const Eigen::VectorXd &judged, std::uint64_t seed) {
  RandomStream random(seed, 31);
  const Eigen::VectorXd residual = model.residual;
  double sum = 0;
  for (int draw = 0; draw < placebo_draws; ++draw) {
    Eigen::VectorXd placebo = model.traces.col(static_cast<Eigen::Index>(effect));
    for (Eigen::Index row = 0; row < placebo.size(); ++row)
      if (random.uniform() < 0.5) placebo(row) = -placebo(row);
    Eigen::MatrixXd columns(residual.size(), model.jacobian.cols() + 1);
    columns << model.jacobian, placebo;
    const Eigen::MatrixXd used = training.asDiagonal() * columns;
    const Eigen::VectorXd x =
        used.colPivHouseholderQr().solve(residual.cwiseProduct(training));
    sum += (residual - columns * x).cwiseProduct(judged).squaredNorm() / judged.sum();
  }
  return std::sqrt(sum / placebo_draws);
}

// `rows`: the model's at the fits before and after, all series.
void measure_gaps(Prober &model, const Evidence &evidence, const std::vector<Eigen::VectorXd> &rows,
                  StudyDiagnosis &out, std::uint64_t seed) {
  const auto &d = out.diagnosis;
  // One yardstick for both: what the model does not know of its rows after.
  const Whitening whitening(evidence, model.uncertainty(d.after.point));
  const Eigen::VectorXd before = whitening.residual(rows[0]), after = whitening.residual(rows[1]);
  Eigen::VectorXd training = Eigen::VectorXd::Ones(before.size());
  for (const auto &s : evidence.series) {
    const bool held = s.name == out.holdout;
    if (held) training.segment(s.first, s.count).setZero();
    const SeriesGap gap{s.name, held, rms(before.segment(s.first, s.count)),
                        rms(after.segment(s.first, s.count))};
    out.by_series.push_back(gap);
    if (held) out.gap.holdout_before = gap.before, out.gap.holdout_after = gap.after;
  }
  const double chi2_before = before.cwiseProduct(training).squaredNorm(),
               chi2_after = after.cwiseProduct(training).squaredNorm();
  out.gap.before = std::sqrt(chi2_before / training.sum());
  out.gap.after = std::sqrt(chi2_after / training.sum());
  out.confirmed_gain = chi2_before - chi2_after;
  const double fitted = static_cast<double>(d.after.columns.cols());
  out.gap.noise_floor = std::sqrt(std::max(0.0, 1 - fitted / training.sum()));
  if (d.effects.empty()) return;
  Linearisation linear = linearise(model, whitening, d.before.point);
  linear.residual = before;
  const Eigen::VectorXd judged =
      out.holdout.empty() ? training
                          : Eigen::VectorXd(Eigen::VectorXd::Ones(training.size()) - training);
  out.gap.placebo_after = placebo_gap(linear, d.effects.front().effect, training, judged, seed);
}

// A name that does not help a series it was not fitted to is not given alone: every effect that was
// tried and is admissible stands beside it.
void demote(StudyDiagnosis &out) {
  auto &d = out.diagnosis;
  if (d.verdict != Verdict::one || out.holdout.empty()) return;
  if (!(out.gap.holdout_after >= out.gap.holdout_before)) return;
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
    other.low = other.high = nan_value;
    other.margin = tried.behind;
    d.effects.push_back(other);
  }
  d.verdict = d.effects.size() > 1 ? Verdict::set : Verdict::not_in_catalogue;
  if (d.verdict == Verdict::not_in_catalogue) d.effects.clear();
  d.margin = 0;
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

// Moves the model's centre until the fit of the parameters alone lies within the steps made.
void settle(StudyModel &model, const std::vector<MeasuredSeries> &all, const std::string &holdout,
            const std::function<void(const std::string &)> &say) {
  for (int move = 0;; ++move) {
    auto series = all;
    const auto rows = keep_modelled(series, model.engine().series());
    const Parts parts = split(series, rows, holdout);
    auto &emulated = model.emulated();
    RowSelection prober(emulated, parts.training_rows);
    const Evidence evidence = evidence_of(
        model.study(), parts.training, columns_of(emulated.centre_rows(), parts.training_rows));
    Whitening whitening(evidence);
    Refit fit;
    fit_base(prober, evidence, model.catalogue(), emulated.centre(), fit, whitening);
    if (emulated.covers(fit.point) || move == most_moves) return;
    say(fmt::format("the fit is at chi squared {:.1f} of {} rows, beyond the steps made: centre "
                    "moved",
                    fit.chi2, parts.training_rows.size()));
    model.move_to(emulated.towards(fit.point));
  }
}

// Effects among the contenders whose size lies beyond what the emulator was made from, with the
// switch-on size that puts it between the two sizes run.
std::map<std::size_t, double> beyond_what_was_run(StudyModel &model, const Diagnosis &d) {
  std::map<std::size_t, double> out;
  for (const auto &tried : d.tried) {
    if (tried.behind > contender) continue;
    for (std::size_t i = 0; i < tried.effects.size(); ++i) {
      const auto k = tried.effects[i];
      const auto &entry = model.catalogue()[k];
      const double a = tried.amplitudes[i];
      if (model.emulated().covers(k, a)) continue;
      const double bound = a > 0 ? entry.largest : -entry.lowest;
      const double grown = std::clamp(std::abs(a) / 1.5, 1.0 / longest_growth, longest_growth);
      double size = entry.switch_on * grown;
      if (bound > 0 && std::abs(size) > std::abs(bound)) size = std::copysign(bound, size);
      if (std::abs(size - entry.switch_on) > 0.05 * std::abs(entry.switch_on)) out[k] = size;
    }
  }
  return out;
}

}  // namespace

void scale_to_noise(StudyModel &model, Prober &prober, const Evidence &evidence,
                    const std::function<void(const std::string &)> &say) {
  const Whitening plan(without_data(evidence));
  for (int round = 0; round < 2; ++round) {
    const Linearisation linear = linearise(prober, plan, model.emulated().centre());
    const ScoreTable scores(Projection(linear.jacobian), linear, model.catalogue());
    std::map<std::size_t, double> larger;
    for (std::size_t k = 0; k < model.catalogue().size(); ++k) {
      const auto &entry = model.catalogue()[k];
      if (scores.norm(k) >= size_low || linear.dead[k]) continue;
      const double wanted = std::min(longest_growth, size_aim / std::max(0.1, scores.norm(k)));
      const double bound = std::abs(entry.largest);
      const double size = std::copysign(std::min(std::abs(entry.switch_on) * wanted, bound),
                                        entry.switch_on);
      if (std::abs(size) > 1.2 * std::abs(entry.switch_on)) larger[k] = size;
    }
    if (larger.empty()) return;
    say(fmt::format("{} effects hardly rise above noise at their switch-on size: taken larger",
                    larger.size()));
    model.rescale(larger);
  }
}

StudyDiagnosis diagnose_measured(StudyModel &model, std::vector<MeasuredSeries> series,
                                 const StudyDiagnosisOptions &options, bool confirm,
                                 const StudySinks &sinks) {
  const auto say = [&](const std::string &line) {
    if (sinks.say) sinks.say(line);
  };
  const Study &study = model.study();
  auto &emulated = model.emulated();
  StudyDiagnosis out;
  out.effects = model.effects();
  out.catalogue = model.catalogue();
  out.gap.holdout_before = out.gap.holdout_after = out.gap.placebo_after = nan_value;
  out.holdout = choose_holdout(series, options.holdout);
  const int runs_before = model.runs();
  const auto all_rows = keep_modelled(series, model.engine().series());
  const Parts parts = split(series, all_rows, out.holdout);
  if (parts.training.empty())
    throw UserError("nothing but the series held out can be compared with the simulation");
  RowSelection prober(emulated, parts.training_rows);
  const Eigen::MatrixXd by_packing = columns_of(emulated.centre_rows(), parts.training_rows);
  const Evidence evidence = evidence_of(study, parts.training, by_packing);
  out.rows = evidence.rows;
  for (std::size_t k = 0; k < out.catalogue.size(); ++k)
    out.trace_noise.push_back(emulated.trace_noise(k));

  const ModelPoint &at = emulated.centre();
  const Whitening plan(without_data(evidence));
  const Linearisation planned = linearise(prober, plan, at);
  isolability(ScoreTable(Projection(planned.jacobian), planned, out.catalogue), out);
  for (const auto &pair : out.isolability)
    say(fmt::format("can't be told apart well: {} and {} (cosine {:.2f}, confused {:.0f} % of the "
                    "time at {:.0f} noise units)",
                    pair.first, pair.second, pair.cosine, 100 * pair.chance, table_size));
  for (const auto &name : out.hidden) say("can't be seen by these tests at all: " + name);
  if (out.isolability.empty()) say("all effects that these tests see can be told apart");

  const auto names = model.parameter_names();
  double omnibus_alarm = 0;
  for (int round = 0;; ++round) {
    out.catalogue = model.catalogue();
    Whitening whitening(evidence);
    Refit base;
    const Linearisation fitted = fit_base(prober, evidence, out.catalogue, at, base, whitening);
    const Omnibus omnibus(evidence, whitening, names, fitted.jacobian);
    const NullTable null = make_null_table(
        omnibus, fitted, out.catalogue,
        study_null({study, parts.training, by_packing, evidence, prober.uncertainty(base.point),
                    whitening.undo(fitted.jacobian), whitening.undo(fitted.traces)}),
        alarm_rate, null_draws, options.seed);
    omnibus_alarm = null.omnibus_alarm;
    DiagnoseOptions how;
    how.seed = options.seed;
    out.diagnosis = diagnose(prober, evidence, {out.catalogue, names, null}, at, how);
    const auto further = beyond_what_was_run(model, out.diagnosis);
    if (further.empty() || round == most_rounds) break;
    for (const auto &[effect, size] : further)
      say(fmt::format("{} is asked for at a size beyond those run: run at {}",
                      out.catalogue[effect].name,
                      format_quantity(size, out.catalogue[effect].unit, 3)));
    model.rescale(further);
  }

  const auto &d = out.diagnosis;
  {
    const Projection fitted(d.model.jacobian);
    const Whitening whitening(evidence, prober.uncertainty(d.before.point));
    const Omnibus omnibus(evidence, whitening, names, d.model.jacobian);
    Linearisation allowed = d.model;
    for (std::size_t k = 0; k < out.catalogue.size(); ++k)
      if (out.catalogue[k].lowest == 0 && out.catalogue[k].largest == 0)
        allowed.traces.col(static_cast<Eigen::Index>(k)).setZero();
    const ScoreTable scores(fitted, allowed, out.catalogue);
    const Eigen::VectorXd residual = fitted.off(d.model.residual);
    out.others = {name_by_largest_residual(omnibus, Omnibus::Prepared(omnibus, fitted), scores,
                                           residual, omnibus_alarm),
                  name_by_bic(scores, residual), name_by_lasso(scores, out.catalogue, residual)};
  }
  if (!d.effects.empty())
    out.cross = cross_gap(prober, evidence, out.catalogue, d, options.seed);
  const ParameterSpace space(study.parameters);
  out.parameters_before = model.engine().physical(d.before.point);
  out.parameters_after = model.engine().physical(d.after.point);
  const auto plain = [](const Eigen::VectorXd &z) {
    return std::vector<double>(z.data(), z.data() + z.size());
  };
  out.z_before = plain(d.before.point.z), out.z_after = plain(d.after.point.z);
  out.sd_before = physical_sd(space, d.before);
  out.sd_after = physical_sd(space, d.after);
  for (std::size_t k = 0; k < out.catalogue.size(); ++k)
    out.sizes.push_back(d.after.point.amplitude(static_cast<Eigen::Index>(k)) *
                        out.catalogue[k].switch_on);
  RowSelection whole(emulated, all_rows);
  const std::vector<ModelPoint> fits = {d.before.point, d.after.point};
  std::vector<Eigen::VectorXd> rows;
  if (confirm)
    for (const auto &row : emulated.confirm(fits)) rows.push_back(whole.of(row));
  else
    rows = whole.probe(fits);
  for (std::size_t i = 0; i < 2; ++i)
    if (!rows[i].allFinite()) {
      out.advice.push_back("the engine's own runs at the fit lack figures: the emulator's stand");
      rows[i] = whole.probe({fits[i]}).front();
    }
  measure_gaps(whole, evidence_of(study, series, columns_of(emulated.centre_rows(), all_rows)),
               rows, out, options.seed);
  if (!confirm) out.confirmed_gain = nan_value;
  if (confirm) {
    const auto before = model.engine().curves(d.before.point, 0),
               after = model.engine().curves(d.after.point, 0);
    const auto &probed = model.engine().series();
    for (const auto &s : series)
      for (std::size_t i = 0; i < probed.size(); ++i)
        if (probed[i].name == s.probed.name)
          out.shown.push_back({s.probed.name, s.curves, before[i].curve, after[i].curve});
  }
  demote(out);
  advise_on(out);
  out.runs = model.runs() - runs_before;
  return out;
}

StudyDiagnosis diagnose_study(const Study &study, const std::vector<EffectDefinition> &effects,
                              const ModelFactory &factory, const StudyDiagnosisOptions &options,
                              const StudySinks &sinks) {
  const auto say = [&](const std::string &line) {
    if (sinks.say) sinks.say(line);
  };
  const std::vector<MeasuredSeries> series = measured_series(study);
  const std::string holdout = choose_holdout(series, options.holdout);
  say(holdout.empty() ? "held out: nothing (too few tests, or as asked)"
                      : "held out, not used until the end: " + holdout);
  EmulatorPlan plan;
  plan.differences = options.packings;
  plan.centre = std::max(options.scatter, options.packings);
  StudyModel model(study, effects, factory, plan, sinks.progress);
  model.start(probed(series));
  std::vector<std::string> lost = not_modelled(series, model.engine().series());
  for (auto &one : lost) {
    one = "not compared: " + one + " (some packing of the simulation gives no figure, or all the same)";
    say(one);
  }
  settle(model, series, holdout, say);
  model.add_effects();
  {
    auto known = series;
    const auto rows = keep_modelled(known, model.engine().series());
    const Parts parts = split(known, rows, holdout);
    RowSelection prober(model.emulated(), parts.training_rows);
    scale_to_noise(model, prober,
                   evidence_of(study, parts.training,
                               columns_of(model.emulated().centre_rows(), parts.training_rows)),
                   say);
  }
  const int made = model.runs();
  StudyDiagnosis out = diagnose_measured(model, series, options, true, sinks);
  out.runs += made;
  out.advice.insert(out.advice.begin(), lost.begin(), lost.end());
  return out;
}

}  // namespace bondlab::diagnose
