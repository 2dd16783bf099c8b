// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: takes a fit that was made on the emulator to where the engine itself has it.
// Method: the engine is run at the fit; what its own rows leave of the data, through the fit's
//   linear model, is a step of the parameters and of the amplitudes that are on, and the engine is
//   run there. Kept where chi squared falls; at most two steps, and none that is short against what
//   is known (a third of an sd in every direction).
// Units: z, amplitudes; rows as the prober's. Failure: a point whose rows are not finite is not
//   taken; when the engine has no rows at the fit itself, the emulator's stand and `ok` is false.
#pragma once

#include <functional>

#include "diagnose/refit.h"

namespace bondlab::diagnose {

// The engine's rows (those fitted) at points.
using EngineRows = std::function<std::vector<Eigen::VectorXd>(const std::vector<ModelPoint> &)>;

struct EngineFit {
  bool ok = false;
  int steps = 0;          // taken
  double chi2 = 0;        // of the engine's rows
  double chi2_first = 0;  // at the emulator's fit
};

// Moves `fit` (point and residual); its columns and covariance stay.
EngineFit fit_on_engine(Refit &fit, const EngineRows &engine, const Whitening &whitening,
                        const std::vector<EffectEntry> &catalogue);

}  // namespace bondlab::diagnose
