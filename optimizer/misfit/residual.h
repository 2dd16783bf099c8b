// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: measured against simulated as one vector of standardised differences whose rows know where
//   they come from.
// Method: row = (simulated - measured) / sd. The sd of a row joins what is independent: the scatter
//   of the measurement and the scatter of the simulation, sd = sqrt(measured_sd^2 +
//   simulated_sd^2). The simulation's part is its noise under tiny changes of the parameters while
//   a fit runs on one packing, and the larger of noise and packing-to-packing scatter when the
//   uncertainty of the result is judged, because another packing stands for the same rock as well.
// Why standardised: rows of unlike dimension can be added, and the sum of squares can be held
//   against chi squared.
// Units: SI in, rows have none. Failure: a figure that could not be had gives a row with NaN and a
//   reason, never a zero.
#pragma once

#include <string>
#include <vector>

#include "study/study.h"

namespace bondlab {

// A simulated figure, or why there is none.
struct ResponseValue {
  double value;     // SI; NaN when there is none
  std::string why;  // not empty exactly when value is NaN
  bool had() const { return why.empty(); }
};

struct ResidualRow {
  std::string target, test, envelope, response;  // of test and envelope one is empty
  int packing = 0;
  double measured = 0, simulated = 0, sd = 0;
  double value = 0;  // NaN when `why` is not empty
  std::string why;
};

// sqrt(measured_sd^2 + simulated_sd^2); a simulated_sd that is not known (NaN) counts as 0.
double combined_sd(double measured_sd, double simulated_sd);

// What stands for the scatter of one simulated figure: the larger of the two that are known, 0 if
// neither is.
double simulation_sd(double noise_sd, double packing_sd);

ResidualRow residual(const Target &target, const ResponseValue &simulated, double sd,
                     int packing = 0);

// Sum of squares; NaN when a row is missing.
double sum_of_squares(const std::vector<ResidualRow> &rows);

}  // namespace bondlab
