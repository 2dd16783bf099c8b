// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/comparators.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bondlab::diagnose {

Naming name_by_largest_residual(const Omnibus &omnibus, const Omnibus::Prepared &prepared,
                                const ScoreTable &scores, const Eigen::VectorXd &residual,
                                double alarm) {
  const auto blocks = prepared.block_scores(residual);
  const auto largest = std::max_element(blocks.begin(), blocks.end());
  if (largest == blocks.end() || *largest < alarm) return {};
  const auto &rows = omnibus.blocks()[static_cast<std::size_t>(largest - blocks.begin())].rows;
  std::size_t best = 0;
  double most = -1;
  for (Eigen::Index k = 0; k < scores.unit().cols(); ++k) {
    double share = 0;
    for (const int row : rows) share += scores.unit()(row, k) * scores.unit()(row, k);
    if (share > most) most = share, best = static_cast<std::size_t>(k);
  }
  return {best};
}

Naming name_by_bic(const ScoreTable &scores, const Eigen::VectorXd &residual) {
  const auto ranked = scores.scores(residual);
  const double price = std::log(static_cast<double>(residual.size()));
  if (ranked.empty() || ranked.front().gain < price) return {};
  return {ranked.front().effect};
}

Naming name_by_lasso(const ScoreTable &scores, const std::vector<EffectEntry> &catalogue,
                     const Eigen::VectorXd &residual) {
  const Eigen::MatrixXd &gram = scores.cosines();
  const Eigen::VectorXd t = scores.unit().transpose() * residual;
  const Eigen::Index n = t.size();
  const double rows = static_cast<double>(residual.size());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), best = x;
  double lowest = residual.squaredNorm();
  const double top = t.cwiseAbs().maxCoeff();
  for (double penalty = top; penalty > 0.02 * top; penalty *= 0.8) {
    for (int sweep = 0; sweep < 100; ++sweep) {
      double moved = 0;
      for (Eigen::Index k = 0; k < n; ++k) {
        if (gram(k, k) < 0.5) continue;  // hidden
        const double pull = t(k) - gram.row(k).dot(x) + gram(k, k) * x(k);
        double next = std::copysign(std::max(0.0, std::abs(pull) - penalty), pull);
        if (next < 0 && catalogue[static_cast<std::size_t>(k)].lowest >= 0) next = 0;
        moved = std::max(moved, std::abs(next - x(k)));
        x(k) = next;
      }
      if (moved < 1e-6) break;
    }
    const auto used = (x.array().abs() > 1e-9).count();
    const double bic = residual.squaredNorm() - 2 * x.dot(t) + x.dot(gram * x) +
                       static_cast<double>(used) * std::log(rows);
    if (bic < lowest) lowest = bic, best = x;
  }
  Naming out;
  for (Eigen::Index k = 0; k < n; ++k)
    if (std::abs(best(k)) > 1e-9) out.push_back(static_cast<std::size_t>(k));
  std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(best(static_cast<Eigen::Index>(a))) >
           std::abs(best(static_cast<Eigen::Index>(b)));
  });
  return out;
}

}  // namespace bondlab::diagnose
