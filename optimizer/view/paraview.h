// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a run as two files for ParaView: particles.vtp (points) and bonds.vtp (lines).
// Method: particles at the end of the run with id, radius, diameter, displacement, bonds lost and
//   fragment; bonds between the same points with state, mode, time of breaking and, where they were
//   dumped, forces; of frames that have it the stress of each particle as a 3 x 3 tensor. Glyphs: Sphere, Scale Array diameter (ParaView's sphere has the diameter 1).
// Units: SI; in the arrays' names where they aren't plain: break_time_s, normal_force_N.
// Failure: none. Limits: the state that the run is given in (its end, or a frame: frames.h); -1 where there is nothing to say (the fragment when
// the
//   bonds aren't known, the time of a bond that holds).
#pragma once

#include "base/vtp_file.h"
#include "view/run_data.h"

namespace bondlab {

VtpData particle_data(const RunView &run);
VtpData bond_data(const RunView &run);  // without lines when there are no bonds

}  // namespace bondlab
