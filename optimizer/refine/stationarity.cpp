// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/stationarity.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>

namespace bondlab {

Stationarity judge_stationarity(const Evaluator &evaluator, const FitProblem &problem,
                                const TransformedPoint &point, const Jacobian &jacobian,
                                const Immaterial &immaterial) {
  Stationarity verdict;
  const auto targets = standardised(evaluator, problem, point);
  if (!targets) return verdict;
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < jacobian.held.size(); ++k)
    if (jacobian.moves(k)) free.push_back(static_cast<Eigen::Index>(k));
  const Eigen::Index n = targets->size(), p = static_cast<Eigen::Index>(free.size());
  if (p == 0) {
    verdict.stationary = !jacobian.any_frozen();
    return verdict;
  }

  const Eigen::VectorXd prior = prior_rows(problem, point);
  Eigen::VectorXd r(n + p), noise(n + p);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + p, p), jacobian_noise(n, p);
  r.head(n) = *targets;
  for (Eigen::Index k = 0; k < p; ++k) {
    r(n + k) = prior(free[static_cast<std::size_t>(k)]);
    a.col(k).head(n) = jacobian.rows.col(free[static_cast<std::size_t>(k)]);
    a(n + k, k) = 1 / problem.prior_sd;
    jacobian_noise.col(k) = jacobian.noise_sd.col(free[static_cast<std::size_t>(k)]);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = static_cast<std::size_t>(i);
    const double share = problem.noise[row] / problem.sd[row];
    noise(i) = std::max(share, immaterial.row);
    verdict.noise_gain += share * share;
  }
  noise.tail(p).setConstant(immaterial.row);

  const Eigen::VectorXd gradient = a.transpose() * r;
  Eigen::MatrixXd covariance = a.transpose() * noise.cwiseAbs2().asDiagonal() * a;
  covariance.diagonal() += jacobian_noise.cwiseAbs2().transpose() * targets->cwiseAbs2();
  const Eigen::MatrixXd hessian = a.transpose() * a;

  verdict.statistic = gradient.dot(covariance.ldlt().solve(gradient));
  verdict.limit = boost::math::quantile(boost::math::chi_squared(static_cast<double>(p)), 0.95);
  verdict.gain = gradient.dot(hessian.ldlt().solve(gradient));
  const bool could_be_zero = verdict.statistic <= verdict.limit &&
                             verdict.gain <= gain_worth_having + 4 * verdict.noise_gain;
  const bool nothing_to_gain = verdict.gain <= std::max(verdict.noise_gain, immaterial.gain);
  verdict.stationary = !jacobian.any_frozen() && (could_be_zero || nothing_to_gain);
  return verdict;
}

}  // namespace bondlab
