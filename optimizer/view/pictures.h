// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what each picture of a run shows: which colour a particle has, which lines are drawn, what
//   the words say.
// Method: a picture is a function from a RunView and a Projection to a Drawing; drawing.h lays it
//   out. A crack is a line across its bond, as long as the bond was wide (twice the smaller
//   radius), between its two particles while they are near (less than 1.5 times the sum of their
//   radii apart), else at the place of breaking. Scales end at the 98th percentile, so that one
//   particle that has flown off doesn't take the colours of all others.
// Units: SI in; mm, um, kN and so on in the words.
// Failure: none; a picture without its data has no discs and is not drawn.
#pragma once

#include "view/drawing.h"
#include "view/projection.h"
#include "view/run_data.h"

namespace bondlab {

Drawing specimen_picture(const RunView &run, const Projection &projection);  // sizes, at the start
Drawing cracks_by_mode(const RunView &run, const Projection &projection);
Drawing cracks_by_time(const RunView &run, const Projection &projection);
Drawing force_chains(const RunView &run, const Projection &projection);
Drawing displacements(const RunView &run, const Projection &projection);
Drawing fragments_picture(const RunView &run, const Projection &projection);

}  // namespace bondlab
