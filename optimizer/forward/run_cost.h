// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: say how long a forward run takes before it is started.
// Method: the mean of the finished runs of the same workload where the store knows some; else an
// estimate from the number
//   of particles and of time steps. Steps: the closing at which the specimen should fail, over the
//   platen speed, over the stable time step of a grain on its stiffest contacts; the cost of a
//   particle and step is a measured constant.
// Units: seconds. Failure: no figure (nullopt) when the deck hasn't the variables the estimate
// needs. Limits: the estimate is good to a factor of about 3: the strain at failure isn't known
// before the run. It is shown as an
//   estimate, and the first run replaces it.
#pragma once

#include <optional>

#include "forward/run_plan.h"
#include "forward/run_store.h"

namespace bondlab {

struct RunCost {
  double seconds = 0;
  bool measured = false;
};

// `store` may be null.
std::optional<RunCost> run_cost(const RunPlan &plan, const RunStore *store);

// Particles that a packing of this specimen will have, to some per cent.
double expected_particles(const SpecimenEntry &specimen);

}  // namespace bondlab
