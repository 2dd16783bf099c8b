// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/placebo.h"

namespace bondlab::diagnose {

namespace {

constexpr int placebo_draws = 200;

double rms(const Eigen::VectorXd &residual) {
  return residual.size() == 0
             ? std::numeric_limits<double>::quiet_NaN()
             : std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
}

// Gap after the refit of the parameters and a placebo, over the rows judged: those held out where
// there are any, else all; not a number where there is no placebo.
double placebo_gap(const Linearisation &model, std::size_t effect, const Eigen::VectorXd &training,
                   const Eigen::VectorXd &judged, std::uint64_t seed) {
  RandomStream random(seed, 31);
  const Eigen::VectorXd residual = model.residual;
  double sum = 0;
  for (int draw = 0; draw < placebo_draws; ++draw) {
    const auto placebo =
        placebo_of(model.traces.col(static_cast<Eigen::Index>(effect)), random);
    if (!placebo) return std::numeric_limits<double>::quiet_NaN();
    Eigen::MatrixXd columns(residual.size(), model.jacobian.cols() + 1);
    columns << model.jacobian, *placebo;
    const Eigen::MatrixXd used = training.asDiagonal() * columns;
    const Eigen::VectorXd x = used.colPivHouseholderQr().solve(residual.cwiseProduct(training));
    sum += (residual - columns * x).cwiseProduct(judged).squaredNorm() / judged.sum();
  }
  return std::sqrt(sum / placebo_draws);
}

}  // namespace

void measure_gaps(Prober &model, const Evidence &evidence, const std::vector<Eigen::VectorXd> &rows,
                  StudyDiagnosis &out, std::uint64_t seed) {
  const auto &d = out.diagnosis;
  // One yardstick for both: what the model does not know of its rows after.
  const Whitening whitening(evidence, model.uncertainty(d.after.point));
  const Eigen::VectorXd before = whitening.residual(rows[0]), after = whitening.residual(rows[1]);
  Eigen::VectorXd training = Eigen::VectorXd::Ones(before.size());
  for (const auto &s : evidence.series) {
    const bool held = s.name == out.holdout;
    if (held) training.segment(s.first, s.count).setZero();
    const SeriesGap gap{s.name, held, rms(before.segment(s.first, s.count)),
                        rms(after.segment(s.first, s.count)), s.count};
    out.by_series.push_back(gap);
    if (held) out.gap.holdout_before = gap.before, out.gap.holdout_after = gap.after;
  }
  const double chi2_before = before.cwiseProduct(training).squaredNorm(),
               chi2_after = after.cwiseProduct(training).squaredNorm();
  out.gap.before = std::sqrt(chi2_before / training.sum());
  out.gap.after = std::sqrt(chi2_after / training.sum());
  out.confirmed_gain = chi2_before - chi2_after;
  const double fitted = static_cast<double>(d.after.columns.cols());
  out.gap.noise_floor = std::sqrt(std::max(0.0, 1 - fitted / training.sum()));
  if (d.effects.empty()) return;
  Linearisation linear = linearise(model, whitening, d.before.point);
  linear.residual = before;
  const Eigen::VectorXd judged =
      out.holdout.empty() ? training
                          : Eigen::VectorXd(Eigen::VectorXd::Ones(training.size()) - training);
  out.gap.placebo_after = placebo_gap(linear, d.effects.front().effect, training, judged, seed);
}

}  // namespace bondlab::diagnose
