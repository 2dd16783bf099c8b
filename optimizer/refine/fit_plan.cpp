// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/fit_plan.h"

#include <set>

namespace bondlab {

namespace {

// What a fit usually takes from its first Jacobian to its last look.
constexpr int usual_jacobians = 1, usual_trials = 2, usual_polish = 4;

int count_tests(const Study &study, const TargetIndices &targets) {
  std::set<std::string> tests;
  for (const std::size_t target : targets)
    for (const std::string &test : tests_of(study, study.targets[target])) tests.insert(test);
  return static_cast<int>(tests.size());
}

}  // namespace

TargetIndices indices_of(const Study &study, const std::vector<std::string> &names) {
  TargetIndices indices;
  for (const auto &name : names)
    for (std::size_t i = 0; i < study.targets.size(); ++i)
      if (study.targets[i].name == name) indices.push_back(i);
  return indices;
}

FitPlan plan_of(const Study &study, const FitEntry &entry, bool first) {
  const TargetIndices fitted = indices_of(study, entry.targets),
                      predicted = indices_of(study, entry.predicted);
  TargetIndices all = fitted;
  all.insert(all.end(), predicted.begin(), predicted.end());
  const int p = static_cast<int>(study.parameters.size());
  const int tests = count_tests(study, fitted), all_tests = count_tests(study, all);
  FitPlan plan;
  plan.design = all_tests * ((first ? study.options.lhs_points : 0) + 1);
  plan.noise = first ? tests * noise_repeats : tests * noise_repeats / 2;
  plan.refine =
      tests * (usual_jacobians * 2 * p + usual_trials + usual_polish) + (all_tests - tests);
  plan.packings = all_tests * study.options.packings;
  return plan;
}

std::vector<std::string> fits_or_all(const Study &study, const std::vector<std::string> &names) {
  if (!names.empty()) return names;
  std::vector<std::string> all;
  for (const auto &entry : study.fits) all.push_back(entry.name);
  return all;
}

int expected_runs(const Study &study, const std::vector<std::string> &names) {
  int runs = 0;
  bool first = true;
  for (const auto &name : fits_or_all(study, names)) {
    runs += plan_of(study, study.fit(name), first).all();
    first = false;
  }
  return runs;
}

}  // namespace bondlab
