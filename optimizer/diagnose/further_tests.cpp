// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/further_tests.h"

#include <algorithm>

namespace bondlab::diagnose {

namespace {

constexpr int centre_packings = 12, difference_packings = 6;

Linearisation below(const Linearisation &a, const Linearisation &b) {
  Linearisation out = a;
  out.jacobian.resize(a.jacobian.rows() + b.jacobian.rows(), a.jacobian.cols());
  out.jacobian << a.jacobian, b.jacobian;
  out.traces.resize(a.traces.rows() + b.traces.rows(), a.traces.cols());
  out.traces << a.traces, b.traces;
  return out;
}

}  // namespace

std::vector<std::string> tests_not_measured(const Study &study,
                                            const std::vector<MeasuredSeries> &series) {
  std::vector<std::string> out;
  for (const auto &test : study.tests)
    if (std::none_of(series.begin(), series.end(),
                     [&](const MeasuredSeries &s) { return s.probed.test == test.name; }))
      out.push_back(test.name);
  return out;
}

std::vector<Advice> further_tests(StudyModel &model, const std::vector<std::string> &tests,
                                  int specimens, const Linearisation &present,
                                  const std::vector<std::size_t> &rivals,
                                  const std::vector<double> &amplitudes) {
  const auto rows_there = static_cast<int>(present.jacobian.rows());
  Linearisation all = present;
  std::vector<TestOption> options;
  for (const auto &test : tests) {
    const auto engine = model.engine_of(test, centre_packings);
    if (!engine) continue;
    EmulatorPlan plan;
    plan.centre = centre_packings, plan.differences = difference_packings, plan.effects = rivals;
    EmulatedProber emulated(*engine, model.catalogue(), present.point, plan);
    MeasuredSeries series;
    series.probed = engine->series().front();
    series.replicates.resize(0, static_cast<Eigen::Index>(series.probed.quantities.size()));
    Evidence evidence = evidence_of(model.study(), {series}, emulated.centre_rows());
    evidence.series.front().planned = specimens;
    ModelPoint on = present.point;
    for (std::size_t i = 0; i < rivals.size(); ++i)
      on.amplitude(static_cast<Eigen::Index>(rivals[i])) = amplitudes[i];
    const Eigen::MatrixXd doubt = emulated.uncertainty(on);
    const Whitening whitening(without_data(evidence), doubt);
    all = below(all, linearise(emulated, whitening, present.point));
    TestOption option{test, {}};
    const int first = options.empty() ? rows_there : options.back().rows.back() + 1;
    for (int row = first; row < static_cast<int>(all.jacobian.rows()); ++row)
      option.rows.push_back(row);
    options.push_back(std::move(option));
  }
  std::vector<bool> there(static_cast<std::size_t>(rows_there), true);
  return advise(all, there, options, rivals, amplitudes);
}

}  // namespace bondlab::diagnose
