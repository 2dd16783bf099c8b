// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how far a parameter is stepped up and down for its difference, from the noise of a pilot.
// Method: a central difference over h has the error n / h of noise, n the standard error of half
//   the difference, and |f'''| h^2 / 6 of what bends; their squares are least at
//   h = (sqrt(18) n / |f'''|)^(1/3). Rows count in what packings scatter (or an instrument errs),
//   together; |f'''| is taken as half of |f'|, as in refine/jacobian.h, and f' without what noise
//   adds to its square.
// Source: optimal steps of noisy differences, More & Wild, ACM Trans. Math. Softw. 38 (2012) 19,
//   and CALIBRATION.md 3.2 of the notes: with steps that noise drowns a solver was right in none of
//   200 starts and claimed success in all.
// Units: steps as the emulator's x; rows any. Failure: where nothing rises above the noise the
//   largest step stands.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace bondlab::diagnose {

constexpr double smallest_parameter_step = 0.04, largest_parameter_step = 0.36;

// `changes`: packings x rows, from the centre, at the pilot's `knots` (one or two, not 0); NaN
// where a packing lacks a row. `scatter`: variance of the rows over packings. `packings`: how many
// the difference will be taken on.
double parameter_step_from_noise(const std::vector<double> &knots,
                                 const std::vector<Eigen::MatrixXd> &changes,
                                 const Eigen::VectorXd &scatter, double packings);

}  // namespace bondlab::diagnose
