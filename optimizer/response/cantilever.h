// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: quantities of a cantilever test: compliance, modulus with and without shear, strength.
// Method. Arm L from the clamp's face to the load, deflection delta of the middle line at the load:
//     compliance  slope of delta over F between 40 and 60 % of the peak;
//     modulus     E = (1/c) (L^3/(3 I) + L 2(1+nu)/(kappa A)), Timoshenko with Cowper's kappa (see
//                 bending.h); slender: without the second term;
//     strength    F L (d/2)/I at the peak.
// Columns read: time, force_top (N), deflection (m), and those of the quality figures.
// Deck variables: dim, arm, height or diameter, thickness, poisson.
// Units: SI. Failure: ResponseError. Limits: the clamp holds grains, so the true root lies within a
//   grain of its face: L is uncertain by about R.
#pragma once

#include "response/response.h"

namespace bondlab::cantilever {

double compliance(const Curve &curve, const ResponseContext &context);       ///< m/N
double modulus(const Curve &curve, const ResponseContext &context);          ///< Pa
double modulus_slender(const Curve &curve, const ResponseContext &context);  ///< Pa
double strength(const Curve &curve, const ResponseContext &context);         ///< Pa
double platen_imbalance(const Curve &curve, const ResponseContext &context);
double kinetic_share(const Curve &curve, const ResponseContext &context);

}  // namespace bondlab::cantilever
