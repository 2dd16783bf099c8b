// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/jacobian.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "refine/response_model.h"

namespace bondlab {

namespace {

constexpr double third_over_first = 0.5;  // |f'''| / |f'|, see the header

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

bool Jacobian::any_frozen() const {
  return std::find(frozen.begin(), frozen.end(), true) != frozen.end();
}

std::vector<double> difference_steps(const ParameterSpace &space, const FitProblem &problem,
                                     const TransformedPoint &point, const Eigen::MatrixXd &slopes,
                                     double relative_step) {
  double noise = 0;
  for (std::size_t i = 0; i < problem.targets.size(); ++i)
    noise = std::hypot(noise, problem.noise[i] / problem.sd[i]);
  const auto physical = space.to_physical(point);
  std::vector<double> steps(space.n());
  for (std::size_t k = 0; k < space.n(); ++k) {
    const double relative = std::max(relative_step, smallest_relative_step);
    const double smallest = relative * std::fabs(physical.x[k]) / space.dx_dz(k, point.z[k]);
    const double slope = slopes.size() ? slopes.col(index(k)).norm() : 0.0;
    const double balanced = slope > 0 ? std::cbrt(3 * noise / (third_over_first * slope)) : 0.0;
    steps[k] = std::min(std::max(smallest, balanced), largest_z_step);
  }
  return steps;
}

Eigen::MatrixXd regression_slopes(const Evaluator &evaluator, const FitProblem &problem,
                                  const TransformedPoint &point) {
  Eigen::MatrixXd slopes(index(problem.targets.size()), index(evaluator.space().n()));
  const auto &points = evaluator.points();
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    std::vector<double> values;
    for (const auto &at : points) values.push_back(evaluator.value(at, problem.targets[i]).value);
    const auto model = ResponseModel::fit(evaluator.space(), points, values,
                                          std::vector<double>(points.size(), 1.0));
    if (!model) return {};
    slopes.row(index(i)) = model->gradient(point).transpose() / problem.sd[i];
  }
  return slopes;
}

void hold_at_bounds(const Evaluator &evaluator, const FitProblem &problem,
                    const TransformedPoint &point, Jacobian &jacobian) {
  const auto &space = evaluator.space();
  jacobian.held.assign(space.n(), false);
  const auto rows = standardised(evaluator, problem, point);
  if (!rows) return;
  const auto physical = space.to_physical(point);
  for (std::size_t k = 0; k < space.n(); ++k) {
    const BoundSide side = space.at_bound(k, physical.x[k], bound_fraction);
    const double gradient = jacobian.rows.col(index(k)).dot(
        *rows);  // of the data alone, the prior always pulls inwards
    jacobian.held[k] =
        (side == BoundSide::lower && gradient > 0) || (side == BoundSide::upper && gradient < 0);
  }
}

Jacobian difference_jacobian(Evaluator &evaluator, const FitProblem &problem,
                             const TransformedPoint &point, const std::vector<double> &steps) {
  const auto &space = evaluator.space();
  std::vector<TransformedPoint> above(space.n(), point), below(space.n(), point), batch;
  for (std::size_t k = 0; k < space.n(); ++k) {
    above[k].z[k] += steps[k];
    below[k].z[k] -= steps[k];
    batch.push_back(above[k]);
    batch.push_back(below[k]);
  }
  evaluator.run(batch, problem.targets, "derivatives");

  Jacobian jacobian;
  jacobian.point = point;
  jacobian.steps = steps;
  jacobian.rows.setZero(index(problem.targets.size()), index(space.n()));
  jacobian.noise_sd.setZero(jacobian.rows.rows(), jacobian.rows.cols());
  jacobian.frozen.assign(space.n(), false);
  for (std::size_t k = 0; k < space.n(); ++k) {
    bool one_sided = false;
    std::string why;
    for (std::size_t i = 0; i < problem.targets.size(); ++i) {
      const std::size_t target = problem.targets[i];
      const auto up = evaluator.value(above[k], target), down = evaluator.value(below[k], target);
      const auto here = evaluator.value(point, target);
      if (!up.had()) why = up.why;
      if (!down.had()) why = down.why;
      double slope = 0, spread = steps[k];
      if (up.had() && down.had()) {
        spread = 2 * steps[k];
        slope = (up.value - down.value) / spread;
      } else if (up.had() && here.had()) {
        slope = (up.value - here.value) / spread;
        one_sided = true;
      } else if (down.had() && here.had()) {
        slope = (here.value - down.value) / spread;
        one_sided = true;
      } else {
        jacobian.frozen[k] = true;
      }
      jacobian.rows(index(i), index(k)) = slope / problem.sd[i];
      jacobian.noise_sd(index(i), index(k)) =
          std::sqrt(2.0) * problem.noise[i] / (spread * problem.sd[i]);
    }
    if (jacobian.frozen[k]) {
      jacobian.rows.col(index(k)).setZero();
      jacobian.noise_sd.col(index(k)).setZero();
      jacobian.notes.push_back(
          fmt::format("{} was held where it was for one step: the runs on both sides of it gave "
                      "no figure ({})",
                      space.names()[k], why));
    } else if (one_sided) {
      jacobian.notes.push_back(
          fmt::format("the derivative by {} is one-sided: a run beside it gave no figure ({})",
                      space.names()[k], why));
    }
  }
  hold_at_bounds(evaluator, problem, point, jacobian);
  return jacobian;
}

}  // namespace bondlab
