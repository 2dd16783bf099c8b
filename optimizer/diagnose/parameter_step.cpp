// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/parameter_step.h"

#include <algorithm>
#include <cmath>

#include "diagnose/study_evidence.h"

namespace bondlab::diagnose {

namespace {

constexpr double bend_over_slope = 0.5;  // |f'''| over |f'|

}  // namespace

double parameter_step_from_noise(const std::vector<double> &knots,
                                 const std::vector<Eigen::MatrixXd> &changes,
                                 const Eigen::VectorXd &scatter, double packings) {
  if (knots.empty()) return largest_parameter_step;
  const double wide = knots.back() - (knots.size() > 1 ? knots.front() : 0);
  // A packing's slopes.
  Eigen::MatrixXd slopes = changes.back();
  if (knots.size() > 1) slopes -= changes.front();
  slopes /= wide;
  double noise = 0, slope = 0;  // squares
  for (Eigen::Index row = 0; row < slopes.cols(); ++row) {
    if (!slopes.col(row).allFinite() || slopes.rows() < 2) continue;
    const double unit = std::max(scatter(row), instrument_sd * instrument_sd);
    const double mean = slopes.col(row).mean();
    const auto count = static_cast<double>(slopes.rows());
    const double variance = (slopes.col(row).array() - mean).square().sum() / (count - 1);
    // Of half the difference over the whole step, whatever the pilot's was.
    noise += variance * 0.25 * wide * wide / packings / unit;
    slope += (mean * mean - variance / count) / unit;
  }
  if (!(slope > 0)) return largest_parameter_step;
  const double step = std::cbrt(std::sqrt(18 * noise) / (bend_over_slope * std::sqrt(slope)));
  return std::clamp(step, smallest_parameter_step, largest_parameter_step);
}

}  // namespace bondlab::diagnose
