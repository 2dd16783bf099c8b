// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the gap between measurement and model before and after, on what was fitted and held out, and
//   what a placebo closes of it.
// Method: root mean square of the whitened rows, one yardstick for both fits (the model's doubt at
//   the fit after). The placebo has the trace of the first effect named with the signs of its rows
//   drawn at random, fitted with the parameters to first order, the mean over 200 draws. The noise
//   floor is what a right model would leave on what was fitted.
// Units: noise units a row. Failure: what could not be had is left as it is (NaN).
#pragma once

#include "diagnose/study_diagnosis.h"

namespace bondlab::diagnose {

// `rows`: the model's at the fits before and after, all series of `evidence`.
void measure_gaps(Prober &model, const Evidence &evidence, const std::vector<Eigen::VectorXd> &rows,
                  StudyDiagnosis &out, std::uint64_t seed);

}  // namespace bondlab::diagnose
