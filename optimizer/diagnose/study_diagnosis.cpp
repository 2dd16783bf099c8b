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
#include "diagnose/engine_fit.h"
#include "diagnose/fit_interval.h"
#include "diagnose/null_table.h"
#include "diagnose/omnibus.h"
#include "diagnose/row_selection.h"
#include "diagnose/study_advice.h"
#include "diagnose/study_gap.h"
#include "diagnose/study_null.h"
#include "diagnose/switch_on.h"

namespace bondlab::diagnose {

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr int null_draws = 2000, most_moves = 5;
constexpr std::size_t least_for_holdout = 5;
constexpr int most_rounds = 3;
constexpr double contender = 40;  // behind the best in deviance
constexpr std::size_t most_contenders = 3;
constexpr double alarm_rate = 0.01, table_size = 10;
constexpr double interval_95 = 1.959964;

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

// Size and interval of the effects that the fit after has on.
void renew_sizes(StudyDiagnosis &out) {
  auto &d = out.diagnosis;
  const Eigen::Index p = d.after.point.z.size();
  for (std::size_t i = 0; i < d.after.effects.size(); ++i)
    for (auto &named : d.effects) {
      if (named.effect != d.after.effects[i]) continue;
      const auto at = p + static_cast<Eigen::Index>(i);
      const double unit = out.catalogue[named.effect].switch_on;
      const double amplitude = d.after.point.amplitude(static_cast<Eigen::Index>(named.effect));
      const double half = interval_95 * std::sqrt(std::max(0.0, d.after.covariance(at, at)));
      named.size = amplitude * unit;
      named.low = (amplitude - half) * unit;
      named.high = (amplitude + half) * unit;
      if (named.low > named.high) std::swap(named.low, named.high);
    }
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
    const Evidence evidence = evidence_of(model.study(), parts.training,
                                          columns_of(emulated.centre_rows(), parts.training_rows));
    Whitening whitening(evidence);
    Refit fit;
    fit_base(prober, evidence, model.catalogue(), emulated.centre(), fit, whitening);
    if (emulated.covers(fit.point) || move == most_moves) return;
    say(
        fmt::format("the fit is at chi squared {:.1f} of {} rows, beyond the steps made: centre "
                    "moved",
                    fit.chi2, parts.training_rows.size()));
    model.move_to(emulated.towards(fit.point));
  }
}

// Effects of the few best explanations whose size lies beyond what the emulator was made from, with
// the switch-on size that puts it between the two sizes run.
std::map<std::size_t, double> beyond_what_was_run(StudyModel &model, const Diagnosis &d) {
  std::map<std::size_t, double> out;
  auto best = d.tried;
  std::stable_sort(best.begin(), best.end(),
                   [](const Tried &a, const Tried &b) { return a.behind < b.behind; });
  if (best.size() > most_contenders) best.resize(most_contenders);
  for (const auto &tried : best) {
    if (tried.behind > contender) continue;
    for (std::size_t i = 0; i < tried.effects.size(); ++i) {
      const auto k = tried.effects[i];
      const auto &entry = model.catalogue()[k];
      const double a = tried.amplitudes[i];
      if (model.emulated().knows(k, a)) continue;
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
  std::vector<std::vector<SizeTried>> tried(model.catalogue().size());
  for (int round = 1; round < most_switch_ons; ++round) {
    const Linearisation linear = linearise(prober, plan, model.emulated().centre());
    const ScoreTable scores(Projection(linear.jacobian), linear, model.catalogue());
    std::map<std::size_t, double> other;
    for (std::size_t k = 0; k < model.catalogue().size(); ++k) {
      const auto &entry = model.catalogue()[k];
      const bool settled = !tried[k].empty() && tried[k].back().size == entry.switch_on;
      if (linear.dead[k] || settled) continue;
      tried[k].push_back({entry.switch_on, scores.norm(k), model.emulated().trace_noise(k)});
      if (const auto size = next_switch_on(tried[k], entry.largest)) other[k] = *size;
    }
    if (other.empty()) return;
    say(
        fmt::format("{} effects are lost in noise at their switch-on size, or far above it: taken "
                    "at other sizes",
                    other.size()));
    model.rescale(other);
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
  out.scatter = scatter_test(study, parts.training, by_packing, options.seed);
  for (std::size_t k = 0; k < out.catalogue.size(); ++k)
    out.trace_noise.push_back(emulated.trace_noise(k));

  const ModelPoint &at = emulated.centre();
  const Whitening plan(without_data(evidence));
  const Linearisation planned = linearise(prober, plan, at);
  isolability(ScoreTable(Projection(planned.jacobian), planned, out.catalogue), out);
  if (!out.isolability.empty())
    say(fmt::format("can't be told apart well, at {:.0f} noise units:", table_size));
  for (const auto &line : isolability_lines(out.isolability)) say("  " + line);
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
    const auto diagnosed = [&](std::size_t checked, std::size_t checked_pairs) {
      DiagnoseOptions how;
      how.seed = options.seed;
      how.checked = checked, how.checked_pairs = checked_pairs;
      return diagnose(prober, evidence, {out.catalogue, names, null}, at, how);
    };
    // The engine is run at fits only when all sizes asked for have been.
    out.diagnosis = diagnosed(0, 0);
    const auto further = beyond_what_was_run(model, out.diagnosis);
    if (further.empty() || round == most_rounds) {
      const DiagnoseOptions checks;
      out.diagnosis = diagnosed(checks.checked, checks.checked_pairs);
      break;
    }
    for (const auto &[effect, size] : further)
      say(fmt::format("{} is asked for at a size beyond those run: run at {}",
                      out.catalogue[effect].name,
                      format_quantity(size, out.catalogue[effect].unit, 3)));
    model.rescale(further);
  }

  // Where the engine has the fits, and how far off they may be.
  const EngineRows engine_rows = [&](const std::vector<ModelPoint> &points) {
    std::vector<Eigen::VectorXd> rows;
    for (const auto &row : emulated.confirm(points)) rows.push_back(prober.of(row));
    return rows;
  };
  const auto finish = [&](Refit &fit, Prober &model_there) {
    const Eigen::MatrixXd doubt = model_there.uncertainty(fit.point);
    const Whitening whitening(evidence, doubt);
    fit.columns = fit_columns(model_there, whitening, fit.point, fit.effects);
    widen_covariance(
        fit, {study, parts.training, by_packing, evidence, doubt, whitening.undo(fit.columns), {}},
        options.seed);
    if (confirm) fit_on_engine(fit, engine_rows, whitening, out.catalogue);
  };
  // The model that what was named was judged with.
  std::unique_ptr<Prober> anchored;
  if (out.diagnosis.anchor) anchored = emulated.anchored(*out.diagnosis.anchor, Anchoring::whole);
  Prober &whole_after = anchored ? *anchored : emulated;
  RowSelection after(whole_after, parts.training_rows);
  finish(out.diagnosis.before, prober);
  if (out.diagnosis.after.effects.empty())
    out.diagnosis.after = out.diagnosis.before;
  else
    finish(out.diagnosis.after, after);
  renew_sizes(out);

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
    out.cross = cross_gap(prober, after, evidence, out.catalogue, d, options.seed);
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
  RowSelection whole(emulated, all_rows), whole_with(whole_after, all_rows);
  const std::vector<ModelPoint> fits = {d.before.point, d.after.point};
  std::vector<Eigen::VectorXd> rows;
  if (confirm)
    for (const auto &row : emulated.confirm(fits)) rows.push_back(whole.of(row));
  else
    rows = {whole.probe({fits[0]}).front(), whole_with.probe({fits[1]}).front()};
  for (std::size_t i = 0; i < 2; ++i)
    if (!rows[i].allFinite()) {
      out.advice.push_back("the engine's own runs at the fit lack figures: the emulator's stand");
      rows[i] = (i == 0 ? whole : whole_with).probe({fits[i]}).front();
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
  take_back(out);
  give_not_alone(out);
  if (confirm) advise_tests(model, series, out);
  advise_on(out);
  add_scatter(out);
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
    one = "not compared: " + one +
          " (some packing of the simulation gives no figure, or all the same)";
    say(one);
  }
  for (const auto &one : targets_of_envelopes(study)) {
    lost.push_back("not compared: " + one + " (a diagnosis compares figures of single tests)");
    say(lost.back());
  }
  say(model.steps_line());
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
