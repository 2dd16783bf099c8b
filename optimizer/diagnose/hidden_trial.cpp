// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/hidden_trial.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "diagnose/measuring_error.h"
#include "diagnose/score.h"
#include "study/measurement.h"

namespace bondlab::diagnose {

namespace {

namespace fs = std::filesystem;

constexpr int sizing_rounds = 2;

// Data of a plan with nothing measured yet: what noise units are counted in.
std::vector<MeasuredSeries> plan_of(const std::vector<ProbedSeries> &probed, int replicates) {
  std::vector<MeasuredSeries> out;
  for (const auto &p : probed) {
    MeasuredSeries series;
    series.probed = p;
    series.replicates =
        Eigen::MatrixXd::Zero(replicates, static_cast<Eigen::Index>(p.quantities.size()));
    out.push_back(std::move(series));
  }
  return out;
}

class Sizer {
 public:
  Sizer(StudyModel &model, int replicates)
      : model_(model),
        whitening_(plan_evidence(model, replicates)),
        linear_(linearise(model.emulated(), whitening_, model.emulated().centre())),
        fitted_(linear_.jacobian) {}

  static Evidence plan_evidence(StudyModel &model, int replicates) {
    auto evidence = evidence_of(model.study(), plan_of(model.engine().series(), 0),
                                model.emulated().centre_rows());
    for (auto &series : evidence.series) series.planned = replicates;
    return without_data(evidence);
  }

  // The norm of the mean change without what the noise of few packings adds to it.
  double units(const EffectDefinition &effect, double size) {
    const Eigen::MatrixXd changes = this->changes(effect, size);
    const auto count = static_cast<double>(changes.rows());
    Eigen::MatrixXd off(changes.cols(), changes.rows());
    for (Eigen::Index i = 0; i < changes.rows(); ++i)
      off.col(i) = fitted_.off(whitening_.apply(changes.row(i).transpose()));
    const Eigen::VectorXd mean = off.rowwise().mean();
    const double noise = (off.colwise() - mean).squaredNorm() / (count * (count - 1));
    return std::sqrt(std::max(0.0, mean.squaredNorm() - noise));
  }

  // The size with so many units, or the largest there is.
  double size_of(const EffectDefinition &effect, double wanted, double largest) {
    if (units(effect, largest) <= wanted) return largest;
    double low = 0, high = largest;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (units(effect, middle) < wanted ? low : high) = middle;
    }
    return high;
  }

 private:
  Eigen::MatrixXd changes(const EffectDefinition &effect, double size) {  // packings x rows
    auto &emulated = model_.emulated();
    ModelPoint with = emulated.centre();
    for (std::size_t k = 0; k < model_.effects().size(); ++k)
      if (model_.effects()[k].name == effect.name)
        with.amplitude(static_cast<Eigen::Index>(k)) = size / model_.catalogue()[k].switch_on;
    Eigen::MatrixXd out = emulated.changes(with);
    out.rowwise() += measuring(effect, size).transpose();
    return out;
  }

  // What an error of measuring does to the centre's curves: packings as specimens of a campaign.
  Eigen::VectorXd measuring(const EffectDefinition &effect, double size) {
    auto &engine = model_.engine();
    Eigen::VectorXd out = Eigen::VectorXd::Zero(engine.rows());
    if (effect.measures.empty()) return out;
    constexpr int campaign = 4;
    const auto &series = engine.series();
    const auto &study = model_.study();
    std::vector<MeasuredRun> runs;
    std::vector<std::map<std::string, double>> variables;
    for (std::size_t t = 0; t < series.size(); ++t)
      for (int packing = 0; packing < campaign; ++packing) {
        const auto outcome = engine.curves(model_.emulated().centre(), packing)[t];
        runs.push_back({study.test(series[t].test).definition.name, series[t].name, outcome.curve});
        variables.push_back(outcome.deck_variables);
      }
    const auto rows_of = [&] {
      Eigen::VectorXd rows(engine.rows());
      Eigen::Index first = 0;
      for (std::size_t t = 0; t < series.size(); ++t) {
        const auto count = static_cast<Eigen::Index>(series[t].quantities.size());
        Eigen::VectorXd mean = Eigen::VectorXd::Zero(count);
        for (std::size_t i = t * campaign; i < (t + 1) * campaign; ++i)
          mean += rows_of_curve(runs[i].curve, series[t].quantities,
                                study.test(series[t].test).definition, variables[i]) /
                  campaign;
        rows.segment(first, count) = mean;
        first += count;
      }
      return rows;
    };
    const Eigen::VectorXd without = rows_of();
    apply_measuring_errors(effect, size, runs);
    out = rows_of() - without;
    // A cell that saturates takes rows away (no fall): nothing can be told of them here.
    for (Eigen::Index row = 0; row < out.size(); ++row)
      if (!std::isfinite(out(row))) out(row) = 0;
    return out;
  }

  StudyModel &model_;
  Whitening whitening_;
  Linearisation linear_;
  Projection fitted_;
};

// Empty, or the switch-on size that puts `size` between the two that are run: it is beyond them, or
// so far below that a slope between them says nothing of it.
std::map<std::size_t, double> beyond_sizes_run(StudyModel &model, const EffectDefinition &effect,
                                               double size) {
  for (std::size_t k = 0; k < model.effects().size(); ++k) {
    const double switch_on = model.catalogue()[k].switch_on;
    if (model.effects()[k].name != effect.name || model.emulated().knows(k, size / switch_on))
      continue;
    return {{k, std::copysign(size / 1.5, switch_on)}};
  }
  return {};
}

Study with_data(const Study &study, const fs::path &folder) {
  Study out = study;
  out.data = read_data_folder(folder);
  return out;
}

const EffectDefinition &known(const std::vector<EffectDefinition> &all, const std::string &name,
                              const HiddenCase &hidden) {
  for (const auto &effect : all)
    if (effect.name == name) return effect;
  throw UserError(hidden.place, "case '" + hidden.id + "': there is no effect '" + name + "'");
}

void count_parameters(const Study &study, const fs::path &folder, const StudyDiagnosis &result,
                      TrialCase &out) {
  const auto truth = sealed_parameters(folder, study);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ++out.parameters;
    const auto inside = [&](const std::vector<double> &x, const std::vector<double> &sd) {
      return std::abs(x[i] - truth[i]) < 1.96 * sd[i];
    };
    out.inside_before += inside(result.parameters_before, result.sd_before);
    out.inside_after += inside(result.parameters_after, result.sd_after);
  }
}

}  // namespace

std::string to_string(Judgement judgement) {
  switch (judgement) {
    case Judgement::right:
      return "right";
    case Judgement::in_set:
      return "in set";
    case Judgement::wrong:
      return "wrong";
    case Judgement::outside:
      return "not in the catalogue";
    case Judgement::nothing:
      return "nothing";
  }
  return "";
}

Judgement judge(const std::vector<std::string> &hidden, const std::vector<std::string> &named,
                bool outside) {
  if (outside) return Judgement::outside;
  if (named.empty()) return Judgement::nothing;
  const std::set<std::string> a(hidden.begin(), hidden.end()), b(named.begin(), named.end());
  if (a == b) return Judgement::right;
  const bool all = std::includes(b.begin(), b.end(), a.begin(), a.end());
  return all && !a.empty() ? Judgement::in_set : Judgement::wrong;
}

std::vector<TrialCase> run_trial(const HiddenSet &set, const Study &laboratory,
                                 const std::vector<EffectDefinition> &catalogue,
                                 const std::vector<EffectDefinition> &outside,
                                 const EngineIn &engine, const TrialOptions &options,
                                 const std::function<void(const std::string &)> &say,
                                 const std::function<void(const TrialCase &)> &done) {
  std::vector<EffectDefinition> all = catalogue;
  all.insert(all.end(), outside.begin(), outside.end());
  for (const auto &c : set.cases)
    for (const auto &name : c.effects) known(all, name, c);
  const auto wanted = [&](const HiddenCase &c) {
    return options.only.empty() ||
           std::find(options.only.begin(), options.only.end(), c.id) != options.only.end();
  };
  const auto folder_of = [&](const HiddenCase &c) { return options.out / "data" / c.id; };
  const auto hide = [&](const HiddenCase &c, const std::vector<double> &sizes) {
    HideOptions how;
    how.effects = c.effects;
    how.sizes = sizes;
    how.seed = c.seed;
    how.replicates = set.replicates;
    if (!fs::exists(folder_of(c) / "manifest.toml"))
      hide_effect(laboratory, all, engine(options.out / "data" / (c.id + ".runs")), how,
                  folder_of(c), options.progress);
  };

  // The plan's rows come from data of the plan: those with nothing in them.
  HiddenCase blank;
  blank.id = "plan", blank.seed = 1;
  hide(blank, {});
  EmulatorPlan plan;
  plan.differences = options.diagnosis.packings;
  plan.centre = std::max(options.diagnosis.scatter, options.diagnosis.packings);
  StudyModel model(laboratory, all, engine(options.out / "model"), plan, options.progress);
  say(fmt::format("model: {} packings, {} for differences, {} effects", plan.centre,
                  plan.differences, model.effects().size()));
  model.start(probed(measured_series(with_data(laboratory, folder_of(blank)), true)));
  model.add_effects();
  scale_to_noise(model, model.emulated(), Sizer::plan_evidence(model, set.replicates), say);
  say(fmt::format("model made of {} runs, {} rows", model.runs(), model.engine().rows()));
  std::map<std::size_t, double> scales;
  for (std::size_t k = 0; k < model.catalogue().size(); ++k)
    scales[k] = model.catalogue()[k].switch_on;
  // Sizes of all cases, before the outsiders are shut out. What the sizes run do not reach is run.
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> planned;
  for (const auto &c : set.cases) {
    if (!wanted(c)) continue;
    auto &[sizes, units] = planned[c.id];
    for (const auto &name : c.effects) {
      const auto &effect = known(all, name, c);
      const double bound = admissible_size(laboratory, effect);
      for (int round = 0;; ++round) {
        Sizer sizer(model, set.replicates);
        const double size = sizer.size_of(effect, c.units, bound);
        const auto further = round < sizing_rounds ? beyond_sizes_run(model, effect, size)
                                                   : std::map<std::size_t, double>();
        if (!further.empty()) {
          model.rescale(further);
          continue;
        }
        sizes.push_back(size);
        units.push_back(sizer.units(effect, size));
        break;
      }
    }
    model.rescale(scales);
  }
  const auto forbid = [&](const HiddenCase &c) {
    model.forbid([&](const std::string &name) {
      return std::any_of(outside.begin(), outside.end(),
                         [&](const EffectDefinition &e) { return e.name == name; }) ||
             (c.kind == "left_out" && c.effects[0] == name);
    });
  };

  const auto make = [&](const HiddenCase &c) {
    TrialCase trial;
    forbid(c);
    trial.hidden = c;
    std::tie(trial.sizes, trial.units) = planned.at(c.id);
    hide(c, trial.sizes);
    const Study study = with_data(laboratory, folder_of(c));
    const auto result =
        diagnose_measured(model, measured_series(study), options.diagnosis, options.confirm, {});
    const auto &d = result.diagnosis;
    trial.verdict = d.verdict;
    for (const auto &effect : d.effects) {
      trial.named.push_back(result.catalogue[effect.effect].name);
      trial.named_sizes.push_back(effect.size);
    }
    trial.judgement = judge(c.effects, trial.named, d.verdict == Verdict::not_in_catalogue);
    for (const auto &other : result.others) {
      std::vector<std::string> names;
      for (const auto k : other) names.push_back(result.catalogue[k].name);
      trial.others_judged.push_back(judge(c.effects, names, false));
      trial.others.push_back(std::move(names));
    }
    trial.margin = d.margin, trial.p_trace = d.p_trace, trial.p_omnibus = d.p_omnibus;
    trial.trace = d.trace, trial.trace_alarm = d.trace_alarm;
    trial.omnibus = d.omnibus, trial.omnibus_alarm = d.omnibus_alarm;
    trial.where = d.where;
    trial.gap = result.gap, trial.cross = result.cross;
    trial.predicted_gain = d.predicted_gain, trial.confirmed_gain = result.confirmed_gain;
    trial.new_runs = result.runs;
    count_parameters(laboratory, folder_of(c), result, trial);
    return trial;
  };

  std::vector<TrialCase> out;
  for (const auto &c : set.cases) {
    if (!wanted(c)) continue;
    model.rescale(scales);
    TrialCase trial;
    try {
      trial = make(c);
    } catch (const UserError &error) {
      say(fmt::format("case {} could not be made: {}", c.id, error.what()));
      continue;
    }
    done(trial);
    out.push_back(std::move(trial));
  }
  return out;
}

}  // namespace bondlab::diagnose
