// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/run_cost.h"

#include <algorithm>
#include <cmath>

#include "study/specimen_request.h"

namespace bondlab {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSolidDisc = 0.85,
                 kSolidSphere = 0.62;  // solid shares of dense packings of mixed sizes
constexpr double kFailureStrain =
    0.004;  // closing over length until the load has fallen: 0.0034 in the granite study
constexpr double kSecondsPerParticleStep =
    50e-9;                             // 41 to 47 ns measured in 2D with AVX-512, one rank
constexpr double kStartSeconds = 0.5;  // mpirun, reading, installing bonds

}  // namespace

double expected_particles(const SpecimenEntry &s) {
  const double space = Container(s.shape, s.size).measure();
  const int dimension = is_flat(s.shape) ? 2 : 3;
  const auto sizes = size_distribution(specimen_request(s, 0).size_settings(), dimension);
  if (dimension == 2) return kSolidDisc * space / (kPi * sizes->moment(2));
  return kSolidSphere * space / (4.0 / 3 * kPi * sizes->moment(3));
}

std::optional<RunCost> run_cost(const RunPlan &plan, const RunStore *store) {
  if (store)
    if (const auto seconds = store->mean_seconds(workload_of(plan))) return RunCost{*seconds, true};
  const auto value = [&](const char *name) {
    const auto found = plan.numeric.find(name);
    return found == plan.numeric.end() ? 0 : found->second;
  };
  const double speed = value("platen_speed"), modulus = std::max(value("E_c"), value("E_b"));
  const double density = value("density") > 0 ? value("density") : plan.specimen.density;
  if (speed <= 0 || modulus <= 0) return std::nullopt;
  const SpecimenEntry &s = plan.specimen;
  const bool upright =
      s.shape == SpecimenShape::rectangle || s.shape == SpecimenShape::cylinder;
  const double length = upright                             ? s.size.height
                        : s.shape == SpecimenShape::prism ? s.size.length
                                                            : s.size.diameter;
  // A disc of mass pi r^2 t rho among six contacts of stiffness 2 t E, grain and bond each: omega^2
  // = 2 * 6 * 4 t E / m, and a step of 2 / omega. The sphere's figures differ by less than the rest
  // of the estimate.
  const double step = 2 * s.r_min * std::sqrt(kPi * density / (48 * modulus)) *
                      (value("safety") > 0 ? value("safety") : 1);
  const double steps = kFailureStrain * length / speed / step;
  return RunCost{
      kStartSeconds + steps * expected_particles(s) * kSecondsPerParticleStep / plan.ranks, false};
}

}  // namespace bondlab
