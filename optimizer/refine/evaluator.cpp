// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "response/response.h"

namespace bondlab {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string failure_sentence(const Failure &failure) {
  std::string text = fmt::format("{}: {}", to_string(failure.cause), failure.message);
  if (!failure.run_directory.empty()) text += fmt::format(" (kept in {})", failure.run_directory);
  return text;
}

}  // namespace

Evaluator::Evaluator(const Study &study, const ParameterSpace &space, ForwardModel &model)
    : study_(study), space_(space), model_(model) {}

Evaluator::Key Evaluator::key(const std::string &test, int packing,
                              const TransformedPoint &point) const {
  return {test, packing, space_.to_physical(point).x};
}

void Evaluator::run(const std::vector<TransformedPoint> &points, const TargetIndices &targets,
                    const std::string &phase, int packing) {
  run(points, std::vector<int>{packing}, targets, phase);
}

void Evaluator::run(const std::vector<TransformedPoint> &points, const std::vector<int> &packings,
                    const TargetIndices &targets, const std::string &phase) {
  std::set<std::string> tests;
  for (const std::size_t target : targets)
    for (const std::string &test : tests_of(study_, study_.targets.at(target))) tests.insert(test);

  std::vector<ForwardRequest> requests;
  std::vector<Key> keys;
  std::set<Key> seen;
  for (const auto &point : points) {
    const auto physical = space_.to_physical(point);
    for (const int packing : packings) {
      if (packing == 0 && position_.emplace(physical.x, points_.size()).second) {
        points_.push_back(point);
        phases_.push_back(phase);
      }
      for (const auto &test : tests) {
        const Key wanted = key(test, packing, point);
        if (runs_.count(wanted) || !seen.insert(wanted).second) continue;
        ForwardRequest request;
        request.test = test;
        request.variables = deck_variables(study_, test, physical.x);
        request.packing = packing;
        requests.push_back(std::move(request));
        keys.push_back(wanted);
      }
    }
  }
  if (requests.empty()) return;

  auto outcomes = model_.run(requests, progress_);
  for (std::size_t i = 0; i < outcomes.size(); ++i) keep(keys[i], std::move(outcomes[i]));
  for (const auto &point : points)
    for (const int packing : packings) add_envelope_figures(point, packing);

  if (counts_.failed > study_.options.max_failed) {
    std::string text = fmt::format(
        "{} forward runs failed, the study allows {} ([fit] max_failed):", counts_.failed,
        study_.options.max_failed);
    for (const auto &failure : failures_) text += "\n  " + failure_sentence(failure);
    throw FitFailed(text);
  }
}

void Evaluator::keep(const Key &key, ForwardOutcome outcome) {
  const std::string &test = std::get<0>(key);
  ++counts_.forward;
  if (outcome.from_store) ++counts_.from_store;
  counts_.run_seconds += outcome.wall_seconds;
  if (!outcome.ok) {
    ++counts_.failed;
    failures_.push_back(outcome.failure);
  }

  Run run;
  const ResponseContext context{outcome.deck_variables};
  const auto &definition = study_.test(test).definition;
  for (const auto &target : study_.targets) {
    if (target.test != test) continue;
    ResponseValue value{nan, ""};
    if (!outcome.ok) {
      value.why = "the run failed, " + failure_sentence(outcome.failure);
    } else {
      try {
        value.value =
            evaluate(definition.responses.at(target.response).function, outcome.curve, context);
        if (!std::isfinite(value.value)) value = {nan, "the response is not a finite number"};
      } catch (const ResponseError &error) {
        value.why = fmt::format("{}: {}", to_string(error.cause()), error.what());
      }
    }
    run.responses.emplace(target.name, std::move(value));
  }
  run.outcome = std::move(outcome);
  runs_.emplace(key, std::move(run));
}

void Evaluator::add_envelope_figures(const TransformedPoint &point, int packing) {
  for (const auto &target : study_.targets) {
    const Key wanted = key(target.name, packing, point);
    if (target.envelope.empty() || of_envelopes_.count(wanted)) continue;
    const std::vector<std::string> tests = tests_of(study_, target);
    if (!std::all_of(tests.begin(), tests.end(),
                     [&](const std::string &test) { return outcome(point, test, packing); }))
      continue;
    ResponseValue value{nan, ""};
    try {
      value.value =
          envelope_figure(*envelope(point, study_.envelope(target.envelope), packing), target.response);
      if (!std::isfinite(value.value)) value = {nan, "the response is not a finite number"};
    } catch (const ResponseError &error) {
      value.why = error.what();
    }
    of_envelopes_.emplace(wanted, std::move(value));
  }
}

ResponseValue Evaluator::value(const TransformedPoint &point, std::size_t target,
                               int packing) const {
  const auto &entry = study_.targets.at(target);
  if (!entry.envelope.empty()) {
    const auto of_envelope = of_envelopes_.find(key(entry.name, packing, point));
    return of_envelope == of_envelopes_.end() ? ResponseValue{nan, "not run"} : of_envelope->second;
  }
  const auto found = runs_.find(key(entry.test, packing, point));
  if (found == runs_.end()) return {nan, "not run"};
  return found->second.responses.at(entry.name);
}

bool Evaluator::complete(const TransformedPoint &point, const TargetIndices &targets,
                         int packing) const {
  for (const std::size_t target : targets)
    if (!value(point, target, packing).had()) return false;
  return true;
}

const ForwardOutcome *Evaluator::outcome(const TransformedPoint &point, const std::string &test,
                                         int packing) const {
  const auto found = runs_.find(key(test, packing, point));
  return found == runs_.end() ? nullptr : &found->second.outcome;
}

std::optional<StrengthEnvelope> Evaluator::envelope(const TransformedPoint &point,
                                                    const EnvelopeEntry &entry, int packing) const {
  std::map<std::string, const ForwardOutcome *> outcomes;
  for (const std::string &test : entry.tests)
    if (const ForwardOutcome *found = outcome(point, test, packing)) outcomes[test] = found;
  if (outcomes.empty()) return std::nullopt;
  return envelope_of(entry, study_, outcomes);
}

std::vector<LedgerPoint> Evaluator::ledger() const {
  std::vector<LedgerPoint> ledger;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    LedgerPoint entry;
    entry.phase = phases_[i];
    entry.parameters = space_.to_physical(points_[i]).x;
    for (std::size_t t = 0; t < study_.targets.size(); ++t) {
      const auto had = value(points_[i], t);
      if (had.had()) entry.responses[study_.targets[t].name] = had.value;
    }
    ledger.push_back(std::move(entry));
  }
  return ledger;
}

}  // namespace bondlab
