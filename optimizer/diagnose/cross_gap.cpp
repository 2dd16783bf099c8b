// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/cross_gap.h"

#include <limits>

#include "diagnose/placebo.h"

namespace bondlab::diagnose {

namespace {

constexpr int placebo_draws = 50;
constexpr double most_unknown = 3;  // variance of a prediction over that of the rows

// Whitened residual of the rows held out, after a linear fit of the parameters and a placebo to the
// others; not a number where there is no placebo.
double left_of_placebo(const Linearisation &model, std::size_t effect, const Eigen::VectorXd &on,
                       RandomStream &random) {
  const auto placebo =
      placebo_of(model.traces.col(static_cast<Eigen::Index>(effect)), random);
  if (!placebo) return std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd columns(placebo->size(), model.jacobian.cols() + 1);
  columns << model.jacobian, *placebo;
  const Eigen::VectorXd x = Eigen::MatrixXd(on.asDiagonal() * columns)
                                .colPivHouseholderQr()
                                .solve(Eigen::VectorXd(model.residual.cwiseProduct(on)));
  const Eigen::VectorXd left = model.residual - columns * x;
  return (left.array() * (1 - on.array())).matrix().squaredNorm();
}

}  // namespace

CrossGap cross_gap(Prober &prober, Prober &with_effects, const Evidence &evidence,
                   const std::vector<EffectEntry> &catalogue, const Diagnosis &diagnosis,
                   std::uint64_t seed) {
  CrossGap out;
  const auto &effects = diagnosis.after.effects;
  const Whitening whitening(evidence, with_effects.uncertainty(diagnosis.after.point));
  const Linearisation model = linearise(prober, whitening, diagnosis.before.point);
  const Linearisation model_with = linearise(with_effects, whitening, diagnosis.before.point);
  RandomStream random(seed, 33);
  for (const auto &series : evidence.series) {
    Eigen::VectorXd on = Eigen::VectorXd::Ones(whitening.rows());
    on.segment(series.first, series.count).setZero();
    const auto left = [&](Prober &of, const Refit &fit) {
      const Eigen::VectorXd residual = whitening.residual(of.probe({fit.point}).front());
      return residual.segment(series.first, series.count).squaredNorm();
    };
    const Refit alone = refit(prober, whitening, catalogue, model, {}, on);
    const Refit with = refit(with_effects, whitening, catalogue, model_with, effects, on);
    if (!alone.ok || !with.ok) continue;
    const Linearisation there = linearise(with_effects, whitening, with.point);
    Eigen::MatrixXd columns(series.count, with.covariance.cols());
    columns.leftCols(there.jacobian.cols()) = there.jacobian.middleRows(series.first, series.count);
    for (std::size_t k = 0; k < effects.size(); ++k)
      columns.col(there.jacobian.cols() + static_cast<Eigen::Index>(k)) =
          there.traces.col(static_cast<Eigen::Index>(effects[k]))
              .segment(series.first, series.count);
    const double unknown = (columns * with.covariance).cwiseProduct(columns).sum();
    if (unknown > most_unknown * series.count) continue;
    out.before += left(prober, alone);
    out.after += left(with_effects, with);
    out.floor += series.count + unknown;
    double placebo = 0;
    for (int draw = 0; draw < placebo_draws && !effects.empty(); ++draw)
      placebo += left_of_placebo(model, effects.front(), on, random) / placebo_draws;
    out.placebo += placebo;
  }
  return out;
}

}  // namespace bondlab::diagnose
