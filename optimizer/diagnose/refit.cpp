// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/refit.h"

#include <algorithm>
#include <cmath>

namespace bondlab::diagnose {

namespace {

constexpr int most_steps = 20;
constexpr double gain_left = 0.01;  // in chi squared
constexpr double longest_step = 1;  // in z
constexpr double chance_pull = 2;   // in sd
constexpr double farthest = 4;      // in z: within 2 % of a bound, where nothing changes any more

// Whitened differences (simulated) over steps. Columns of points that failed are zero.
Eigen::MatrixXd differences(const std::vector<Eigen::VectorXd> &rows, std::size_t first,
                            const std::vector<double> &steps, const Whitening &whitening,
                            std::vector<bool> *dead) {
  Eigen::MatrixXd columns(rows.front().size(), static_cast<Eigen::Index>(steps.size()));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Eigen::VectorXd change = (rows[first + i] - rows.front()) / steps[i];
    const bool good = change.allFinite();
    if (good)
      columns.col(column) = whitening.apply(change);
    else
      columns.col(column).setZero();
    if (dead) dead->push_back(!good);
  }
  return columns;
}

std::vector<ModelPoint> difference_points(const Prober &prober, const ModelPoint &point,
                                          std::vector<double> &steps) {
  std::vector<ModelPoint> batch = {point};
  for (std::size_t i = 0; i < prober.parameters(); ++i) {
    steps.push_back(prober.parameter_step(i));
    batch.push_back(point);
    batch.back().z(static_cast<Eigen::Index>(i)) += steps.back();
  }
  return batch;
}

Eigen::VectorXd masked(Eigen::VectorXd rows, const Eigen::VectorXd &on) {
  if (on.size() > 0) rows.array() *= on.array();
  return rows;
}

Eigen::MatrixXd masked_columns(Eigen::MatrixXd columns, const Eigen::VectorXd &on) {
  if (on.size() > 0) columns.array().colwise() *= on.array();
  return columns;
}

}  // namespace

// The step of an amplitude is a tenth of its size or a quarter of a switch-on size, whichever is
// larger.
Eigen::MatrixXd fit_columns(Prober &prober, const Whitening &whitening, const ModelPoint &point,
                            const std::vector<std::size_t> &effects) {
  std::vector<double> steps;
  auto batch = difference_points(prober, point, steps);
  for (const auto effect : effects) {
    const auto k = static_cast<Eigen::Index>(effect);
    steps.push_back(std::max(0.25, 0.1 * std::abs(point.amplitude(k))));
    batch.push_back(point);
    batch.back().amplitude(k) += steps.back();
  }
  return differences(prober.probe(batch), 1, steps, whitening, nullptr);
}

Eigen::VectorXd refit_damping(Eigen::Index p, Eigen::Index q) {
  Eigen::VectorXd out(p + q);
  out << Eigen::VectorXd::Constant(p, 1 / longest_step), Eigen::VectorXd::Constant(q, 1e-6);
  return out;
}

void move_point(ModelPoint &point, const Eigen::VectorXd &step,
                const std::vector<std::size_t> &effects, const std::vector<EffectEntry> &catalogue,
                std::vector<bool> &at_bound) {
  const Eigen::Index p = point.z.size();
  for (Eigen::Index i = 0; i < p; ++i)
    point.z(i) = std::clamp(point.z(i) + step(i), std::min(point.z(i), -farthest),
                            std::max(point.z(i), farthest));
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(effects[i]);
    const auto &entry = catalogue[effects[i]];
    const double wanted = point.amplitude(k) + step(p + static_cast<Eigen::Index>(i));
    const double low = entry.lowest / entry.switch_on, high = entry.largest / entry.switch_on;
    point.amplitude(k) = std::clamp(wanted, low, high);
    at_bound[i] = wanted < low || wanted > high;
  }
}

Linearisation linearise(Prober &prober, const Whitening &whitening, const ModelPoint &point,
                        bool with_traces) {
  std::vector<double> steps;
  auto batch = difference_points(prober, point, steps);
  std::vector<double> effect_steps;
  if (with_traces)
    for (std::size_t k = 0; k < prober.effects(); ++k) {
      effect_steps.push_back(1);
      batch.push_back(point);
      batch.back().amplitude(static_cast<Eigen::Index>(k)) += 1;
    }
  const auto rows = prober.probe(batch);
  Linearisation out;
  out.point = point;
  out.residual = whitening.residual(rows.front());
  out.jacobian = differences(rows, 1, steps, whitening, nullptr);
  if (with_traces)
    out.traces = differences(rows, 1 + steps.size(), effect_steps, whitening, &out.dead);
  return out;
}

bool Refit::admissible() const {
  for (std::size_t i = 0; i < at_bound.size(); ++i) {
    const double size = point.amplitude(static_cast<Eigen::Index>(effects[i]));
    if (at_bound[i] && (size == 0 || pull[i] > chance_pull)) return false;
  }
  return ok;
}

Refit refit(Prober &prober, const Whitening &whitening, const std::vector<EffectEntry> &catalogue,
            const Linearisation &start, const std::vector<std::size_t> &effects,
            const Eigen::VectorXd &on) {
  Refit result;
  result.effects = effects;
  result.at_bound.assign(effects.size(), false);
  result.pull.assign(effects.size(), 0);
  result.point = start.point;
  const Eigen::Index p = start.jacobian.cols(), q = static_cast<Eigen::Index>(effects.size());
  Eigen::MatrixXd columns(start.jacobian.rows(), p + q);
  columns.leftCols(p) = start.jacobian;
  for (Eigen::Index i = 0; i < q; ++i)
    columns.col(p + i) = start.traces.col(static_cast<Eigen::Index>(effects[i]));
  columns = masked_columns(columns, on);
  Eigen::VectorXd residual = masked(start.residual, on);
  double chi2 = residual.squaredNorm();
  if (!std::isfinite(chi2)) return result;
  bool fresh = false;  // columns belong to the point
  // Damping: what the rows hardly see hardly moves.
  const Eigen::VectorXd damping = refit_damping(p, q);
  const auto solve = [&](const Eigen::MatrixXd &matrix) {
    Eigen::MatrixXd damped(matrix.rows() + p + q, p + q);
    damped << matrix, Eigen::MatrixXd(damping.asDiagonal());
    Eigen::VectorXd right = Eigen::VectorXd::Zero(damped.rows());
    right.head(residual.size()) = residual;
    return Eigen::VectorXd(damped.householderQr().solve(right));
  };
  for (int count = 0; count < most_steps; ++count) {
    Eigen::VectorXd step = solve(columns);
    // Amplitudes on a bound and pushed outwards stay; the others are solved for without them.
    bool held = false;
    Eigen::MatrixXd freed = columns;
    for (Eigen::Index i = 0; i < q; ++i) {
      const auto &entry = catalogue[effects[i]];
      const double now = result.point.amplitude(static_cast<Eigen::Index>(effects[i]));
      const bool low = now <= entry.lowest / entry.switch_on && step(p + i) < 0;
      const bool high = now >= entry.largest / entry.switch_on && step(p + i) > 0;
      result.at_bound[i] = low || high;
      if (low || high) freed.col(p + i).setZero(), held = true;
    }
    if (held) step = solve(freed);
    const double longest = step.head(p).cwiseAbs().maxCoeff();
    if (longest > longest_step) step *= longest_step / longest;
    const double promised = chi2 - (residual - freed * step).squaredNorm();
    if (promised < gain_left) {
      if (fresh) break;
      columns = masked_columns(fit_columns(prober, whitening, result.point, effects), on);
      fresh = true;
      continue;
    }
    bool accepted = false, poor = false;
    for (int halving = 0; halving < 5 && !accepted; ++halving, step *= 0.5) {
      ModelPoint trial = result.point;
      std::vector<bool> bound = result.at_bound;
      move_point(trial, step, effects, catalogue, bound);
      const auto rows = prober.probe({trial});
      const Eigen::VectorXd next = masked(whitening.residual(rows.front()), on);
      if (!next.allFinite() || next.squaredNorm() >= chi2) continue;
      const double gain = chi2 - next.squaredNorm();
      result.point = trial;
      residual = next;
      chi2 = next.squaredNorm();
      accepted = true;
      poor = gain < 0.5 * promised;
    }
    if (!accepted && fresh) break;
    fresh = false;
    if (!accepted || poor) {
      columns = masked_columns(fit_columns(prober, whitening, result.point, effects), on);
      fresh = true;
    }
  }
  result.ok = true;
  result.chi2 = chi2;
  result.deviance = chi2 + whitening.log_determinant();
  result.residual = residual;
  result.columns = columns;
  Eigen::MatrixXd normal = columns.transpose() * columns;
  normal.diagonal() += damping.cwiseAbs2();
  result.covariance = normal.ldlt().solve(Eigen::MatrixXd::Identity(p + q, p + q));
  const Eigen::VectorXd wanted = solve(columns);
  for (Eigen::Index i = 0; i < q; ++i)
    if (result.at_bound[static_cast<std::size_t>(i)])
      result.pull[static_cast<std::size_t>(i)] =
          std::abs(wanted(p + i)) / std::sqrt(result.covariance(p + i, p + i));
  return result;
}

}  // namespace bondlab::diagnose
