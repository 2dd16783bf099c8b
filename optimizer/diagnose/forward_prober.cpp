// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/forward_prober.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/run_plan.h"

namespace bondlab::diagnose {

namespace {

constexpr double least_z_step = 0.02, largest_step = 0.8;

bool sets_words_in(const EffectDefinition &effect, const TestEntry &test) {
  return std::any_of(effect.sets.begin(), effect.sets.end(), [&](const EffectSetting &s) {
    return s.rule == SetRule::word && test.definition.variables.count(s.variable) > 0;
  });
}

std::string word_test(const std::string &test, const std::vector<std::string> &effects) {
  std::string name = test;
  for (const auto &effect : effects) name += "+" + effect;
  return name;
}

std::map<std::string, double> defaults_of(const Study &study, const TestEntry &test) {
  auto numeric = plan_run(study, {test.name, {}, 0}).numeric;
  std::map<std::string, double> out;
  for (const auto &[name, value] : numeric)
    if (test.definition.variables.count(name)) out[name] = value;
  return out;
}

// Whether every deck takes what the effect of this size sets.
bool decks_accept(const Study &study, const EffectDefinition &effect, double size,
                  const std::map<std::string, std::map<std::string, double>> &defaults) {
  for (const auto &test : study.tests) {
    const auto found = defaults.find(test.name);
    if (found == defaults.end()) continue;
    bool touched = false;
    const auto changed = with_effect(effect, size, found->second, touched);
    for (const auto &[name, value] : changed)
      if (value != found->second.at(name) &&
          !why_not_allowed(test.definition.variables.at(name), value).empty())
        return false;
  }
  return true;
}

std::map<std::string, std::map<std::string, double>> all_defaults(const Study &study) {
  std::map<std::string, std::map<std::string, double>> out;
  const auto values = ParameterSpace(study.parameters).start().x;
  for (const auto &test : study.tests) {
    out[test.name] = defaults_of(study, test);
    for (const auto &[name, value] : deck_variables(study, test.name, values))
      out[test.name][name] = value;
  }
  return out;
}

EffectKind kind_of(const std::string &kind) {
  if (kind == "specimen") return EffectKind::specimen;
  if (kind == "machine") return EffectKind::machine;
  if (kind == "conversion") return EffectKind::conversion;
  return EffectKind::bond;
}

}  // namespace

std::vector<EffectDefinition> effects_of_study(const Study &study,
                                               const std::vector<EffectDefinition> &all) {
  std::vector<EffectDefinition> out;
  for (const auto &effect : all) {
    const bool reaches =
        std::any_of(study.tests.begin(), study.tests.end(), [&](const TestEntry &test) {
          if (!effect.scales_test.empty() && effect.scales_test == test.definition.name)
            return true;
          return std::any_of(effect.sets.begin(), effect.sets.end(), [&](const EffectSetting &s) {
            return test.definition.variables.count(s.variable) > 0;
          });
        });
    if (reaches) out.push_back(effect);
  }
  return out;
}

Study with_word_tests(const Study &study, const std::vector<EffectDefinition> &effects) {
  Study out = study;
  for (const auto &test : study.tests)
    for (std::size_t i = 0; i < effects.size(); ++i) {
      if (!sets_words_in(effects[i], test)) continue;
      for (std::size_t j = i; j < effects.size(); ++j) {
        if (!sets_words_in(effects[j], test)) continue;
        std::vector<std::string> names = {effects[i].name};
        if (j > i) names.push_back(effects[j].name);
        TestEntry more = test;
        more.name = word_test(test.name, names);
        for (const auto k : {i, j})
          for (const auto &setting : effects[k].sets)
            if (setting.rule == SetRule::word &&
                test.definition.variables.count(setting.variable) > 0)
              more.variables[setting.variable].word = setting.word;
        out.tests.push_back(more);
      }
    }
  return out;
}

std::vector<EffectEntry> catalogue_of(const Study &study,
                                      const std::vector<EffectDefinition> &effects) {
  const auto defaults = all_defaults(study);
  std::vector<EffectEntry> out;
  for (const auto &effect : effects) {
    EffectEntry entry;
    entry.name = effect.name, entry.title = effect.title;
    entry.kind = kind_of(effect.kind);
    entry.size_name = effect.size_name, entry.unit = effect.unit;
    entry.switch_on = effect.switch_on;
    entry.lowest = effect.lowest, entry.largest = effect.largest;
    entry.expected = effect.expected, entry.confused_with = effect.confused_with;
    entry.separating_test = effect.separating_test;
    for (double *bound : {&entry.lowest, &entry.largest}) {
      if (*bound == 0 || decks_accept(study, effect, *bound, defaults)) continue;
      double good = 0, bad = 1;
      for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (good + bad);
        (decks_accept(study, effect, middle * *bound, defaults) ? good : bad) = middle;
      }
      *bound *= good;
    }
    // What the decks refuse upwards is probed downwards.
    if (entry.largest < entry.switch_on)
      entry.switch_on = -entry.lowest >= entry.switch_on ? -entry.switch_on
                                                         : 0.5 * entry.largest;
    if (entry.switch_on < 0) std::swap(entry.lowest, entry.largest);
    out.push_back(entry);
  }
  return out;
}

ForwardProber::ForwardProber(const Study &study, const std::vector<EffectDefinition> &effects,
                             ForwardModel &model, std::vector<ProbedSeries> series,
                             std::vector<int> packings)
    : study_(study),
      effects_(effects),
      model_(model),
      space_(study.parameters),
      series_(std::move(series)),
      packings_(std::move(packings)),
      defaults_(all_defaults(study)) {
  for (const auto &s : series_) rows_ += static_cast<int>(s.quantities.size());
  for (const auto &entry : catalogue_of(study, effects)) switch_on_.push_back(entry.switch_on);
  const auto at = start();
  const auto x = physical(at);
  for (std::size_t i = 0; i < space_.n(); ++i) {
    const double slope = space_.dx_dz(i, at.z(static_cast<Eigen::Index>(i)));
    steps_.push_back(std::clamp(study.options.difference_step * std::abs(x[i] / slope),
                                least_z_step, largest_step));
  }
}

ModelPoint ForwardProber::start() const {
  const auto z = space_.to_transformed(space_.start()).z;
  return {Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size())),
          Eigen::VectorXd::Zero(static_cast<Eigen::Index>(effects_.size()))};
}

std::vector<double> ForwardProber::physical(const ModelPoint &point) const {
  return space_.to_physical({std::vector<double>(point.z.data(), point.z.data() + point.z.size())})
      .x;
}

ForwardProber::Wanted ForwardProber::wanted(const ModelPoint &point, const ProbedSeries &series,
                                            int packing) const {
  Wanted out;
  out.request = {series.test, deck_variables(study_, series.test, physical(point)), packing};
  const TestEntry &test = study_.test(series.test);
  auto full = defaults_.at(series.test);
  for (const auto &[name, value] : out.request.variables) full[name] = value;
  const auto base = full;
  std::vector<std::string> words;
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    const auto &effect = effects_[k];
    // Amplitudes count in switch-on sizes; catalogue_of() may have turned the sign.
    const double size = point.amplitude(static_cast<Eigen::Index>(k)) * switch_on_[k];
    if (size == 0) continue;
    bool touched = false;
    full = with_effect(effect, size, full, touched);
    if (effect.scales_test == test.definition.name) out.load_factor *= 1 + size;
    if (sets_words_in(effect, test)) words.push_back(effect.name);
  }
  for (const auto &[name, value] : full) {
    if (value == base.at(name)) continue;
    out.request.variables[name] = value;
    out.allowed = out.allowed && why_not_allowed(test.definition.variables.at(name), value).empty();
  }
  out.request.test = word_test(series.test, words);
  if (words.size() > 2) out.allowed = false;
  return out;
}

ForwardProber::Key ForwardProber::key(const ForwardRequest &request) const {
  return {request.test, request.packing, request.variables};
}

void ForwardProber::make(const std::vector<Wanted> &list) {
  std::vector<ForwardRequest> requests;
  std::set<Key> asked;
  for (const auto &w : list)
    if (w.allowed && !known_.count(key(w.request)) && asked.insert(key(w.request)).second)
      requests.push_back(w.request);
  if (requests.empty()) return;
  const auto outcomes = model_.run(requests, progress_);
  for (std::size_t i = 0; i < requests.size(); ++i) known_[key(requests[i])] = outcomes[i];
  runs_ += static_cast<int>(requests.size());
}

Eigen::VectorXd ForwardProber::rows_on(const ModelPoint &point, int packing) const {
  Eigen::VectorXd rows =
      Eigen::VectorXd::Constant(rows_, std::numeric_limits<double>::quiet_NaN());
  Eigen::Index first = 0;
  for (const auto &s : series_) {
    const auto count = static_cast<Eigen::Index>(s.quantities.size());
    const auto w = wanted(point, s, packing);
    const auto found = known_.find(key(w.request));
    if (w.allowed && found != known_.end() && found->second.ok) {
      Curve curve = found->second.curve;
      if (w.load_factor != 1) scale_loads(curve, w.load_factor);
      rows.segment(first, count) = rows_of_curve(
          curve, s.quantities, study_.test(s.test).definition, found->second.deck_variables);
    }
    first += count;
  }
  return rows;
}

std::vector<Eigen::VectorXd> ForwardProber::probe(const std::vector<ModelPoint> &batch) {
  prepare(batch, packings_);
  std::vector<Eigen::VectorXd> out;
  for (const auto &point : batch) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows_);
    for (const int packing : packings_) sum += rows_on(point, packing);
    out.push_back(sum / static_cast<double>(packings_.size()));
  }
  return out;
}

void ForwardProber::prepare(const std::vector<ModelPoint> &points,
                            const std::vector<int> &packings) {
  std::vector<Wanted> list;
  for (const auto &point : points)
    for (const auto &s : series_)
      for (const int packing : packings) list.push_back(wanted(point, s, packing));
  make(list);
}

Eigen::MatrixXd ForwardProber::by_packing(const ModelPoint &point,
                                          const std::vector<int> &packings) {
  prepare({point}, packings);
  Eigen::MatrixXd out(static_cast<Eigen::Index>(packings.size()), rows_);
  for (std::size_t i = 0; i < packings.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = rows_on(point, packings[i]).transpose();
  return out;
}

std::vector<ForwardOutcome> ForwardProber::curves(const ModelPoint &point, int packing) {
  std::vector<Wanted> list;
  for (const auto &s : series_) list.push_back(wanted(point, s, packing));
  make(list);
  std::vector<ForwardOutcome> out;
  for (const auto &w : list) {
    const auto found = known_.find(key(w.request));
    out.push_back(found == known_.end() ? ForwardOutcome() : found->second);
    if (out.back().ok && w.load_factor != 1) scale_loads(out.back().curve, w.load_factor);
  }
  return out;
}

}  // namespace bondlab::diagnose
