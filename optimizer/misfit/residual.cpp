// SPDX-License-Identifier: GPL-2.0-or-later
#include "misfit/residual.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace bondlab {

double combined_sd(double measured_sd, double simulated_sd) {
  return std::isnan(simulated_sd) ? measured_sd : std::hypot(measured_sd, simulated_sd);
}

double simulation_sd(double noise_sd, double packing_sd) {
  return std::max(std::isnan(noise_sd) ? 0.0 : noise_sd, std::isnan(packing_sd) ? 0.0 : packing_sd);
}

ResidualRow residual(const Target &target, const ResponseValue &simulated, double sd, int packing) {
  assert(sd > 0);
  ResidualRow row;
  row.target = target.name;
  row.test = target.test;
  row.envelope = target.envelope;
  row.response = target.response;
  row.packing = packing;
  row.measured = target.value;
  row.simulated = simulated.value;
  row.sd = sd;
  row.why = simulated.why;
  row.value = simulated.had() ? (simulated.value - target.value) / sd
                              : std::numeric_limits<double>::quiet_NaN();
  return row;
}

double sum_of_squares(const std::vector<ResidualRow> &rows) {
  double sum = 0;
  for (const auto &row : rows) sum += row.value * row.value;  // NaN stays NaN
  return sum;
}

}  // namespace bondlab
