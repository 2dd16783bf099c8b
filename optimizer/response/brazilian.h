// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: splitting tensile strength of a Brazilian test: sigma_t = 2 P / (pi D t) at the peak load P.
// Method: the formula is that of ISRM 1978 and ASTM D3967 for flat platens. P is the mean of the two
//   platens' forces, which halves the part of a platen wave that the two see with opposite sign.
// Columns read: time, force_top, force_bottom (N, compression +). Deck variables: diameter,
//   thickness (m); in 2D the thickness is the deck's disc thickness.
// Units: SI. Failure: ResponseError, see response.h.
// Limits: the formula holds for a crack that starts at the centre: first_cracks() says where they did.
#pragma once

#include "response/response.h"

namespace bondlab::brazilian {

double tensile_strength(const Curve &curve, const ResponseContext &context);  ///< Pa
/// Quality: largest difference of the platens' forces between 40 and 60 % of the peak, as a share
/// of their mean.
double platen_imbalance(const Curve &curve, const ResponseContext &context);
/// Quality: largest kinetic over strain energy there.
double kinetic_share(const Curve &curve, const ResponseContext &context);

/// Quality: how far from the centre the first cracks are, as a share of the radius: the mean of the
/// first tenth of the bonds broken up to the peak, five at least (all, where there are fewer). Cracks
/// spread evenly over the disc give 2/3; cracks at the platens 1.
double first_cracks(const Curve &curve, const std::vector<BrokenBond> &events,
                    const ResponseContext &context);

}  // namespace bondlab::brazilian
