// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/stationarity.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>

namespace bondlab {

Stationarity judge_stationarity(const Evaluator &evaluator, const FitProblem &problem, const TransformedPoint &point,
                                const Jacobian &jacobian, double immaterial) {
  Stationarity verdict;
  const auto targets = standardised(evaluator, problem, point);
  if (!targets) return verdict;
  const Eigen::Index n = targets->size(), p = jacobian.rows.cols();

  Eigen::VectorXd r(n + p), noise(n + p);
  r << *targets, prior_rows(problem, point);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = static_cast<std::size_t>(i);
    const double share = problem.noise[row] / problem.sd[row];
    noise(i) = std::max(share, immaterial);
    verdict.noise_gain += share * share;
  }
  noise.tail(p).setConstant(immaterial);
  Eigen::MatrixXd a(n + p, p);
  a << jacobian.rows, Eigen::MatrixXd::Identity(p, p) / problem.prior_sd;

  const Eigen::VectorXd gradient = a.transpose() * r;
  Eigen::MatrixXd covariance = a.transpose() * noise.cwiseAbs2().asDiagonal() * a;
  covariance.diagonal() += jacobian.noise_sd.cwiseAbs2().transpose() * targets->cwiseAbs2();

  verdict.statistic = gradient.dot(covariance.ldlt().solve(gradient));
  verdict.limit = boost::math::quantile(boost::math::chi_squared(static_cast<double>(p)), 0.95);
  const Eigen::MatrixXd hessian = a.transpose() * a;
  verdict.gain = gradient.dot(hessian.ldlt().solve(gradient));
  const bool could_be_zero =
      verdict.statistic <= verdict.limit && verdict.gain <= gain_worth_having + 4 * verdict.noise_gain;
  verdict.stationary = !jacobian.any_frozen() && (could_be_zero || verdict.gain <= verdict.noise_gain);
  return verdict;
}

}  // namespace bondlab
