// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/score.h"

#include <algorithm>
#include <cmath>

namespace bondlab::diagnose {

namespace {

constexpr double least_left = 1e-3;

// Gain of an amplitude: 2 a |s| t - a^2 |s|^2.
double gain_of(double amplitude, double norm, double t) {
  const double x = amplitude * norm;
  return 2 * x * t - x * x;
}

}  // namespace

ScoreTable::ScoreTable(const Projection &fitted, const Linearisation &model,
                       const std::vector<EffectEntry> &catalogue)
    : catalogue_(catalogue) {
  unit_ = fitted.off(model.traces);
  norm_ = unit_.colwise().norm();
  for (Eigen::Index k = 0; k < unit_.cols(); ++k) {
    const double whole = model.traces.col(k).norm();
    hidden_.push_back(!(whole > 0) || norm_(k) < least_left * whole);
    if (hidden_.back()) {
      unit_.col(k).setZero();
      norm_(k) = 0;
    } else {
      unit_.col(k) /= norm_(k);
    }
  }
  cosines_ = unit_.transpose() * unit_;
}

std::vector<Score> ScoreTable::scores(const Eigen::VectorXd &residual) const {
  return scores_of(unit_.transpose() * residual);
}

std::vector<Score> ScoreTable::scores_of(const Eigen::VectorXd &t) const {
  std::vector<Score> out;
  for (Eigen::Index k = 0; k < t.size(); ++k) {
    Score score;
    score.effect = static_cast<std::size_t>(k);
    score.t = t(k);
    if (!hidden_[score.effect]) {
      const auto &entry = catalogue_[score.effect];
      score.amplitude = std::clamp(t(k) / norm_(k), entry.lowest / entry.switch_on,
                                   entry.largest / entry.switch_on);
      score.gain = std::max(0.0, gain_of(score.amplitude, norm_(k), t(k)));
    }
    out.push_back(score);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Score &a, const Score &b) { return a.gain > b.gain; });
  return out;
}

double ScoreTable::largest(const Eigen::VectorXd &residual) const {
  const auto all = scores(residual);
  return all.empty() ? 0 : std::sqrt(all.front().gain);
}

std::vector<PairScore> ScoreTable::pairs(const Eigen::VectorXd &residual) const {
  const Eigen::VectorXd t = unit_.transpose() * residual;
  std::vector<PairScore> out;
  const auto admissible = [&](Eigen::Index k, double x) {
    const auto &entry = catalogue_[static_cast<std::size_t>(k)];
    const double amplitude = x / norm_(k);
    return amplitude >= entry.lowest / entry.switch_on &&
           amplitude <= entry.largest / entry.switch_on;
  };
  for (Eigen::Index i = 0; i < t.size(); ++i)
    for (Eigen::Index j = i + 1; j < t.size(); ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if (hidden_[a] || hidden_[b]) continue;
      if (catalogue_[a].kind == EffectKind::conversion &&
          catalogue_[b].kind == EffectKind::conversion)
        continue;
      const double c = cosines_(i, j), rest = 1 - c * c;
      if (rest < 1e-4) continue;
      const double x = (t(i) - c * t(j)) / rest, y = (t(j) - c * t(i)) / rest;
      if (!admissible(i, x) || !admissible(j, y)) continue;
      out.push_back({a, b, x * t(i) + y * t(j)});
    }
  std::stable_sort(out.begin(), out.end(),
                   [](const PairScore &a, const PairScore &b) { return a.gain > b.gain; });
  return out;
}

double confusion_chance(double cosine, double lambda) {
  const double apart = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  if (lambda * apart < 1e-6) return 1;
  const double z = (margin_needed - lambda * lambda * apart * apart) / (2 * lambda * apart);
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

}  // namespace bondlab::diagnose
