// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/covariance.h"

#include <algorithm>
#include <cmath>

namespace bondlab::diagnose {

namespace {

constexpr double prior_variance = 0.25;  // of the logarithm of a quantity's excess
constexpr double least_ratio = 1e-6;
constexpr double largest_by_chance = 2.8;  // 95 % of F with 3 and some 40 degrees of freedom

Eigen::MatrixXd deviations_of(const Eigen::MatrixXd &sample) {
  return sample.rowwise() - sample.colwise().mean();
}

double dof_of(const Eigen::MatrixXd &sample) {
  return std::max(0.0, static_cast<double>(sample.rows()) - 1);
}

}  // namespace

Eigen::MatrixXd shrunk_covariance_of(const Eigen::MatrixXd &deviations, double dof) {
  const Eigen::Index rows = deviations.cols();
  if (!(dof > 0)) return Eigen::MatrixXd::Zero(rows, rows);
  Eigen::MatrixXd covariance = deviations.transpose() * deviations / dof;
  const Eigen::VectorXd sd = covariance.diagonal().cwiseSqrt();
  double noise = 0, found = 0;
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const double both = sd(i) * sd(j);
      if (!(both > 0)) continue;
      const double r2 = std::pow(covariance(i, j) / both, 2);
      noise += std::pow(1 - r2, 2) / dof;
      found += r2;
    }
  const auto p = static_cast<double>(rows);
  const double lambda = std::clamp(found > 0 ? noise / found : 1.0, p / (p + 10 * dof), 1.0);
  const Eigen::VectorXd diagonal = covariance.diagonal();
  covariance *= 1 - lambda;
  covariance.diagonal() = diagonal;
  return covariance;
}

Eigen::MatrixXd shrunk_covariance(const Eigen::MatrixXd &sample) {
  return shrunk_covariance_of(deviations_of(sample), dof_of(sample));
}

double widening(double samples) { return (samples - 1) / std::max(1.0, samples - 3); }

Eigen::VectorXd variances(const Eigen::MatrixXd &sample) {
  if (sample.rows() < 2) return Eigen::VectorXd::Zero(sample.cols());
  return deviations_of(sample).colwise().squaredNorm().transpose() / std::max(1.0, dof_of(sample));
}

void ExcessTally::add(double specimens, double packings, double specimens_dof,
                      double packings_dof) {
  if (!(packings > 0) || !(packings_dof > 2) || !(specimens_dof > 0)) return;
  // The mean of 1 / variance of a sample is larger than 1 / the variance.
  sum += specimens_dof * specimens / packings * (packings_dof - 2) / packings_dof;
  dof += specimens_dof;
}

std::vector<double> excess_scatter(const std::vector<ExcessTally> &tallies) {
  ExcessTally all;
  for (const auto &tally : tallies) all.sum += tally.sum, all.dof += tally.dof;
  std::vector<double> out(tallies.size(), 1.0);
  if (!(all.dof > 0)) return out;
  // The logarithm of a chi squared over its dof is 1 / dof low on average.
  const auto logarithm = [](const ExcessTally &tally) {
    return std::log(std::max(least_ratio, tally.sum / tally.dof)) + 1 / tally.dof;
  };
  const double common = std::max(0.0, logarithm(all));
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    if (!(tallies[i].dof > 0)) continue;
    const double apart = logarithm(tallies[i]) - common, chance = 2 / tallies[i].dof;
    // A sensor may be far worse than all others: what chance can't explain is believed.
    const double prior = std::max(prior_variance, apart * apart - chance);
    const double weight = prior / (prior + chance);
    // With what is left unknown of the logarithm: a variance from few specimens has long tails.
    out[i] = std::exp(std::max(0.0, common + weight * apart) + weight * chance);
  }
  return out;
}

Eigen::MatrixXd specimen_covariance(const Eigen::MatrixXd &packings,
                                    const Eigen::MatrixXd &specimens,
                                    const Eigen::VectorXd &excess) {
  if (specimens.rows() < 2) return shrunk_covariance(packings);
  Eigen::MatrixXd both(packings.rows() + specimens.rows(), packings.cols());
  both << deviations_of(packings),
      deviations_of(specimens) * excess.cwiseSqrt().cwiseInverse().asDiagonal();
  Eigen::MatrixXd out = shrunk_covariance_of(both, dof_of(packings) + dof_of(specimens));
  // A specimen that is far off in one row, as brittle ones are, widens that row.
  out.diagonal() =
      out.diagonal().cwiseProduct(excess).cwiseMax(variances(specimens) / largest_by_chance);
  return out;
}

}  // namespace bondlab::diagnose
