// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how far the fitted parameters and amplitudes of a refit may be off.
// Method: parametric bootstrap. Data sets are drawn as study_null() draws them, each whitened with
// a
//   covariance estimated anew from itself, and the fit's columns are solved for each as the refit
//   does. What the drawn fits scatter holds what the usual (J'J)^-1 does not: that the covariance
//   comes from a score of samples, and that the model does not know its own rows. The covariance
//   of the refit is widened by it, row and column, never narrowed.
// Source: Efron & Tibshirani, An Introduction to the Bootstrap (1993), ch. 6 and 9.
// Units: z and amplitudes. Failure: none. Limits: to first order about the fit.
#pragma once

#include "diagnose/refit.h"
#include "diagnose/study_null.h"

namespace bondlab::diagnose {

// `null` is that of the fit's own point: its doubt, and as jacobian the fit's columns, not
// whitened.
void widen_covariance(Refit &fit, NullModel null, std::uint64_t seed);

}  // namespace bondlab::diagnose
