// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/engine_fit.h"

#include <algorithm>
#include <cmath>

namespace bondlab::diagnose {

namespace {

constexpr int most_steps = 2;
constexpr double worth_a_run = 1.0 / 3;  // sd

}  // namespace

EngineFit fit_on_engine(Refit &fit, const EngineRows &engine, const Whitening &whitening,
                        const std::vector<EffectEntry> &catalogue) {
  EngineFit out;
  Eigen::VectorXd residual = whitening.residual(engine({fit.point}).front());
  if (!residual.allFinite()) return out;
  out.ok = true;
  out.chi2 = out.chi2_first = residual.squaredNorm();
  const Eigen::Index p = fit.point.z.size();
  const auto q = static_cast<Eigen::Index>(fit.effects.size());
  Eigen::MatrixXd normal = fit.columns.transpose() * fit.columns;
  normal.diagonal() += refit_damping(p, q).cwiseAbs2();
  const auto solver = normal.ldlt();
  const Eigen::VectorXd sd = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  while (out.steps < most_steps) {
    const Eigen::VectorXd step = solver.solve(fit.columns.transpose() * residual);
    if ((step.cwiseAbs() - worth_a_run * sd).maxCoeff() <= 0) break;
    ModelPoint trial = fit.point;
    std::vector<bool> at_bound = fit.at_bound;
    move_point(trial, step, fit.effects, catalogue, at_bound);
    const Eigen::VectorXd next = whitening.residual(engine({trial}).front());
    if (!next.allFinite() || next.squaredNorm() >= out.chi2) break;
    fit.point = trial;
    fit.at_bound = at_bound;
    fit.residual = residual = next;
    out.chi2 = next.squaredNorm();
    ++out.steps;
  }
  return out;
}

}  // namespace bondlab::diagnose
