// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how large the statistics of a diagnosis get when the model is right: thresholds for a wanted
//   false-alarm rate, and p-values.
// Method: parametric bootstrap. Whitened noise, divided for every kind of test by a noise scale
//   that is itself estimated with the replicates' degrees of freedom, is projected off the
//   Jacobian; the largest omnibus score and the largest admissible score of a trace are kept.
//   Linear, so a draw costs microseconds; drawn once for a study and used for every data set with
//   the same rows. The two thresholds for detection are equally rare, and so rare that either is
//   passed with the wanted rate: found by bisection over the draws. What is left after an effect is
//   judged more strictly: a right name must not be lost, and a second effect not be invented, as
//   often as an alarm may be false.
// Units: none. Failure: none. Limits: with n draws a p-value below 1/n cannot be told from 1/n; the
//   thresholds at 1 % of 4,000 draws are known to some 3 % in rate (relative 16 %).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/random.h"
#include "diagnose/omnibus.h"
#include "diagnose/refit.h"

namespace bondlab::diagnose {

struct NullTable {
  std::vector<double> omnibus, trace;  // sorted
  double rate = 0.01;
  double omnibus_alarm = 0, trace_alarm = 0;    // together passed with `rate`
  double omnibus_strict = 0, trace_strict = 0;  // each passed with a third, a tenth of `rate`
};

// Share of `sorted` at or above `value`, at least 1 / (n + 1).
double p_value(const std::vector<double> &sorted, double value);

// One data set of noise alone, whitened as that data set's own noise estimate has it, and the model
// in the same units.
struct NullDraw {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian, traces;  // empty: those of the model
};
using NullSource = std::function<NullDraw(RandomStream &)>;

NullTable make_null_table(const Omnibus &omnibus, const Linearisation &model,
                          const std::vector<EffectEntry> &catalogue, const NullSource &source,
                          double rate, int draws, std::uint64_t seed);

// Draws with the scatter as stated, and its scale estimated with the dof there are.
NullTable make_null_table(const Omnibus &omnibus, const Linearisation &model,
                          const std::vector<EffectEntry> &catalogue, const Evidence &evidence,
                          const NoiseEstimate &noise, double rate, int draws, std::uint64_t seed);

}  // namespace bondlab::diagnose
