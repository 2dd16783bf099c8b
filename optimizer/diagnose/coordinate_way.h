// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how the rows of each packing change along one coordinate of a model: a parameter, an effect.
// Method: a straight line or a parabola through the origin, row by row; bent only where the mean
//   bend over the packings is beyond 2.5 of its standard errors. What chance makes of a straight
//   row's mean is kept beside it (emulated_prober.h says how it is used).
// Units: x as the emulator's, rows. Failure: a row that fewer than three packings have at all knots
//   is `unknown` and does not change; with all unknown the way is `dead`.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace bondlab::diagnose {

constexpr int least_packings = 3;  // that a row's change is known from

// One coordinate.
struct Way {
  double low = 0, high = 0;         // outermost knots
  Eigen::MatrixXd linear, squared;  // packings x rows
  Eigen::MatrixXd below;            // slope at negative x, where it is another one; else empty
  Eigen::RowVectorXd noise, noise_below;  // of the mean slopes, what chance makes
  Eigen::Array<bool, Eigen::Dynamic, 1> unknown;
  bool dead = false;
  Eigen::MatrixXd at(double x) const;  // packings x rows
  Eigen::RowVectorXd noise_at(double x) const;
};

// Packings that lack a row (NaN) stand at the mean of the others there; a row that fewer than
// least_packings have is left as it is.
Eigen::MatrixXd with_means_where_lacking(Eigen::MatrixXd rows);

// `changes`: packings x rows at each of `knots` (x, not 0), from the centre.
Way way_through(const std::vector<double> &knots, const std::vector<Eigen::MatrixXd> &changes);

}  // namespace bondlab::diagnose
