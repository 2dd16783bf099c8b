// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: quantities of a uniaxial compression test: strength, tangent modulus (gauge and platens),
//   Poisson's ratio.
// Method: E is the tangent by linear regression of axial stress on axial strain over the part of
//   the loading branch between 40 and 60 % of the peak, and nu the slope of lateral on axial strain
//   over the same part (ISRM 1979; ASTM D7012, tangent at half of the strength). A regression
//   instead of a two-point secant because the stress of a discrete specimen carries the noise of
//   single cracks and platen waves. Stress is engineering stress (force over the first area).
//   A material that flows has no peak with a fall behind it: strength_within_strain is the greatest
//   stress up to the strain at which the test was to end.
// Columns read: time, axial_stress (Pa, compression +), strain_axial (gauge, compression +),
//   strain_lateral (expansion +), strain_platen, strain_machine (with the frame's compliance);
//   force_top and force_bottom (N) for quality only; kinetic_energy, strain_energy (J),
//   intact_bonds, broken_bonds.
// Units: SI. Failure: ResponseError, see response.h.
// Limits: nu is a plane value in 2D (it may pass 0.5); the window assumes that the loading branch
//   is nearly straight there, which cracking before 60 % of the peak would spoil.
#pragma once

#include "response/response.h"

namespace bondlab::uniaxial {

double peak_stress(const Curve &curve, const ResponseContext &context);  ///< Pa
/// Pa; the greatest, where the load fell or the machine reached the deck's max_strain
double strength_within_strain(const Curve &curve, const ResponseContext &context);
double peak_strain(const Curve &curve,
                   const ResponseContext &context);  ///< gauge axial strain at the peak
double peak_strain_platen(const Curve &curve, const ResponseContext &context);  ///< the same, by the platens
double tangent_modulus_gauge(const Curve &curve, const ResponseContext &context);   ///< Pa
double tangent_modulus_platen(const Curve &curve, const ResponseContext &context);  ///< Pa
double tangent_modulus_machine(const Curve &curve,
                               const ResponseContext &context);  ///< by the machine's drive, Pa
double poisson_gauge(const Curve &curve, const ResponseContext &context);
double bonds(const Curve &curve, const ResponseContext &context);  ///< at the start, number
double greatest_strain_energy(const Curve &curve, const ResponseContext &context);   ///< J
double greatest_kinetic_energy(const Curve &curve, const ResponseContext &context);  ///< J
/// Quality: largest difference of the two platens' forces in the regression window, as a share of
/// their mean.
double platen_imbalance(const Curve &curve, const ResponseContext &context);
/// Quality: largest kinetic over strain energy in the regression window.
double kinetic_share(const Curve &curve, const ResponseContext &context);

}  // namespace bondlab::uniaxial
