// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: quantities of a three-point bending test, plain or single-edge notched: flexural strength,
//   flexural modulus with and without shear, fracture toughness.
// Method. With F the peak load, S the span, d the depth (or diameter), b the breadth:
//     strength   3 F S/(2 b d^2) (rectangle), 8 F S/(pi d^3) (round bar): beam theory; on a notched
//                beam it is the nominal stress of the whole section;
//     modulus    K S^3/(48 I), with K the slope of load over deflection between 40 and 60 % of the
//                peak; the deflection is that of the middle line against the supports, so the
//                rollers' indentation is not in it. Short spans are shear as well (PHYSICS: factor 2
//                at S/d = 1.5), so the corrected one is
//                E = K (S^3/(48 I) + S 2(1+nu)/(4 kappa A)),  kappa after Cowper 1966:
//                10(1+nu)/(12+11nu) rectangle, 6(1+nu)/(7+6nu) circle, nu from the deck;
//     K_IC       rectangle, S/W = 4 (ASTM E399): F S/(B W^1.5) f(a/W),
//                f = 3 sqrt(x) [1.99 - x(1-x)(2.15 - 3.93x + 2.7x^2)]/(2 (1+2x)(1-x)^1.5);
//                round bar, S/D = 3.33 (SENRBB, Ouchterlony 1980): .25 (S/D) Y' F/D^1.5,
//                Y' = 12.7527 x^.5 (1 + 19.646 x^4.5)^.5/(1-x)^.25.
//   The section is that of the specimen: 2D a rectangle height x thickness; 3D a round bar, or a
//   prism height x width if the deck's `length` is above 0.
// Columns read: time, force_top, force_bottom (N), deflection (m), kinetic_energy, strain_energy.
// Deck variables: dim, span, height or diameter, thickness or width, length, notch_depth, poisson.
// Units: SI. Failure: ResponseError, see response.h; implausible for K_IC where S/W is off by more
//   than 10 % or the notch is outside 0.2 to 0.8 of the depth.
// Limits: a particle model's notch is at least a grain wide: K_IC is then too high (R/a < .05 asked).
#pragma once

#include "response/response.h"

namespace bondlab::bending {

double flexural_strength(const Curve &curve, const ResponseContext &context);  ///< Pa
double flexural_modulus(const Curve &curve, const ResponseContext &context);   ///< Pa, with shear
double flexural_modulus_slender(const Curve &curve, const ResponseContext &context);  ///< Pa
double toughness(const Curve &curve, const ResponseContext &context);  ///< Pa sqrt(m)
/// Quality: largest difference of load and reaction, and largest kinetic over strain energy,
/// between 40 and 60 % of the peak.
double platen_imbalance(const Curve &curve, const ResponseContext &context);
double kinetic_share(const Curve &curve, const ResponseContext &context);

/// Shape functions, for tests: K sqrt factors of a/W.
double e399_shape(double x);
double senrbb_shape(double x);

}  // namespace bondlab::bending
