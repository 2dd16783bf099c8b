// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/hidden_trial.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "diagnose/sizing.h"
#include "study/measurement.h"

namespace bondlab::diagnose {

namespace {

namespace fs = std::filesystem;

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
    out.off_before.push_back((result.parameters_before[i] - truth[i]) / result.sd_before[i]);
    out.off_after.push_back((result.parameters_after[i] - truth[i]) / result.sd_after[i]);
    out.inside_before += std::abs(out.off_before.back()) < 1.96;
    out.inside_after += std::abs(out.off_after.back()) < 1.96;
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
  say(model.steps_line());
  model.add_effects();
  scale_to_noise(model, model.emulated(), plan_evidence(model, set.replicates), say);
  say(fmt::format("model made of {} runs, {} rows", model.runs(), model.engine().rows()));
  std::map<std::size_t, double> scales;
  for (std::size_t k = 0; k < model.catalogue().size(); ++k)
    scales[k] = model.catalogue()[k].switch_on;
  // Sizes of all cases, before the outsiders are shut out. What the sizes run do not reach is run.
  const Evidence noise =
      widened(plan_evidence(model, set.replicates),
              wider_than_packings(model, measured_series(with_data(laboratory, folder_of(blank)))));
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> planned;
  for (const auto &c : set.cases) {
    if (!wanted(c)) continue;
    auto &[sizes, units] = planned[c.id];
    for (const auto &name : c.effects) {
      const auto &effect = known(all, name, c);
      const Sized sized =
          size_for(model, noise, effect, c.units, admissible_size(laboratory, effect));
      sizes.push_back(sized.size);
      units.push_back(sized.units);
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
    trial.p_scatter = result.scatter.p;
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
