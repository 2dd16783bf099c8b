// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/placebo.h"

#include <cmath>

namespace bondlab::diagnose {

namespace {

constexpr double small = 0.05;  // of the largest row

}  // namespace

std::optional<Eigen::VectorXd> placebo_of(const Eigen::VectorXd &trace, RandomStream &random) {
  const auto carries = [&](Eigen::Index row) {
    return std::abs(trace(row)) > small * trace.cwiseAbs().maxCoeff();
  };
  int carrying = 0;
  for (Eigen::Index row = 0; row < trace.size(); ++row) carrying += carries(row);
  if (carrying < 2) return {};
  for (;;) {  // two rows part in every second draw
    Eigen::VectorXd placebo = trace;
    int flipped = 0;
    for (Eigen::Index row = 0; row < trace.size(); ++row)
      if (random.uniform() < 0.5) placebo(row) = -placebo(row), flipped += carries(row);
    if (flipped > 0 && flipped < carrying) return placebo;
  }
}

}  // namespace bondlab::diagnose
