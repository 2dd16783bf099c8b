// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: quantities of a direct shear test: peak and residual strength, dilation.
// Method: shear stress is the mean of both boxes' forces over the first area (the loss of area with
//   the displacement, u/W, is below the tests' few per cent and not taken out). The residual
//   strength is the mean over the last fifth of the shear displacement, behind the peak. Dilation
//   is the largest rise of the lid from where it stood when shearing began. Friction angle and
//   cohesion follow from tests at three normal stresses or more (envelope.h).
// Columns read: time, displacement (m), shear_stress, normal_stress (Pa), lift (m), force_top,
//   force_bottom (N), kinetic_energy, strain_energy (J).
// Units: SI. Failure: ResponseError; test_not_finished when the stress never fell behind its peak.
// Limits: a ductile test without a peak gives none of the strengths but strength_within_shear.
#pragma once

#include "response/response.h"

namespace bondlab::shear {

double peak_strength(const Curve &curve, const ResponseContext &context);  ///< Pa
/// Pa; greatest stress up to max_shear of the width, of a specimen that breaks or flows.
double strength_within_shear(const Curve &curve, const ResponseContext &context);
double residual_strength(const Curve &curve, const ResponseContext &context);  ///< Pa
/// Pa; what the servo really held: at the peak, and over the same last fifth as the residual
/// strength.
double normal_stress_at_peak(const Curve &curve, const ResponseContext &context);
double normal_stress_at_residual(const Curve &curve, const ResponseContext &context);
double dilation(const Curve &curve, const ResponseContext &context);  ///< m
/// Quality: largest difference of the two halves' shear forces, and largest kinetic over strain
/// energy, between 40 and 60 % of the peak.
double platen_imbalance(const Curve &curve, const ResponseContext &context);
double kinetic_share(const Curve &curve, const ResponseContext &context);

}  // namespace bondlab::shear
