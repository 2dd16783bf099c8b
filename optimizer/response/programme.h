// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what the phases of a loading programme (fix drive) tell of a material: the modulus of an
//   unloading, how far a stress relaxes at a held displacement, how fast a held load creeps.
// Method: the column `phase` says what the drive was doing (2 holding, 3 keeping a load, 4
//   unloading); the first stretch of a phase is taken. The unloading modulus is the slope of stress
//   on gauge strain over the middle of the unloading's stresses (20 to 80 % of its range), away
//   from the turns. The creep rate is the slope of gauge strain in time over the last third of the
//   stretch (the transient is over, as far as it can be), a straight line fitted in the linear
//   domain: rates of either sign may come out.
// Columns read: time, phase, axial_stress (Pa), strain_axial (gauge); for the quality figures
//   force_top, force_bottom (N), kinetic_energy, strain_energy (J).
// Units: SI. Failure: ResponseError; test_not_finished when the phase never came.
// Limits: one stretch per run; a hold that begins while cracks run shows them as relaxation.
#pragma once

#include "response/response.h"

namespace bondlab::programme {

double unloading_modulus(const Curve &curve, const ResponseContext &context);  ///< Pa
double relaxed_share(const Curve &curve, const ResponseContext &context);  ///< 1 - last/first stress
double creep_rate(const Curve &curve, const ResponseContext &context);     ///< 1/s
/// Quality: largest difference of the two platens' forces in the last third of the kept load, or of
/// the hold where no load is kept, as a share of their mean.
double hold_platen_imbalance(const Curve &curve, const ResponseContext &context);
/// Quality: largest kinetic over strain energy there.
double hold_kinetic_share(const Curve &curve, const ResponseContext &context);

}  // namespace bondlab::programme
