// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/fit_problem.h"

#include <limits>

namespace bondlab {

std::optional<Eigen::VectorXd> standardised(const Evaluator &evaluator, const FitProblem &problem,
                                            const TransformedPoint &point, int packing) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(problem.targets.size()));
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const auto row =
        residual(evaluator.study().targets.at(problem.targets[i]),
                 evaluator.value(point, problem.targets[i], packing), problem.sd[i], packing);
    if (!row.why.empty()) return std::nullopt;
    rows(static_cast<Eigen::Index>(i)) = row.value;
  }
  return rows;
}

double misfit(const Evaluator &evaluator, const FitProblem &problem, const TransformedPoint &point,
              int packing) {
  const auto rows = standardised(evaluator, problem, point, packing);
  return rows ? rows->squaredNorm() : std::numeric_limits<double>::quiet_NaN();
}

double misfit_with_prior(const Evaluator &evaluator, const FitProblem &problem,
                         const TransformedPoint &point) {
  return misfit(evaluator, problem, point) + prior_rows(problem, point).squaredNorm();
}

Eigen::VectorXd prior_rows(const FitProblem &problem, const TransformedPoint &point) {
  return Eigen::Map<const Eigen::VectorXd>(point.z.data(),
                                           static_cast<Eigen::Index>(point.z.size())) /
         problem.prior_sd;
}

}  // namespace bondlab
