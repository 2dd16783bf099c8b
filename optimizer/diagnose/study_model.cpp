// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_model.h"

#include <fmt/core.h>

#include <numeric>

#include "diagnose/study_evidence.h"

namespace bondlab::diagnose {

namespace {

constexpr double may_lack = 0.1;  // of the packings, a row that is kept

}  // namespace

StudyModel::StudyModel(const Study &study, const std::vector<EffectDefinition> &all,
                       const ModelFactory &factory, EmulatorPlan plan,
                       std::function<void(const BatchProgress &)> progress)
    : study_(study),
      effects_(effects_of_study(study, all)),
      catalogue_(catalogue_of(study, effects_)),
      as_read_(catalogue_),
      expanded_(with_word_tests(study, effects_)),
      plan_(plan),
      progress_(std::move(progress)) {
  if (study.parameters.empty())
    throw UserError(Place{study.file.string(), 0, 0}, "a diagnosis needs [[parameters]] to fit");
  forward_ = factory(expanded_);
}

void StudyModel::start(const std::vector<ProbedSeries> &series) {
  std::vector<int> packings(static_cast<std::size_t>(plan_.centre));
  std::iota(packings.begin(), packings.end(), 0);
  const auto prober_of = [&](const std::vector<ProbedSeries> &list) {
    if (engine_) earlier_runs_ += engine_->runs();
    engine_ = std::make_unique<ForwardProber>(expanded_, effects_, *forward_, list, packings);
    engine_->set_progress(progress_);
  };
  prober_of(series);
  const auto kept = that_scatter(series, engine_->by_packing(engine_->start(), packings), may_lack);
  prober_of(kept);
  plan_.steps.clear();
  move_to(engine_->start());
}

void StudyModel::move_to(const ModelPoint &centre) {
  emulated_ = std::make_unique<EmulatedProber>(*engine_, catalogue_, centre, plan_, false);
  plan_.steps = emulated_->steps();
}

void StudyModel::add_effects() {
  const ModelPoint centre = emulated_->centre();
  emulated_ = std::make_unique<EmulatedProber>(*engine_, catalogue_, centre, plan_, true);
}

void StudyModel::rescale(const std::map<std::size_t, double> &switch_on) {
  for (const auto &[effect, size] : switch_on) {
    if (catalogue_[effect].switch_on == size) continue;
    catalogue_[effect].switch_on = size;
    engine_->rescale(effect, size);
    emulated_->renew(effect, catalogue_[effect]);
  }
}

std::unique_ptr<ForwardProber> StudyModel::engine_of(const std::string &test, int packings) {
  std::vector<int> all(static_cast<std::size_t>(packings));
  std::iota(all.begin(), all.end(), 0);
  const auto prober_of = [&](const ProbedSeries &series) {
    auto out = std::make_unique<ForwardProber>(expanded_, effects_, *forward_,
                                               std::vector<ProbedSeries>{series}, all);
    for (std::size_t k = 0; k < catalogue_.size(); ++k) out->rescale(k, catalogue_[k].switch_on);
    out->set_progress(progress_);
    return out;
  };
  const ModelPoint centre = emulated_->centre();
  const auto bare = prober_of({test, test, {}});
  const auto outcome = bare->curves(centre, 0).front();
  if (!outcome.ok) return nullptr;
  std::vector<std::string> responses;
  for (const auto &[name, response] : study_.test(test).definition.responses)
    responses.push_back(name);
  ProbedSeries series{test, test, quantities_of(outcome.curve.names, responses)};
  auto wide = prober_of(series);
  const auto kept = that_scatter({series}, wide->by_packing(centre, all));
  earlier_runs_ += bare->runs() + wide->runs();
  return kept.empty() ? nullptr : prober_of(kept.front());
}

void StudyModel::forbid(const std::function<bool(const std::string &)> &whose) {
  for (std::size_t k = 0; k < catalogue_.size(); ++k) {
    auto &entry = catalogue_[k];
    const bool may = !whose(entry.name);
    entry.lowest = may ? as_read_[k].lowest : 0;
    entry.largest = may ? as_read_[k].largest : 0;
  }
}

std::string StudyModel::steps_line() const {
  std::string out;
  const auto &steps = emulated_->steps();
  for (std::size_t i = 0; i < steps.size(); ++i)
    out += fmt::format("{}{} {:.2f}", i > 0 ? ", " : "", study_.parameters[i].name, steps[i]);
  return "parameters are stepped by (from their noise; 0.1 is 10 %): " + out;
}

std::vector<std::string> StudyModel::parameter_names() const {
  std::vector<std::string> names;
  for (const auto &p : study_.parameters) names.push_back(p.name);
  return names;
}

}  // namespace bondlab::diagnose
