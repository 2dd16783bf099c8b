// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/engine_forward_model.h"

#include <algorithm>

#include "forward/batch.h"

namespace bondlab {

void check_cores(const Study &study, int jobs, int cores) {
  ErrorCollector errors;
  for (const TestEntry &test : study.tests) {
    const int at_a_time = std::max(1, jobs);
    if (test.ranks * at_a_time <= cores) continue;
    const std::string have =
        "; this machine lets us use " + std::to_string(cores) + (cores == 1 ? " core" : " cores");
    if (test.ranks > cores)
      errors.add(test.place, "the test '" + test.name + "' wants " + std::to_string(test.ranks) +
                                 " ranks" + have);
    else
      errors.add(test.place, "ranks x jobs = " + std::to_string(test.ranks) + " x " +
                                 std::to_string(at_a_time) + " = " +
                                 std::to_string(test.ranks * at_a_time) + " for the test '" +
                                 test.name + "'" + have + "; allowed: jobs up to " +
                                 std::to_string(cores / test.ranks) + ", or 0 for as many as fit");
  }
  errors.throw_if_any();
}

EngineForwardModel::EngineForwardModel(const Study &study, ForwardSettings settings)
    : study_(study), settings_(std::move(settings)) {
  settings_.results = std::filesystem::absolute(settings_.results).lexically_normal();
  if (settings_.cores <= 0) settings_.cores = available_cores();
  check_cores(study_, settings_.jobs, settings_.cores);
  if (!settings_.specimens)
    settings_.specimens = generated_specimens(settings_.results / "specimens");
  store_ = std::make_unique<RunStore>(settings_.results / "store.sqlite");
}

EngineForwardModel::~EngineForwardModel() = default;

std::vector<ForwardOutcome> EngineForwardModel::run(
    const std::vector<ForwardRequest> &requests,
    std::function<void(const BatchProgress &)> progress) {
  Batch batch(study_, settings_, *store_, failed_here_, std::move(progress));
  return batch.run(requests);
}

}  // namespace bondlab
