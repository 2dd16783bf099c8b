// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/response_model.h"

#include <cmath>
#include <limits>

namespace bondlab {

namespace {

constexpr double gradient_step =
    1e-4;  // in z; the model is a closed form, so only rounding limits it

Eigen::VectorXd basis(const std::vector<double> &u, bool squares) {
  const Eigen::Index p = static_cast<Eigen::Index>(u.size());
  Eigen::VectorXd row(1 + (squares ? 2 : 1) * p);
  row(0) = 1;
  for (Eigen::Index k = 0; k < p; ++k) {
    const double centred = u[static_cast<std::size_t>(k)] - 0.5;
    row(1 + k) = centred;
    if (squares) row(1 + p + k) = centred * centred;
  }
  return row;
}

struct Regression {
  Eigen::VectorXd coefficients;
  double error = std::numeric_limits<double>::infinity();
};

// Weighted least squares with the leave-one-out error from the leverages (no refits needed for a
// linear model).
std::optional<Regression> regress(const Eigen::MatrixXd &rows, const Eigen::VectorXd &y,
                                  const Eigen::VectorXd &weight) {
  const Eigen::VectorXd root = weight.cwiseSqrt();
  const Eigen::MatrixXd a = root.asDiagonal() * rows;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
  if (qr.rank() < rows.cols()) return std::nullopt;
  Regression regression;
  regression.coefficients = qr.solve(root.asDiagonal() * y);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(a.rows(), a.cols());
  double sum = 0;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double leverage = q.row(i).squaredNorm();
    if (leverage > 1 - 1e-9)
      return std::nullopt;  // a point that alone decides a coefficient can't be judged
    const double left_out = (y(i) - rows.row(i).dot(regression.coefficients)) / (1 - leverage);
    sum += weight(i) * left_out * left_out;
  }
  regression.error = std::sqrt(sum / weight.sum());
  return regression;
}

}  // namespace

std::vector<double> unit_positions(const ParameterSpace &space, const TransformedPoint &point) {
  const auto physical = space.to_physical(point);
  std::vector<double> u(space.n());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = space.unit_position(k, physical.x[k]);
  return u;
}

std::optional<ResponseModel> ResponseModel::fit(const ParameterSpace &space,
                                                const std::vector<TransformedPoint> &points,
                                                const std::vector<double> &values,
                                                const std::vector<double> &weights) {
  std::vector<std::size_t> use;
  bool positive = true;
  double size = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(values[i]) || !(weights[i] > 0)) continue;
    use.push_back(i);
    positive = positive && values[i] > 0;
    size += std::fabs(values[i]);
  }
  if (use.empty() || !(size > 0)) return std::nullopt;
  const Eigen::Index n = static_cast<Eigen::Index>(use.size());
  size /= static_cast<double>(n);

  ResponseModel best;
  best.space_ = &space;
  best.error_ = std::numeric_limits<double>::infinity();
  for (const bool squares : {false, true}) {
    const Eigen::Index columns = static_cast<Eigen::Index>(1 + (squares ? 2 : 1) * space.n());
    if (n < columns + 1) continue;
    Eigen::MatrixXd rows(n, columns);
    Eigen::VectorXd weight(n), y(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t from = use[static_cast<std::size_t>(i)];
      rows.row(i) = basis(unit_positions(space, points[from]), squares).transpose();
      weight(i) = weights[from];
      y(i) = values[from];
    }
    for (const bool logarithm : {false, true}) {
      if (logarithm && !positive) continue;
      // Both errors are relative: the logarithm's by nature, the other by the mean size of the
      // response.
      const auto regression =
          regress(rows, logarithm ? y.array().log().matrix() : (y / size).eval(), weight);
      if (!regression || regression->error >= best.error_) continue;
      best.logarithm_ = logarithm;
      best.squares_ = squares;
      best.coefficients_ =
          logarithm ? regression->coefficients : (regression->coefficients * size).eval();
      best.error_ = regression->error;
    }
  }
  if (!std::isfinite(best.error_)) return std::nullopt;
  return best;
}

double ResponseModel::value(const TransformedPoint &point) const {
  const double linear = basis(unit_positions(*space_, point), squares_).dot(coefficients_);
  return logarithm_ ? std::exp(linear) : linear;
}

Eigen::VectorXd ResponseModel::gradient(const TransformedPoint &point) const {
  Eigen::VectorXd slope(static_cast<Eigen::Index>(space_->n()));
  for (std::size_t k = 0; k < space_->n(); ++k) {
    auto above = point, below = point;
    above.z[k] += gradient_step;
    below.z[k] -= gradient_step;
    slope(static_cast<Eigen::Index>(k)) = (value(above) - value(below)) / (2 * gradient_step);
  }
  return slope;
}

}  // namespace bondlab
