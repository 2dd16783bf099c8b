// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: quantities of a direct shear test: peak and residual strength, dilation.
// Method: shear stress is the mean of both boxes' forces over the first area (the loss of area with
//   the displacement, u/W, is below the tests' few per cent and not taken out). The residual strength
//   is the mean over the last fifth of the shear displacement, behind the peak. Dilation is the
//   largest rise of the lid from where it stood when shearing began. Friction angle and cohesion
//   follow from peaks at three normal stresses or more, by a study.
// Columns read: time, displacement (m), shear_stress (Pa), lift (m), force_top, force_bottom (N),
//   kinetic_energy, strain_energy (J).
// Units: SI. Failure: ResponseError; test_not_finished when the stress never fell behind its peak.
// Limits: a ductile test without a peak gives none of the strengths.
#pragma once

#include "response/response.h"

namespace bondlab::shear {

double peak_strength(const Curve &curve, const ResponseContext &context);      ///< Pa
double residual_strength(const Curve &curve, const ResponseContext &context);  ///< Pa
double dilation(const Curve &curve, const ResponseContext &context);           ///< m
/// Quality: largest difference of the two halves' shear forces, and largest kinetic over strain
/// energy, between 40 and 60 % of the peak.
double platen_imbalance(const Curve &curve, const ResponseContext &context);
double kinetic_share(const Curve &curve, const ResponseContext &context);

}  // namespace bondlab::shear
