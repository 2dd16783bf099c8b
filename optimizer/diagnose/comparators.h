// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: three simpler ways to name a cause, to hold the diagnosis against on the same data.
// Method: (1) largest residual: the block with the largest score decides; the effect whose trace
// has
//   the largest share of its energy there is named. (2) refit each, BIC: the effect (or none) with
//   the lowest chi2 + k log n, by its linear refit. (3) LASSO on the traces, off what the
//   parameters can do, amplitudes of the admissible sign; the penalty with the lowest BIC; the
//   largest coefficient is named, the others are offered with it.
// Source: Schwarz 1978; Tibshirani 1996, coordinate descent (Friedman et al. 2010).
// Units: none. Failure: none.
#pragma once

#include <vector>

#include "diagnose/omnibus.h"
#include "diagnose/score.h"

namespace bondlab::diagnose {

// Names of effects, best first; empty: nothing missing.
using Naming = std::vector<std::size_t>;

Naming name_by_largest_residual(const Omnibus &omnibus, const Omnibus::Prepared &prepared,
                                const ScoreTable &scores, const Eigen::VectorXd &residual,
                                double alarm);
Naming name_by_bic(const ScoreTable &scores, const Eigen::VectorXd &residual);
Naming name_by_lasso(const ScoreTable &scores, const std::vector<EffectEntry> &catalogue,
                     const Eigen::VectorXd &residual);

}  // namespace bondlab::diagnose
