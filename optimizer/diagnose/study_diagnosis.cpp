// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_diagnosis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "base/random.h"
#include "diagnose/null_table.h"
#include "diagnose/omnibus.h"

namespace bondlab::diagnose {

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr int null_draws = 4000, placebo_draws = 200;
constexpr double alarm_rate = 0.01, table_size = 10;

std::string choose_holdout(const std::vector<MeasuredSeries> &series, const std::string &wanted) {
  if (wanted == "none") return "";
  if (wanted.empty()) return series.size() >= 3 ? series.back().probed.name : "";
  std::vector<std::string> names;
  for (const auto &s : series) names.push_back(s.probed.name);
  if (std::find(names.begin(), names.end(), wanted) == names.end())
    throw UserError("--holdout: nothing named '" + wanted +
                    "' was measured (allowed: " + join(names) + ", none)");
  if (series.size() < 2)
    throw UserError("--holdout: this is all that was measured, nothing would be left to diagnose");
  return wanted;
}

std::vector<int> first_packings(int count) {
  std::vector<int> out(static_cast<std::size_t>(count));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

double rms(const Eigen::VectorXd &residual) {
  return residual.size() == 0 ? nan_value
                              : std::sqrt(residual.squaredNorm() /
                                          static_cast<double>(residual.size()));
}

struct Parts {
  std::vector<MeasuredSeries> all, training;
  Eigen::MatrixXd scatter_all, scatter_training;
};

Parts split(const std::vector<MeasuredSeries> &all, const Eigen::MatrixXd &scatter,
            const std::string &holdout) {
  Parts out;
  out.all = all;
  out.scatter_all = scatter;
  std::vector<Eigen::Index> kept;
  Eigen::Index first = 0;
  for (const auto &s : all) {
    const auto count = static_cast<Eigen::Index>(s.probed.quantities.size());
    if (s.probed.name != holdout) {
      out.training.push_back(s);
      for (Eigen::Index j = 0; j < count; ++j) kept.push_back(first + j);
    }
    first += count;
  }
  out.scatter_training.resize(scatter.rows(), static_cast<Eigen::Index>(kept.size()));
  for (std::size_t j = 0; j < kept.size(); ++j)
    out.scatter_training.col(static_cast<Eigen::Index>(j)) = scatter.col(kept[j]);
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

void measure_gaps(ForwardProber &prober, const Evidence &evidence, StudyDiagnosis &out,
                  std::uint64_t seed) {
  const Whitening whitening(evidence);
  const auto &d = out.diagnosis;
  const auto rows = prober.probe({d.before.point, d.after.point});
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
  out.gap.before = std::sqrt(before.cwiseProduct(training).squaredNorm() / training.sum());
  out.gap.after = std::sqrt(after.cwiseProduct(training).squaredNorm() / training.sum());
  const double fitted = static_cast<double>(d.after.columns.cols());
  out.gap.noise_floor = std::sqrt(std::max(0.0, 1 - fitted / training.sum()));
  if (d.effects.empty()) return;
  const Linearisation model = linearise(prober, whitening, d.before.point);
  const Eigen::VectorXd judged =
      out.holdout.empty() ? training
                          : Eigen::VectorXd(Eigen::VectorXd::Ones(training.size()) - training);
  out.gap.placebo_after =
      placebo_gap(model, d.effects.front().effect, training, judged, seed);
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

}  // namespace

StudyDiagnosis diagnose_study(const Study &study, const std::vector<EffectDefinition> &effects,
                              const ModelFactory &factory, const StudyDiagnosisOptions &options,
                              const StudySinks &sinks) {
  const auto say = [&](const std::string &line) {
    if (sinks.say) sinks.say(line);
  };
  if (study.parameters.empty())
    throw UserError(Place{study.file.string(), 0, 0}, "a diagnosis needs [[parameters]] to fit");
  StudyDiagnosis out;
  out.effects = effects_of_study(study, effects);
  out.catalogue = catalogue_of(study, out.effects);
  out.gap.holdout_before = out.gap.holdout_after = out.gap.placebo_after = nan_value;
  std::vector<MeasuredSeries> series = measured_series(study);
  out.holdout = choose_holdout(series, options.holdout);
  say(out.holdout.empty() ? "held out: nothing (too few tests, or as asked)"
                          : "held out, not used until the end: " + out.holdout);
  const Study expanded = with_word_tests(study, out.effects);
  const auto model = factory(expanded);
  const auto packings = first_packings(options.packings);
  const auto scatter_packings = first_packings(std::max(options.scatter, options.packings));
  const auto prober_of = [&](const std::vector<MeasuredSeries> &list) {
    auto prober = std::make_unique<ForwardProber>(expanded, out.effects, *model, probed(list), packings);
    prober->set_progress(sinks.progress);
    return prober;
  };

  // A first fit, with the scatter at the start; then the scatter where it ended.
  auto prober = prober_of(series);
  ModelPoint at = prober->start();
  Eigen::MatrixXd scatter = prober->by_packing(at, scatter_packings);
  out.runs += prober->runs();
  keep_simulated(series, scatter);
  Parts parts = split(series, scatter, out.holdout);
  prober = prober_of(parts.training);
  {
    const Whitening whitening(
        evidence_of(study, parts.training, parts.scatter_training, packings.size()));
    const Refit first = refit(*prober, whitening, out.catalogue,
                              linearise(*prober, whitening, at, false), {});
    if (!first.ok) throw UserError("the model gives no figures at the study's start");
    at = first.point;
  }
  auto full = prober_of(series);
  scatter = full->by_packing(at, scatter_packings);
  if (!scatter.allFinite())
    throw UserError("a packing gives no figures at the fitted point: its scatter can't be measured");
  parts = split(series, scatter, out.holdout);
  const Evidence evidence =
      evidence_of(study, parts.training, parts.scatter_training, packings.size());
  out.rows = evidence.rows;

  const Whitening plan(without_data(evidence));
  const Linearisation planned = linearise(*prober, plan, at);
  isolability(ScoreTable(Projection(planned.jacobian), planned, out.catalogue), out);
  for (const auto &pair : out.isolability)
    say(fmt::format("can't be told apart well: {} and {} (cosine {:.2f}, confused {:.0f} % of the "
                    "time at {:.0f} noise units)",
                    pair.first, pair.second, pair.cosine, 100 * pair.chance, table_size));
  for (const auto &name : out.hidden) say("can't be seen by these tests at all: " + name);
  if (out.isolability.empty()) say("all effects that these tests see can be told apart");

  std::vector<std::string> names;
  for (const auto &p : study.parameters) names.push_back(p.name);
  const Whitening whitening(evidence);
  Refit base;
  const Linearisation fitted = fit_base(*prober, whitening, out.catalogue, at, base);
  const Omnibus omnibus(evidence, whitening, names, fitted.jacobian);
  const NullTable null = make_null_table(omnibus, fitted, out.catalogue, evidence,
                                         whitening.noise(), alarm_rate, null_draws, options.seed);
  DiagnoseOptions how;
  how.seed = options.seed;
  how.confirmed = 3;
  how.confirmed_pairs = 2;
  out.diagnosis = diagnose(*prober, evidence, {out.catalogue, names, null}, at, how);

  const auto &d = out.diagnosis;
  const ParameterSpace space(study.parameters);
  out.parameters_before = prober->physical(d.before.point);
  out.parameters_after = prober->physical(d.after.point);
  out.sd_before = physical_sd(space, d.before);
  out.sd_after = physical_sd(space, d.after);
  for (std::size_t k = 0; k < out.catalogue.size(); ++k)
    out.sizes.push_back(d.after.point.amplitude(static_cast<Eigen::Index>(k)) *
                        out.catalogue[k].switch_on);
  measure_gaps(*full, evidence_of(study, parts.all, parts.scatter_all, packings.size()), out,
               options.seed);
  const auto before = full->curves(d.before.point, 0), after = full->curves(d.after.point, 0);
  for (std::size_t i = 0; i < series.size(); ++i)
    out.shown.push_back(
        {series[i].probed.name, series[i].curves, before[i].curve, after[i].curve});
  advise_on(out);
  out.runs += prober->runs() + full->runs();
  return out;
}

}  // namespace bondlab::diagnose
