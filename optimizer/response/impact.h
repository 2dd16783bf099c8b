// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: quantities of an impact test: peak force, energy the specimen took from the ball, share of
//   broken bonds, largest fragment, mass passing a sieve.
// Method: the ball's kinetic energy at the first sample less that at the last; it includes what the
//   fragments carry off and what still swings. The contact is elastic and nothing is damped, so an
//   unbroken specimen gives nearly all of it back. The share of broken bonds is broken over broken
//   and intact; fragments are those of compute fragments in the last sample.
// Columns read: time, force_top (N), ball_energy (J), broken_bonds, intact_bonds, largest_share,
//   passing_share.
// Units: SI. Failure: ResponseError; test_not_finished while the ball still presses (more than 1 %
//   of the peak) at the end, or before it has reached a peak.
// Limits: fragments that only touch count as separate.
#pragma once

#include "response/response.h"

namespace bondlab::impact {

double peak_force(const Curve &curve, const ResponseContext &context);       ///< N
double contact_time(const Curve &curve, const ResponseContext &context);     ///< s, above 1 % of it
double absorbed_energy(const Curve &curve, const ResponseContext &context);  ///< J
double broken_share(const Curve &curve, const ResponseContext &context);
double largest_share(const Curve &curve, const ResponseContext &context);
double passing_share(const Curve &curve, const ResponseContext &context);

}  // namespace bondlab::impact
