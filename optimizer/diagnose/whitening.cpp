// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/whitening.h"

#include <fmt/core.h>

#include <cassert>
#include <cmath>

namespace bondlab::diagnose {

namespace {

constexpr double weight_of_all = 60;  // degrees of freedom that the common scale counts for

Eigen::MatrixXd inverse_root(const Eigen::MatrixXd &covariance, double &log_determinant) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  const Eigen::VectorXd &values = solver.eigenvalues();
  const double floor = 1e-9 * values.maxCoeff();
  const Eigen::VectorXd inverse = values.cwiseMax(floor).cwiseSqrt().cwiseInverse();
  log_determinant += values.cwiseMax(floor).array().log().sum();
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

struct Tally {
  double sum = 0, dof = 0;
  double scale() const { return dof > 0 ? std::sqrt(sum / dof) : 1; }
};

}  // namespace

Whitening::Whitening(const Evidence &evidence, const Eigen::MatrixXd &model) {
  measured_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(evidence.rows.size()));
  Tally all;
  std::map<std::string, Tally> tests;
  for (const auto &series : evidence.series) {
    tests[series.test];
    if (series.replicates.rows() == 0) continue;
    assert(series.replicates.cols() == series.count);
    const Eigen::RowVectorXd mean = series.replicates.colwise().mean();
    measured_.segment(series.first, series.count) = mean.transpose();
    const auto replicates = static_cast<double>(series.replicates.rows());
    const Eigen::MatrixXd deviations = series.replicates.rowwise() - mean;
    const Eigen::LLT<Eigen::MatrixXd> factor(series.stated);
    const double sum = factor.matrixL().solve(deviations.transpose()).squaredNorm();
    const double dof = (replicates - 1) * series.count;
    all.sum += sum, all.dof += dof;
    tests[series.test].sum += sum, tests[series.test].dof += dof;
  }
  noise_.scale = all.scale();
  noise_.dof = all.dof;
  const double chance = 3 / std::sqrt(2 * std::max(1.0, all.dof));
  noise_.stated_wrong = std::abs(std::log(noise_.scale)) > std::max(std::log(1.1), chance);
  if (noise_.stated_wrong)
    noise_.notes.push_back(fmt::format(
        "replicates scatter {:.2f} times as much as stated ({:.0f} degrees of freedom); "
        "their own scatter is used",
        noise_.scale, all.dof));
  for (const auto &[test, tally] : tests) {
    const double variance =
        (weight_of_all * noise_.scale * noise_.scale + tally.sum) / (weight_of_all + tally.dof);
    noise_.by_test[test] = std::sqrt(variance);
    noise_.dof_by_test[test] = weight_of_all + tally.dof;
  }
  for (const auto &series : evidence.series) {
    const double scale = noise_.by_test[series.test];
    const double replicates = static_cast<double>(
        series.replicates.rows() > 0 ? series.replicates.rows() : series.planned);
    if (series.shift.size() > 0 && series.replicates.rows() > 0)
      measured_.segment(series.first, series.count) -= scale * scale * series.shift;
    Eigen::MatrixXd covariance = series.stated * (scale * scale / replicates) + series.simulated;
    if (model.size() > 0)
      covariance += model.block(series.first, series.first, series.count, series.count);
    blocks_.push_back({series.first, series.count, inverse_root(covariance, log_determinant_)});
  }
  for (const auto &scatter : evidence.scatter) {
    const double stated = noise_.scale * noise_.scale * scatter.stated;
    measured_(scatter.row) = std::cbrt(scatter.variance / stated);
    const double sd = std::sqrt(2 / (9 * scatter.dof));
    blocks_.push_back({scatter.row, 1, Eigen::MatrixXd::Constant(1, 1, 1 / sd)});
  }
}

Eigen::VectorXd Whitening::apply(const Eigen::VectorXd &rows) const {
  assert(rows.size() == measured_.size());
  Eigen::VectorXd out(rows.size());
  for (const auto &block : blocks_)
    out.segment(block.first, block.count).noalias() =
        block.root * rows.segment(block.first, block.count);
  return out;
}

Eigen::MatrixXd Whitening::undo(const Eigen::MatrixXd &whitened) const {
  Eigen::MatrixXd out(whitened.rows(), whitened.cols());
  for (const auto &block : blocks_)
    out.middleRows(block.first, block.count) =
        block.root.ldlt().solve(whitened.middleRows(block.first, block.count));
  return out;
}

Eigen::VectorXd Whitening::residual(const Eigen::VectorXd &simulated) const {
  return apply(measured_ - simulated);
}

}  // namespace bondlab::diagnose
