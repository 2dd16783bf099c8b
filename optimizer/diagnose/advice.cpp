// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/advice.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "diagnose/projection.h"
#include "diagnose/score.h"

namespace bondlab::diagnose {

namespace {

Eigen::MatrixXd picked(const Eigen::MatrixXd &columns, const std::vector<int> &rows) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), columns.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = columns.row(rows[i]);
  return out;
}

}  // namespace

std::vector<Advice> advise(const Linearisation &model, const std::vector<bool> &present,
                           const std::vector<TestOption> &options,
                           const std::vector<std::size_t> &rivals,
                           const std::vector<double> &amplitudes) {
  assert(rivals.size() == amplitudes.size());
  std::vector<Advice> out;
  if (rivals.size() < 2) return out;
  for (const auto &option : options) {
    std::vector<int> rows = option.rows;
    for (std::size_t i = 0; i < present.size(); ++i)
      if (present[i]) rows.push_back(static_cast<int>(i));
    const Eigen::MatrixXd jacobian = picked(model.jacobian, rows);
    const Eigen::MatrixXd traces = Projection(jacobian).off(picked(model.traces, rows));
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < rivals.size(); ++a)
      for (std::size_t b = 0; b < rivals.size(); ++b) {
        if (a == b) continue;
        const Eigen::VectorXd truth =
            amplitudes[a] * traces.col(static_cast<Eigen::Index>(rivals[a]));
        const auto other = traces.col(static_cast<Eigen::Index>(rivals[b]));
        const double norm = other.squaredNorm();
        const double along = norm > 0 ? truth.dot(other) * truth.dot(other) / norm : 0;
        worst = std::min(worst, truth.squaredNorm() - along);
      }
    out.push_back({option.name, worst, worst > 2 * margin_needed});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Advice &a, const Advice &b) { return a.separation > b.separation; });
  return out;
}

}  // namespace bondlab::diagnose
