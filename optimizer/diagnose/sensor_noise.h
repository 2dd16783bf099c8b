// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how much of a row's scatter the sensors make, read from the curves themselves.
// Method: what a sensor adds from point to point shows in the second differences of a column: their
//   median over 0.6745 sqrt(6) is its sd, whatever breaks in between. It is taken for noise only
//   where neighbouring second differences of all specimens' curves together go against each other
//   as those of white noise do (correlation -2/3; a drift has -1/2; here below -0.55), because
//   those of a smooth curve are all alike, and one curve's correlation is uncertain by 0.1. The
//   noise is then added to the curve anew, and the scatter of the rows over such draws is what it
//   makes of them.
// Why: a row that packings hardly scatter in has its noise from the sensor alone, and a handful of
//   specimens agree by luck now and then; hundreds of points do not.
// Source: Gasser, Sroka & Jennen-Steinmetz, Biometrika 73 (1986) 625 (variance from differences).
// Units: as the curves and rows. Failure: a curve of fewer than 20 points shows none.
// Limits: white noise of one size a column. Gains and drifts of a sensor are not seen.
#pragma once

#include <cstdint>
#include <vector>

#include "diagnose/curve_rows.h"

namespace bondlab::diagnose {

// Sd of one channel in each of the curves that have it; 0 where there is none to be seen.
std::vector<double> white_noise(const std::vector<std::vector<double>> &columns);

// Variance of the rows by the noise of the curves, mean over the curves (replicates of one test).
// A row that fewer than half of the draws have is given none.
Eigen::VectorXd sensor_variance(const std::vector<Curve> &replicates,
                                const std::vector<CurveQuantity> &quantities,
                                const TestDefinition &test,
                                const std::map<std::string, double> &variables, std::uint64_t seed);

}  // namespace bondlab::diagnose
