// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/fit_interval.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bondlab::diagnose {

namespace {

constexpr int draws = 600;  // 30 of them beyond the interval
constexpr double within = 0.95, interval = 1.959964;

}  // namespace

void widen_covariance(Refit &fit, NullModel null, std::uint64_t seed) {
  const Eigen::Index count = fit.covariance.rows();
  if (count == 0 || null.jacobian.cols() != count) return;
  null.traces = Eigen::MatrixXd::Zero(null.jacobian.rows(), 1);
  const NullSource source = study_null(std::move(null));
  const Eigen::VectorXd damping =
      refit_damping(count - static_cast<Eigen::Index>(fit.effects.size()),
                    static_cast<Eigen::Index>(fit.effects.size()));
  RandomStream random(seed, 34);
  std::vector<std::vector<double>> ratios(static_cast<std::size_t>(count));
  for (int i = 0; i < draws; ++i) {
    const NullDraw draw = source(random);
    Eigen::MatrixXd normal = draw.jacobian.transpose() * draw.jacobian;
    normal.diagonal() += damping.cwiseAbs2();
    const Eigen::MatrixXd stated = normal.ldlt().solve(Eigen::MatrixXd::Identity(count, count));
    const Eigen::VectorXd step = stated * (draw.jacobian.transpose() * draw.residual);
    for (Eigen::Index k = 0; k < count; ++k)
      ratios[static_cast<std::size_t>(k)].push_back(
          stated(k, k) > 0 ? std::abs(step(k)) / std::sqrt(stated(k, k)) : 0);
  }
  Eigen::VectorXd wider(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    auto &ratio = ratios[static_cast<std::size_t>(k)];
    std::sort(ratio.begin(), ratio.end());
    wider(k) = std::max(1.0, ratio[static_cast<std::size_t>(within * draws)] / interval);
  }
  fit.covariance = wider.asDiagonal() * fit.covariance * wider.asDiagonal();
}

}  // namespace bondlab::diagnose
