// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: small requests and packings for the tests of this folder; for tests only.
// Units: SI. Failure: none.
#pragma once

#include <vector>

#include "base/random.h"
#include "specimen/specimen.h"

namespace bondlab {

inline SpecimenRequest small_rectangle() {  // 299 discs
  SpecimenRequest request;
  request.shape = ContainerShape::rectangle;
  request.width = 0.025;
  request.height = 0.05;
  request.r_min = 0.78e-3;
  return request;
}

inline SpecimenRequest small_disc() {  // 299 discs
  SpecimenRequest request;
  request.shape = ContainerShape::disc;
  request.diameter = 0.025;
  request.r_min = 0.49e-3;
  return request;
}

inline SpecimenRequest small_cylinder() {  // 506 spheres
  SpecimenRequest request;
  request.shape = ContainerShape::cylinder;
  request.diameter = 0.01;
  request.height = 0.02;
  request.r_min = 0.56e-3;
  return request;
}

inline SpecimenRequest notched_beam() {  // 3D
  SpecimenRequest request;
  request.shape = ContainerShape::prism;
  request.width = 0.008;
  request.height = 0.01;
  request.length = 0.03;
  request.notch_depth = 0.003;
  request.notch_width = 0.001;
  request.r_min = 0.5e-3;
  return request;
}

// Particles at random places of a box with the given sides (z = 0 when the third is 0),
// overlapping.
inline std::vector<Particle> random_particles(std::size_t count, double x, double y, double z,
                                              double r_min, double r_max, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Particle> particles(count);
  for (Particle &p : particles) {
    p.x = random.uniform(0, x);
    p.y = random.uniform(0, y);
    p.z = z > 0 ? random.uniform(0, z) : 0;
    p.r = random.uniform(r_min, r_max);
  }
  return particles;
}

}  // namespace bondlab
