// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/propose.h"

#include <ceres/ceres.h>

#include <cmath>
#include <memory>

#include "refine/response_model.h"

namespace bondlab {

namespace {

struct ModelResiduals {
  const Evaluator &evaluator;
  const FitProblem &problem;
  const std::vector<ResponseModel> &models;

  Eigen::VectorXd at(const TransformedPoint &point) const {
    Eigen::VectorXd rows(static_cast<Eigen::Index>(models.size()));
    for (std::size_t i = 0; i < models.size(); ++i) {
      const double measured = evaluator.study().targets[problem.targets[i]].value;
      rows(static_cast<Eigen::Index>(i)) = (models[i].value(point) - measured) / problem.sd[i];
    }
    return rows;
  }

  bool operator()(double const *const *parameters, double *residuals) const {
    const std::size_t p = evaluator.space().n();
    const TransformedPoint point{std::vector<double>(parameters[0], parameters[0] + p)};
    Eigen::Map<Eigen::VectorXd> r(residuals, static_cast<Eigen::Index>(models.size() + p));
    r << at(point), prior_rows(problem, point);
    return true;
  }
};

std::optional<Proposal> propose(const Evaluator &evaluator, const FitProblem &problem,
                                const TransformedPoint &from, const std::vector<double> &weights) {
  std::vector<ResponseModel> models;
  for (const std::size_t target : problem.targets) {
    std::vector<double> values;
    for (const auto &point : evaluator.points())
      values.push_back(evaluator.value(point, target).value);
    auto model = ResponseModel::fit(evaluator.space(), evaluator.points(), values, weights);
    if (!model) return std::nullopt;
    models.push_back(std::move(*model));
  }
  const ModelResiduals residuals{evaluator, problem, models};
  const int p = static_cast<int>(evaluator.space().n());

  std::optional<Proposal> best;
  double lowest = 0;
  for (auto start : {from.z, std::vector<double>(static_cast<std::size_t>(p), 0.0)}) {
    // NumericDiff is right here: the models are closed forms, no runs are behind them.
    auto *cost =
        new ceres::DynamicNumericDiffCostFunction<ModelResiduals>(new ModelResiduals(residuals));
    cost->AddParameterBlock(p);
    cost->SetNumResiduals(static_cast<int>(models.size()) + p);
    ceres::Problem ceres_problem;  // owns the cost
    ceres_problem.AddResidualBlock(cost, nullptr, start.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 200;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_problem, &summary);
    if (!summary.IsSolutionUsable() || (best && summary.final_cost >= lowest)) continue;
    lowest = summary.final_cost;
    const TransformedPoint point{start};
    best = Proposal{point, residuals.at(point)};
  }
  return best;
}

}  // namespace

std::optional<Proposal> propose_from_all(const Evaluator &evaluator, const FitProblem &problem,
                                         const TransformedPoint &from) {
  return propose(evaluator, problem, from, std::vector<double>(evaluator.points().size(), 1.0));
}

std::optional<Proposal> propose_near(const Evaluator &evaluator, const FitProblem &problem,
                                     const TransformedPoint &centre, double reach) {
  const auto at = unit_positions(evaluator.space(), centre);
  std::vector<double> weights;
  for (const auto &point : evaluator.points()) {
    const auto u = unit_positions(evaluator.space(), point);
    double squared = 0;
    for (std::size_t k = 0; k < u.size(); ++k) squared += (u[k] - at[k]) * (u[k] - at[k]);
    const double weight = std::exp(-0.5 * squared / (reach * reach));
    weights.push_back(weight > 1e-3 ? weight : 0.0);
  }
  return propose(evaluator, problem, centre, weights);
}

}  // namespace bondlab
