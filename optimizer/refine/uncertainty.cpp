// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace bondlab {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double rank_tolerance = 1e-8;
constexpr double loading_that_counts = 0.2;  // of a unit null direction: 4 % of its square
constexpr double shown_change = 10;          // %, the largest change in a ridge put into words

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

struct Directions {
  Eigen::MatrixXd fixed, null;  // columns: directions in the space of the free parameters
  Eigen::VectorXd singular;     // of `fixed`
};

Directions split_directions(const Eigen::MatrixXd &rows, const Eigen::MatrixXd &noise) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::Index p = rows.cols();
  Eigen::VectorXd singular = Eigen::VectorXd::Zero(p);
  singular.head(svd.singularValues().size()) = svd.singularValues();
  std::vector<Eigen::Index> fixed, null;
  for (Eigen::Index j = 0; j < p; ++j) {
    const Eigen::VectorXd v2 = svd.matrixV().col(j).cwiseAbs2();
    const double from_noise = std::sqrt((noise.cwiseAbs2() * v2).sum());
    const double least = std::max(2 * from_noise, rank_tolerance * singular.maxCoeff());
    (singular(j) > least ? fixed : null).push_back(j);
  }
  Directions directions;
  directions.fixed.resize(p, index(fixed.size()));
  directions.null.resize(p, index(null.size()));
  directions.singular.resize(index(fixed.size()));
  for (std::size_t j = 0; j < fixed.size(); ++j) {
    directions.fixed.col(index(j)) = svd.matrixV().col(fixed[j]);
    directions.singular(index(j)) = singular(fixed[j]);
  }
  for (std::size_t j = 0; j < null.size(); ++j)
    directions.null.col(index(j)) = svd.matrixV().col(null[j]);
  return directions;
}

// "raising E_c by 10 % and lowering k_n/k_s by 4 % changes no target by more than the noise"
std::string ridge_in_words(const ParameterSpace &space, const std::vector<std::size_t> &free,
                           const Eigen::VectorXd &direction, const TransformedPoint &point) {
  const auto physical = space.to_physical(point);
  Eigen::VectorXd change(direction.size());
  for (Eigen::Index k = 0; k < direction.size(); ++k) {
    const std::size_t parameter = free[static_cast<std::size_t>(k)];
    change(k) = direction(k) * space.dx_dz(parameter, point.z[parameter]) / physical.x[parameter];
  }
  Eigen::Index largest = 0;
  change.cwiseAbs().maxCoeff(&largest);
  change *= shown_change / change(largest);
  std::vector<std::string> parts;
  for (Eigen::Index k = 0; k < change.size(); ++k)
    if (std::fabs(change(k)) >= 0.05 * shown_change)
      parts.push_back(fmt::format("{} {} by {:.2g} %", change(k) > 0 ? "raising" : "lowering",
                                  space.names()[free[static_cast<std::size_t>(k)]],
                                  std::fabs(change(k))));
  return fmt::format("{} changes no target of the fit beyond the noise", fmt::join(parts, " and "));
}

// In which direction the data push a parameter: -1 down, 1 up, 0 not at all (within the noise of
// the rows).
int push_of_data(const Eigen::VectorXd &column, const Eigen::VectorXd &standardised) {
  const double gradient = column.dot(standardised), size = column.norm();
  if (size == 0 || std::fabs(gradient) <= size) return 0;  // less than one sd along this parameter
  return gradient > 0 ? -1 : 1;
}

std::string reason_at_bound(const ParameterSpace &space, std::size_t k, BoundSide side, int push) {
  const auto &parameter = space.parameter(k);
  const bool lower = side == BoundSide::lower;
  const std::string where =
      fmt::format("lies at its {} bound, {}", lower ? "lower" : "upper",
                  format_quantity(lower ? parameter.lower : parameter.upper, parameter.unit));
  if (push == (lower ? -1 : 1)) return where + "; the data ask for a value beyond it";
  if (push == 0) return where + "; the data do not say whether a value beyond it would be better";
  return where + "; the data pull back from it: this is not a minimum";
}

}  // namespace

Jacobian reweighted(const Jacobian &jacobian, const FitProblem &from, const FitProblem &to) {
  Jacobian scaled = jacobian;
  for (std::size_t i = 0; i < from.sd.size(); ++i) {
    scaled.rows.row(index(i)) *= from.sd[i] / to.sd[i];
    scaled.noise_sd.row(index(i)) *= from.sd[i] / to.sd[i];
  }
  return scaled;
}

Uncertainty judge_parameters(const ParameterSpace &space, const FitProblem &problem,
                             const Jacobian &jacobian, const TransformedPoint &point,
                             const Eigen::VectorXd &standardised) {
  Uncertainty uncertainty;
  const auto physical = space.to_physical(point);
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < space.n(); ++k) {
    const auto &parameter = space.parameter(k);
    ParameterResult result;
    result.name = parameter.name;
    result.unit = parameter.unit;
    result.value = physical.x[k];
    result.lower = parameter.lower;
    result.upper = parameter.upper;
    result.sd = result.interval_lower = result.interval_upper = nan;
    result.at_bound = space.at_bound(k, physical.x[k], bound_fraction);
    if (result.at_bound != BoundSide::none) {
      result.identifiable = false;
      result.reason = reason_at_bound(space, k, result.at_bound,
                                      push_of_data(jacobian.rows.col(index(k)), standardised));
    } else if (jacobian.frozen[k]) {
      result.identifiable = false;
      result.reason = "the runs beside its value failed, so nothing is known about it";
    } else {
      free.push_back(k);
    }
    uncertainty.parameters.push_back(std::move(result));
  }
  if (free.empty()) return uncertainty;

  Eigen::MatrixXd rows(jacobian.rows.rows(), index(free.size())), noise(rows.rows(), rows.cols());
  for (std::size_t k = 0; k < free.size(); ++k) {
    rows.col(index(k)) = jacobian.rows.col(index(free[k]));
    noise.col(index(k)) = jacobian.noise_sd.col(index(free[k]));
  }
  const auto directions = split_directions(rows, noise);
  const Eigen::VectorXd inverse = directions.singular.cwiseAbs2().cwiseInverse();
  const Eigen::VectorXd data_variance = directions.fixed.cwiseAbs2() * inverse;
  // With the prior each kept direction gains its 1 / prior_sd^2.
  const double prior = 1 / (problem.prior_sd * problem.prior_sd);
  const Eigen::VectorXd with_prior = (directions.singular.cwiseAbs2().array() + prior).inverse();
  const Eigen::MatrixXd covariance =
      directions.fixed * with_prior.asDiagonal() * directions.fixed.transpose();

  for (Eigen::Index j = 0; j < directions.null.cols(); ++j) {
    Finding ridge;
    ridge.kind = FindingKind::ridge;
    ridge.text = ridge_in_words(space, free, directions.null.col(j), point);
    uncertainty.ridges.push_back(ridge);
  }
  for (std::size_t k = 0; k < free.size(); ++k) {
    const std::size_t parameter = free[k];
    auto &result = uncertainty.parameters[parameter];
    const double loading =
        directions.null.cols() ? directions.null.row(index(k)).cwiseAbs().maxCoeff() : 0.0;
    if (loading > loading_that_counts) {
      Eigen::Index which = 0;
      directions.null.row(index(k)).cwiseAbs().maxCoeff(&which);
      result.identifiable = false;
      result.reason = uncertainty.ridges[static_cast<std::size_t>(which)].text;
      continue;
    }
    // d position / d z by the space's own transform: dx/dz over dx/du, with u between the bounds.
    const double z = point.z[parameter], h = 1e-4;
    auto above = point, below = point;
    above.z[parameter] = z + h;
    below.z[parameter] = z - h;
    const double du_dz = (space.unit_position(parameter, space.to_physical(above).x[parameter]) -
                          space.unit_position(parameter, space.to_physical(below).x[parameter])) /
                         (2 * h);
    const double u = space.unit_position(parameter, result.value);
    const double sd_u = du_dz * std::sqrt(data_variance(index(k)));
    const double rise_lower = std::pow(u / sd_u, 2), rise_upper = std::pow((1 - u) / sd_u, 2);
    if (std::max(rise_lower, rise_upper) < flat_profile_rise) {
      result.identifiable = false;
      result.reason = "any value between its bounds meets the data about equally well";
      continue;
    }
    const double sd_z = std::sqrt(covariance(index(k), index(k)));
    result.sd = sd_z * space.dx_dz(parameter, z);
    above.z[parameter] = z + interval_width * sd_z;
    below.z[parameter] = z - interval_width * sd_z;
    result.interval_lower = space.to_physical(below).x[parameter];
    result.interval_upper = space.to_physical(above).x[parameter];
    if (rise_lower < flat_profile_rise) result.reason = "the data limit it from above only";
    if (rise_upper < flat_profile_rise) result.reason = "the data limit it from below only";
  }
  if (directions.null.cols() == 0 && free.size() == space.n()) {
    for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
      std::vector<double> row;
      for (Eigen::Index b = 0; b < covariance.cols(); ++b)
        row.push_back(covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b)));
      uncertainty.correlation.push_back(std::move(row));
    }
  }
  return uncertainty;
}

}  // namespace bondlab
