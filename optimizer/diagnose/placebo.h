// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a trace without sense, to see what an effect's freedom alone would do.
// Method: the effect's own trace with a sign drawn for every row: as many parameters, the same rows
//   and the same size in each. Signs that are all alike where the trace is not small would be the
//   effect itself, so they are drawn again; of a trace that one row carries there is no placebo.
// Units: those of the trace. Failure: none; nothing where there is no placebo.
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "base/random.h"

namespace bondlab::diagnose {

std::optional<Eigen::VectorXd> placebo_of(const Eigen::VectorXd &trace, RandomStream &random);

}  // namespace bondlab::diagnose
