// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/coordinate_way.h"

#include <algorithm>
#include <cmath>

#include "diagnose/covariance.h"

namespace bondlab::diagnose {

namespace {

constexpr double bend_needed = 2.5;  // standard errors

}  // namespace

Eigen::MatrixXd Way::at(double x) const {
  if (x < 0 && below.size() > 0) return below * x;
  const double inside = std::clamp(x, low, high), beyond = x - inside;
  return linear * x + squared * (inside * inside + 2 * inside * beyond);
}

Eigen::RowVectorXd Way::noise_at(double x) const {
  return (x < 0 && below.size() > 0 ? noise_below : noise) * x;
}

Eigen::MatrixXd with_means_where_lacking(Eigen::MatrixXd rows) {
  for (Eigen::Index row = 0; row < rows.cols(); ++row) {
    const auto known = rows.col(row).array().isFinite().eval();
    const auto count = known.count();
    if (count == rows.rows() || count < least_packings) continue;
    const double mean = known.select(rows.col(row).array(), 0).sum() / static_cast<double>(count);
    rows.col(row) = known.select(rows.col(row).array(), mean).matrix().eval();
  }
  return rows;
}

Way way_through(const std::vector<double> &knots, const std::vector<Eigen::MatrixXd> &changes) {
  Way out;
  out.low = std::min(0.0, *std::min_element(knots.begin(), knots.end()));
  out.high = std::max(0.0, *std::max_element(knots.begin(), knots.end()));
  const Eigen::Index packings = changes.front().rows(), rows = changes.front().cols();
  out.linear = out.squared = Eigen::MatrixXd::Zero(packings, rows);
  out.noise = Eigen::RowVectorXd::Zero(rows);
  out.unknown = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(rows, false);
  const auto count = static_cast<Eigen::Index>(knots.size());
  Eigen::MatrixXd bent(count, 2);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double x = knots[static_cast<std::size_t>(k)];
    bent.row(k) << x, x * x;
  }
  const Eigen::VectorXd straight = bent.col(0);
  const Eigen::MatrixXd solve_bent =
      count > 1 ? Eigen::MatrixXd(bent.completeOrthogonalDecomposition().pseudoInverse())
                : Eigen::MatrixXd();
  for (Eigen::Index row = 0; row < rows; ++row) {
    std::vector<Eigen::Index> known;
    Eigen::MatrixXd values(count, packings);
    for (Eigen::Index p = 0; p < packings; ++p) {
      for (Eigen::Index k = 0; k < count; ++k)
        values(k, p) = changes[static_cast<std::size_t>(k)](p, row);
      if (values.col(p).allFinite()) known.push_back(p);
    }
    if (static_cast<int>(known.size()) < least_packings) {
      out.unknown(row) = true;
      continue;
    }
    Eigen::VectorXd linear = Eigen::VectorXd::Zero(packings), squared = linear;
    const auto of_known = [&](const Eigen::VectorXd &all) {
      Eigen::VectorXd some(static_cast<Eigen::Index>(known.size()));
      for (std::size_t i = 0; i < known.size(); ++i)
        some(static_cast<Eigen::Index>(i)) = all(known[i]);
      return some;
    };
    bool bends = false;
    if (count > 1) {
      for (const auto p : known) {
        const Eigen::Vector2d both = solve_bent * values.col(p);
        linear(p) = both(0), squared(p) = both(1);
      }
      const Eigen::VectorXd some = of_known(squared);
      const double error = std::sqrt(variances(some)(0) / static_cast<double>(some.size()));
      bends = std::abs(some.mean()) > bend_needed * error;
    }
    if (!bends) {
      squared.setZero();
      for (const auto p : known) linear(p) = straight.dot(values.col(p)) / straight.squaredNorm();
      const Eigen::VectorXd some = of_known(linear);
      const auto count_known = static_cast<double>(some.size());
      const double error2 = widening(count_known) * variances(some)(0) / count_known;
      const double mean2 = some.mean() * some.mean();
      if (mean2 > 0) out.noise(row) = some.mean() * std::min(1.0, error2 / mean2);
    }
    // Packings that lack the row stand at the mean, which leaves mean and scatter as they are.
    const double linear_mean = of_known(linear).mean(), squared_mean = of_known(squared).mean();
    for (Eigen::Index p = 0; p < packings; ++p)
      if (!values.col(p).allFinite()) linear(p) = linear_mean, squared(p) = squared_mean;
    out.linear.col(row) = linear;
    out.squared.col(row) = squared;
  }
  out.dead = out.unknown.all();
  return out;
}

}  // namespace bondlab::diagnose
