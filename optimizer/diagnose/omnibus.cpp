// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/omnibus.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace bondlab::diagnose {

namespace {

constexpr double least_left = 0.03;  // of a direction's norm, off what was fitted

// Sets of series that share something: alone, one test, one level of one condition in one test and
// in all.
std::map<std::string, std::vector<std::size_t>> groups_of(const Evidence &evidence) {
  std::map<std::string, std::vector<std::size_t>> groups;
  std::map<std::string, std::set<double>> levels;
  for (const auto &series : evidence.series)
    for (const auto &[condition, value] : series.conditions) levels[condition].insert(value);
  for (std::size_t i = 0; i < evidence.series.size(); ++i) {
    const auto &series = evidence.series[i];
    groups["series " + series.name].push_back(i);
    groups["test " + series.test].push_back(i);
    for (const auto &[condition, value] : series.conditions)
      if (levels[condition].size() > 1)
        groups[fmt::format("{} {:.6g}", condition, value)].push_back(i);
  }
  // A group that is all series says nothing; of equal groups one is enough.
  std::set<std::vector<std::size_t>> seen;
  for (auto it = groups.begin(); it != groups.end();) {
    const bool all = it->second.size() == evidence.series.size();
    if (all || !seen.insert(it->second).second)
      it = groups.erase(it);
    else
      ++it;
  }
  return groups;
}

// For every condition with enough levels, each series' level as a rank, centred.
std::map<std::string, std::vector<double>> trends_of(const Evidence &evidence,
                                                     std::size_t least_levels) {
  std::map<std::string, std::set<double>> levels;
  for (const auto &series : evidence.series)
    for (const auto &[condition, value] : series.conditions) levels[condition].insert(value);
  std::map<std::string, std::vector<double>> trends;
  for (const auto &[condition, values] : levels) {
    if (values.size() < std::max<std::size_t>(2, least_levels)) continue;
    const double middle = 0.5 * static_cast<double>(values.size() - 1);
    for (const auto &series : evidence.series) {
      const auto it = series.conditions.find(condition);
      const double rank =
          it == series.conditions.end()
              ? middle
              : static_cast<double>(std::distance(values.begin(), values.find(it->second)));
      trends[condition].push_back((rank - middle) / middle);
    }
  }
  return trends;
}

}  // namespace

Omnibus::Omnibus(const Evidence &evidence, const Whitening &whitening,
                 const std::vector<std::string> &parameters, const Eigen::MatrixXd &jacobian) {
  std::map<std::string, std::vector<int>> blocks;
  for (std::size_t i = 0; i < evidence.rows.size(); ++i) {
    const auto &key = evidence.rows[i];
    const int row = static_cast<int>(i);
    const std::string part = to_string(key.part);
    blocks["whole"].push_back(row);
    blocks["all tests, " + part].push_back(row);
    blocks[key.test].push_back(row);
    blocks[key.test + ", " + part].push_back(row);
    if (key.part != CurvePart::scatter) {
      blocks[key.series].push_back(row);
      blocks[key.series + ", " + part].push_back(row);
    }
  }
  std::set<std::vector<int>> seen;
  for (auto &[name, rows] : blocks)
    if (seen.insert(rows).second) blocks_.push_back({name, rows});

  // Directions: a parameter that drifts, and a part that is off in the same sense, over a group.
  const auto groups = groups_of(evidence);
  std::vector<Eigen::VectorXd> columns;
  const auto keep = [&](const Eigen::VectorXd &column, const Drift &drift) {
    const double norm = column.norm();
    if (norm < 1e-9) return;
    columns.push_back(column / norm);
    drifts_.push_back(drift);
  };
  for (const auto &[name, members] : groups) {
    Eigen::VectorXd mask = Eigen::VectorXd::Zero(jacobian.rows());
    for (const auto i : members)
      mask.segment(evidence.series[i].first, evidence.series[i].count).setOnes();
    for (Eigen::Index j = 0; j < jacobian.cols(); ++j)
      keep(jacobian.col(j).cwiseProduct(mask), {parameters[static_cast<std::size_t>(j)], name});
  }
  for (const auto &[condition, weights] : trends_of(evidence, 3)) {
    Eigen::VectorXd mask = Eigen::VectorXd::Zero(jacobian.rows());
    for (std::size_t i = 0; i < evidence.series.size(); ++i)
      mask.segment(evidence.series[i].first, evidence.series[i].count).setConstant(weights[i]);
    for (Eigen::Index j = 0; j < jacobian.cols(); ++j)
      keep(jacobian.col(j).cwiseProduct(mask),
           {parameters[static_cast<std::size_t>(j)], "with " + condition});
  }
  // A quantity that is off in all series of a test alike, or with a condition.
  std::map<std::string, std::vector<std::pair<int, std::size_t>>> quantities;
  for (std::size_t i = 0; i < evidence.series.size(); ++i) {
    const auto &series = evidence.series[i];
    for (int row = series.first; row < series.first + series.count; ++row) {
      const auto &key = evidence.rows[static_cast<std::size_t>(row)];
      quantities[key.test + ", " + to_string(key.part) + ", " + key.quantity].push_back({row, i});
    }
  }
  const auto trends = trends_of(evidence, 2);
  for (const auto &[name, places] : quantities) {
    if (places.size() < 2) continue;
    Eigen::VectorXd all = Eigen::VectorXd::Zero(jacobian.rows());
    for (const auto &place : places) all(place.first) = 1;
    keep(whitening.apply(all), {name, "all series"});
    for (const auto &[condition, weights] : trends) {
      double mean = 0;
      for (const auto &place : places)
        mean += weights[place.second] / static_cast<double>(places.size());
      Eigen::VectorXd tilted = Eigen::VectorXd::Zero(jacobian.rows());
      for (const auto &place : places) tilted(place.first) = weights[place.second] - mean;
      if (tilted.norm() > 1e-9) keep(whitening.apply(tilted), {name, "with " + condition});
    }
  }
  directions_.resize(jacobian.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    directions_.col(static_cast<Eigen::Index>(i)) = columns[i];
}

Omnibus::Prepared::Prepared(const Omnibus &omnibus, const Projection &fitted) : omnibus_(omnibus) {
  // Directions have unit norm, so what is left of them follows from what the basis takes.
  const Eigen::MatrixXd taken = fitted.basis().transpose() * omnibus.directions_;
  rescale_ = Eigen::VectorXd::Zero(omnibus.directions_.cols());
  for (Eigen::Index i = 0; i < rescale_.size(); ++i) {
    const double left = std::sqrt(std::max(0.0, 1 - taken.col(i).squaredNorm()));
    if (left > least_left) rescale_(i) = 1 / left;
  }
  // Block b of P = I - Q Q^T: trace and squared Frobenius norm from Q_b, without forming P.
  for (const auto &block : omnibus.blocks_) {
    const auto count = static_cast<Eigen::Index>(block.rows.size());
    Eigen::MatrixXd part(count, fitted.rank());
    for (Eigen::Index i = 0; i < count; ++i)
      part.row(i) = fitted.basis().row(block.rows[static_cast<std::size_t>(i)]);
    const Eigen::MatrixXd gram = part.transpose() * part;
    const double trace = static_cast<double>(count) - gram.trace();
    const double square = static_cast<double>(count) - 2 * gram.trace() + gram.squaredNorm();
    // trace = scale * dof, square = scale^2 * dof
    mean_.push_back(trace);
    dof_.push_back(square > 1e-9 ? trace * trace / square : 0);
  }
}

std::vector<double> Omnibus::Prepared::block_scores(const Eigen::VectorXd &residual) const {
  std::vector<double> scores(omnibus_.blocks_.size(), 0);
  for (std::size_t b = 0; b < scores.size(); ++b) {
    if (dof_[b] < 0.3) continue;
    double sum = 0;
    for (const int row : omnibus_.blocks_[b].rows) sum += residual(row) * residual(row);
    const double spread = 2 / (9 * dof_[b]);
    scores[b] = (std::cbrt(sum / mean_[b]) - (1 - spread)) / std::sqrt(spread);
  }
  return scores;
}

Eigen::VectorXd Omnibus::Prepared::drift_scores(const Eigen::VectorXd &residual) const {
  return (omnibus_.directions_.transpose() * residual).cwiseProduct(rescale_);
}

OmnibusScore Omnibus::Prepared::largest(const Eigen::VectorXd &residual) const {
  OmnibusScore best;
  const auto blocks = block_scores(residual);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (blocks[b] > best.score) best = {blocks[b], true, b};
  const Eigen::VectorXd drifts = drift_scores(residual);
  for (Eigen::Index d = 0; d < drifts.size(); ++d)
    if (std::abs(drifts(d)) > best.score)
      best = {std::abs(drifts(d)), false, static_cast<std::size_t>(d)};
  return best;
}

}  // namespace bondlab::diagnose
