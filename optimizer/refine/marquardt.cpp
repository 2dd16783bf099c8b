// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/marquardt.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace bondlab {

namespace {

constexpr int rejections_in_a_row = 3;
// A first step damped by 1 %: nearly Gauss-Newton, and short enough after a few rejections (the
// radius falls by 2, 4, 8).
constexpr double first_radius = 100, least_first_radius = 0.1;
// In z, from the middle of the bounds to 82 % of them; beyond it a linear forecast through the
// logit means nothing.
constexpr double longest_first_step = 1.5;
// Rejected steps end a search when what a step promises is of the size of the noise; else they only
// shorten it.
constexpr double gain_worth_more_steps = 4;

// What the cost function and the callback share during one search.
struct Search {
  Search(Evaluator &runs, const FitProblem &fit, const MarquardtOptions &settings,
         const std::function<void(const MarquardtStep &)> &sink, MarquardtResult &out)
      : evaluator(runs),
        problem(fit),
        options(settings),
        on_step(sink),
        result(out),
        keep_allowed(settings.keep_jacobian) {}

  Evaluator &evaluator;
  const FitProblem &problem;
  const MarquardtOptions &options;
  const std::function<void(const MarquardtStep &)> &on_step;
  MarquardtResult &result;
  bool have_jacobian = false, keep_allowed, kept = false;
  TransformedPoint last_trial;
  bool trial_pending = false, trial_failed = false;
  std::string trial_note;
  int rejected = 0;
  std::exception_ptr
      stopped;  // thrown after Ceres has returned: its frames need not know exceptions
};

bool within_half_a_step(const TransformedPoint &point, const Jacobian &jacobian) {
  for (std::size_t k = 0; k < point.z.size(); ++k)
    if (std::fabs(point.z[k] - jacobian.point.z[k]) > 0.5 * jacobian.steps[k]) return false;
  return true;
}

void make_jacobian(Search &search, const TransformedPoint &point) {
  auto &result = search.result;
  if (search.have_jacobian && point.z == result.jacobian.point.z) return;
  search.kept = search.have_jacobian && search.keep_allowed && !result.jacobian.any_frozen() &&
                within_half_a_step(point, result.jacobian);
  if (search.kept) {
    hold_at_bounds(search.evaluator, search.problem, point, result.jacobian);
    return;
  }
  const Eigen::MatrixXd slopes = search.have_jacobian
                                     ? result.jacobian.rows
                                     : regression_slopes(search.evaluator, search.problem, point);
  const auto steps = difference_steps(search.evaluator.space(), search.problem, point, slopes,
                                      search.options.relative_step);
  result.jacobian = difference_jacobian(search.evaluator, search.problem, point, steps);
  result.notes.insert(result.notes.end(), result.jacobian.notes.begin(),
                      result.jacobian.notes.end());
  ++result.jacobians;
  search.have_jacobian = true;
}

// Derivatives of targets and prior. A parameter that is frozen or held has none: not even the prior
// moves it.
Eigen::MatrixXd stacked_rows(const Search &search) {
  const auto &jacobian = search.result.jacobian;
  const Eigen::Index n = jacobian.rows.rows(), p = jacobian.rows.cols();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + p, p);
  for (Eigen::Index k = 0; k < p; ++k) {
    if (!jacobian.moves(static_cast<std::size_t>(k))) continue;
    a.col(k).head(n) = jacobian.rows.col(k);
    a(n + k, k) = 1 / search.problem.prior_sd;
  }
  return a;
}

class RunCost : public ceres::CostFunction {
 public:
  explicit RunCost(Search &search) : search_(search) {
    const int p = static_cast<int>(search.evaluator.space().n());
    set_num_residuals(static_cast<int>(search.problem.targets.size()) + p);
    mutable_parameter_block_sizes()->push_back(p);
  }

  bool Evaluate(double const *const *parameters, double *residuals,
                double **jacobians) const override {
    double *jacobian = jacobians ? jacobians[0] : nullptr;
    try {
      if (!search_.stopped) return evaluate(parameters[0], residuals, jacobian);
    } catch (...) {
      search_.stopped = std::current_exception();
    }
    if (!jacobian) return false;  // a rejected step
    // Ceres logs a failed Jacobian to stderr, and a library is silent: it gets zeros, and the
    // callback ends the search.
    std::fill_n(residuals, num_residuals(), 0.0);
    std::fill_n(jacobian, num_residuals() * parameter_block_sizes().front(), 0.0);
    return true;
  }

 private:
  bool evaluate(const double *z, double *residuals, double *jacobian) const {
    const Eigen::Index p = static_cast<Eigen::Index>(search_.evaluator.space().n());
    const Eigen::Index n = num_residuals() - p;
    const TransformedPoint point{std::vector<double>(z, z + p)};
    search_.evaluator.run({point}, search_.problem.targets, "refine");
    if (!jacobian) {
      search_.last_trial = point;
      search_.trial_pending = true;
      search_.trial_failed = false;
    }
    const auto rows = standardised(search_.evaluator, search_.problem, point);
    if (!rows) {
      search_.trial_failed = true;
      for (const std::size_t target : search_.problem.targets) {
        const auto value = search_.evaluator.value(point, target);
        if (!value.had()) search_.trial_note = value.why;
      }
      return false;
    }
    Eigen::Map<Eigen::VectorXd> r(residuals, n + p);
    r << *rows, prior_rows(search_.problem, point);
    if (jacobian) {
      make_jacobian(search_, point);
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      Eigen::Map<RowMajor> a(jacobian, n + p, p);
      a = stacked_rows(search_);
    }
    return true;
  }

  Search &search_;
};

class StepWatch : public ceres::IterationCallback {
 public:
  StepWatch(Search &search, const std::vector<double> &z) : search_(search), z_(z) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary &summary) override {
    if (search_.stopped) return ceres::SOLVER_ABORT;
    auto &result = search_.result;
    const bool first = summary.iteration == 0;
    if (!first && search_.trial_pending) report_trial(summary.step_is_successful);
    if (first || summary.step_is_successful) {
      result.point.z = z_;
      search_.rejected = 0;
      result.stationarity = judge_stationarity(search_.evaluator, search_.problem, result.point,
                                               result.jacobian, search_.options.immaterial);
      if (result.stationarity.stationary) {
        result.converged = true;
        result.ended = "the gradient is zero within the noise of the responses";
        return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
      }
    } else if (++search_.rejected >= rejections_in_a_row &&
               (search_.kept || result.stationarity.gain <=
                                    gain_worth_more_steps * result.stationarity.noise_gain)) {
      result.ended = fmt::format("{} steps in a row found nothing better", search_.rejected);
      return ceres::SOLVER_ABORT;
    }
    if (result.trials >= search_.options.max_iterations) {
      result.limit_reached = true;
      result.ended =
          fmt::format("the limit of {} steps was reached", search_.options.max_iterations);
      return ceres::SOLVER_ABORT;
    }
    return ceres::SOLVER_CONTINUE;
  }

 private:
  void report_trial(bool accepted) {
    search_.trial_pending = false;
    ++search_.result.trials;
    if (accepted) ++search_.result.accepted;
    MarquardtStep step{search_.last_trial, std::numeric_limits<double>::quiet_NaN(), accepted, ""};
    if (search_.trial_failed) {
      step.note = "step taken back, it gave no figure: " + search_.trial_note;
      search_.result.notes.push_back(step.note);
    } else {
      step.misfit = misfit(search_.evaluator, search_.problem, search_.last_trial);
    }
    if (search_.on_step) search_.on_step(step);
  }

  Search &search_;
  const std::vector<double> &z_;
};

// Radius of the trust region whose first Levenberg-Marquardt step is not longer than a linear
// forecast is good for. Near a bound the logit is flat and an undamped step would leap to the other
// bound.
double first_trust_radius(const Search &search, const TransformedPoint &start) {
  const auto rows = standardised(search.evaluator, search.problem, start);
  const Eigen::MatrixXd a = stacked_rows(search);
  Eigen::VectorXd r(a.rows());
  r << *rows, prior_rows(search.problem, start);
  const Eigen::MatrixXd hessian = a.transpose() * a;
  const Eigen::VectorXd gradient = a.transpose() * r;
  double radius = first_radius;
  for (; radius > least_first_radius; radius /= 2) {
    Eigen::MatrixXd damped = hessian;
    damped.diagonal() *= 1 + 1 / radius;
    damped.diagonal().array() +=
        std::numeric_limits<double>::min();  // parameters that don't move have zeros here
    if (damped.ldlt().solve(gradient).cwiseAbs().maxCoeff() <= longest_first_step) break;
  }
  return radius;
}

void solve_once(Search &search, std::vector<double> &z) {
  make_jacobian(search, TransformedPoint{z});
  RunCost cost(search);
  StepWatch watch(search, z);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, z.data());

  ceres::Solver::Options options;
  options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  options.linear_solver_type = ceres::DENSE_QR;
  options.initial_trust_region_radius = first_trust_radius(search, TransformedPoint{z});
  options.max_num_iterations =
      search.options.max_iterations + rejections_in_a_row;  // our own count ends it
  options.function_tolerance = 0;  // only judge_stationarity() may call a point converged
  options.gradient_tolerance = 0;
  options.parameter_tolerance = 1e-9;
  options.max_num_consecutive_invalid_steps = search.options.max_iterations;
  options.update_state_every_iteration = true;
  options.callbacks.push_back(&watch);
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (search.stopped) std::rethrow_exception(search.stopped);
  if (search.result.ended.empty()) search.result.ended = "no step of any length changed the misfit";
}

}  // namespace

MarquardtResult marquardt(Evaluator &evaluator, const FitProblem &problem,
                          const TransformedPoint &start, const MarquardtOptions &options,
                          const std::function<void(const MarquardtStep &)> &on_step) {
  MarquardtResult result;
  result.point = start;
  evaluator.run({start}, problem.targets, "refine");
  if (!evaluator.complete(start, problem.targets)) {
    result.ended = "the start gave no figures";
    return result;
  }
  result.started = true;
  Search search(evaluator, problem, options, on_step, result);
  for (;;) {
    std::vector<double> z = result.point.z;
    search.rejected = 0;
    result.ended.clear();
    solve_once(search, z);
    // Rejections under a kept Jacobian may be its fault: once more with one made at the point
    // itself.
    const bool again = !result.converged && search.kept && result.trials < options.max_iterations;
    if (!again) break;
    search.keep_allowed = false;
  }
  if (!result.converged)
    result.ended += fmt::format("; a further step promises to lower the misfit by {:.3g}",
                                result.stationarity.gain);
  return result;
}

}  // namespace bondlab
