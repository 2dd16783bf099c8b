// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a smooth stand-in for one response over the runs already made: slopes before there is a
//   Jacobian, a first guess from the design points, a last look through the noise of single runs.
// Method: weighted linear regression in the position u of each parameter between its bounds (on its
//   own scale), with or without squares, of the response or of its logarithm; of these four the one
//   with the smallest leave-one-out error is kept. On a logarithmic scale a power law, the usual
//   shape of a bonded assembly's responses, is exactly linear.
// Why not kriging: a dozen noisy points in three dimensions carry a plane, hardly more, and a plane
//   says what it knows.
// Units: SI. Failure: no model (nullopt) when there are too few points for a straight plane and one
//   to spare.
// Limits: no cross terms; never a result, only a proposal where to run next (fit_result.h holds
//   runs only).
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "study/parameter_space.h"

namespace bondlab {

class ResponseModel {
 public:
  // values[i] belongs to points[i]; points with NaN or zero weight are left out. The space must
  // outlive the model.
  static std::optional<ResponseModel> fit(const ParameterSpace &space,
                                          const std::vector<TransformedPoint> &points,
                                          const std::vector<double> &values,
                                          const std::vector<double> &weights);

  double value(const TransformedPoint &point) const;
  Eigen::VectorXd gradient(const TransformedPoint &point) const;  // by transformed coordinates
  double error() const { return error_; }  // leave-one-out, relative to the mean size

 private:
  const ParameterSpace *space_ = nullptr;
  bool logarithm_ = false, squares_ = false;
  Eigen::VectorXd coefficients_;
  double error_ = 0;
};

// Position between the bounds of every parameter.
std::vector<double> unit_positions(const ParameterSpace &space, const TransformedPoint &point);

}  // namespace bondlab
