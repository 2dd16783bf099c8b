// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/null_table.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "diagnose/score.h"

namespace bondlab::diagnose {

namespace {

double quantile(const std::vector<double> &sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

}  // namespace

double p_value(const std::vector<double> &sorted, double value) {
  const auto above = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value);
  return (static_cast<double>(above) + 1) / (static_cast<double>(sorted.size()) + 1);
}

NullTable make_null_table(const Omnibus &omnibus, const Linearisation &model,
                          const std::vector<EffectEntry> &catalogue, const NullSource &source,
                          double rate, int draws, std::uint64_t seed) {
  NullTable table;
  table.rate = rate;
  const Projection fitted(model.jacobian);
  const Omnibus::Prepared prepared(omnibus, fitted);
  const ScoreTable scores(fitted, model, catalogue);
  RandomStream random(seed, 5);
  std::vector<std::pair<double, double>> pairs;
  for (int i = 0; i < draws; ++i) {
    const NullDraw draw = source(random);
    if (draw.jacobian.size() == 0) {
      const Eigen::VectorXd residual = fitted.off(draw.residual);
      pairs.emplace_back(prepared.largest(residual).score, scores.largest(residual));
      continue;
    }
    const Projection own(draw.jacobian);
    Linearisation rewhitened;
    rewhitened.traces = draw.traces;
    const Eigen::VectorXd residual = own.off(draw.residual);
    pairs.emplace_back(Omnibus::Prepared(omnibus, own).largest(residual).score,
                       ScoreTable(own, rewhitened, catalogue).largest(residual));
  }
  for (const auto &[o, t] : pairs) table.omnibus.push_back(o), table.trace.push_back(t);
  std::sort(table.omnibus.begin(), table.omnibus.end());
  std::sort(table.trace.begin(), table.trace.end());
  table.omnibus_strict = quantile(table.omnibus, 1 - rate / 3);
  table.trace_strict = quantile(table.trace, 1 - rate / 10);
  double low = 0.3 * rate, high = rate;
  for (int i = 0; i < 40; ++i) {
    const double each = 0.5 * (low + high);
    table.omnibus_alarm = quantile(table.omnibus, 1 - each);
    table.trace_alarm = quantile(table.trace, 1 - each);
    const auto alarms = std::count_if(pairs.begin(), pairs.end(), [&](const auto &p) {
      return p.first > table.omnibus_alarm || p.second > table.trace_alarm;
    });
    (static_cast<double>(alarms) > rate * draws ? high : low) = each;
  }
  return table;
}

NullTable make_null_table(const Omnibus &omnibus, const Linearisation &model,
                          const std::vector<EffectEntry> &catalogue, const Evidence &evidence,
                          const NoiseEstimate &noise, double rate, int draws, std::uint64_t seed) {
  const NullSource source = [&](RandomStream &random) {
    NullDraw draw;
    draw.residual.resize(model.jacobian.rows());
    for (Eigen::Index row = 0; row < draw.residual.size(); ++row)
      draw.residual(row) = random.normal();
    for (const auto &[test, dof] : noise.dof_by_test) {
      // sd of an estimated scale: 1 / sqrt(2 dof), normal when there are dozens of them
      const double scale = 1 + random.normal() / std::sqrt(2 * std::max(10.0, dof));
      for (const auto &series : evidence.series)
        if (series.test == test)
          draw.residual.segment(series.first, series.count) /= std::max(0.3, scale);
    }
    return draw;
  };
  return make_null_table(omnibus, model, catalogue, source, rate, draws, seed);
}

}  // namespace bondlab::diagnose
