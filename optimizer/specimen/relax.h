// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: bring a set of overlapping discs or spheres in a rigid container to static equilibrium
//   without friction.
// Method: minimise the energy of linear contacts, sum of k delta^2 / 2 over particle and wall
//   overlaps, by FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006, with the half step back
//   of Guenole et al., Comput. Mater. Sci. 175, 109584, 2020).
// Why FIRE: it needs one force evaluation a step and no matrix, copes with contacts that open and
//   close, and has no tuning that depends on the packing. The stiffness k is that of the bond
//   styles' grain contact up to a factor, 2 t E_c in 2D and 4 R E_c in 3D, so that the packing is
//   in equilibrium for them too.
// Units: lengths in mean radii; particle mass 1; k at most 1.
// Failure: none; relax() returns how far it came.
// Limits: one thread, and a fixed order of every sum, so that the result is the same on every
//   machine as long as the compiler doesn't contract a*b + c into one rounding (the optimiser is
//   built for the plain processor, which has no such instruction).
#pragma once

#include <cstddef>
#include <vector>

#include "specimen/container.h"
#include "specimen/neighbours.h"

namespace bondlab {

// Stiffness of a wall contact over that of two particles of the same radius. A particle against a
// rigid wall deforms only itself (2); twice that again keeps what sticks out of the container
// small.
constexpr double wall_contact_stiffness = 4;

struct Equilibrium {
  int steps = 0;
  double residual = 0;  // rms net force on a particle over the mean contact force
  double overlap =
      0;  // sum of overlaps / (dimension * particles): the mean overlap of an isostatic packing
  std::size_t contacts = 0;
};

class Relaxation {
 public:
  // Keeps references: `particles` may be changed between calls of relax().
  Relaxation(const Container &container, std::vector<Particle> &particles);

  // Stops when residual <= tolerance, or when the overlap has fallen below `loose` (not jammed), or
  // after max_steps.
  Equilibrium relax(double tolerance, double loose, int max_steps);

 private:
  struct Vec4 {
    double x = 0, y = 0, z = 0, pad = 0;
  };
  void build_list();
  double list_reach() const;
  void forces();

  const Container &container_;
  std::vector<Particle> &particles_;
  std::vector<Particle> built_;  // as they were when the list was made
  std::vector<Vec4> force_, velocity_;
  PairList pairs_;
  double stiffness_constant_ = 1,
         stiffness_slope_ = 0;  // k = constant + slope * (sum of the two radii)
  double overlap_sum_ = 0, force_sum_ = 0;
  std::size_t contacts_ = 0;
};

}  // namespace bondlab
