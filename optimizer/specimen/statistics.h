// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the figures by which a packing is judged: density, coordination, overlaps, isotropy,
//   floaters, loose parts.
// Method: porosity by counting points of a regular grid in the part of the container more than
//   one largest diameter from its walls (the wall layer is looser), and from the sum of areas or
//   volumes in the whole; fabric tensor <n n> of the bonds in that inner part; stress from
//   contact forces of the stiffness of the bond styles' grain contact, 2 t E_c in 2D and 4 R E_c
//   in 3D (R the mean of the two radii), and the forces of the walls.
// Units: SI; ratios where it says so. "Mean radius" is that of the packing.
// Failure: none; a packing without contacts has ratios 0. Overlapping area is counted once
//   inside, twice in the whole.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "specimen/container.h"

namespace bondlab {

// Gaps at which coordination is counted, over the mean radius. The first stands for contact.
constexpr std::array<double, 6> coordination_gaps = {1e-6, 1e-3, 1e-2, 5e-2, 1e-1, 1.5e-1};
// The one of them at which bonds are usually installed; fabric and loose parts are judged there.
constexpr std::size_t bond_gap_index = 3;
constexpr double bond_gap = coordination_gaps[bond_gap_index];

struct SpecimenStatistics {
  std::size_t count = 0;
  double r_min = 0, r_max = 0, r_mean = 0;  // m, as packed
  double porosity = 0;                      // whole container; area in 2D
  double porosity_inner =
      0;  // more than one largest diameter from the walls; 0 if there is no such part
  std::array<double, coordination_gaps.size()>
      coordination{};                        // mean number of bonds of a particle
  int fewest_bonds = 0;                      // of any particle at bond_gap
  int clusters = 0;                          // connected parts at bond_gap; 1 is whole
  double mean_overlap = 0, max_overlap = 0;  // of contacts, over the smaller radius
  double stick_out = 0;     // largest overlap with a wall over the particle's radius
  double fabric_ratio = 0;  // largest over smallest eigenvalue of the fabric tensor; 1 is isotropic
  double stress_ratio = 0;  // the same of the locked-in stress
  double stress_over_modulus = 0;  // mean locked-in stress / E_c
  int floaters = 0;                // held by fewer than 3 (2D) or 4 (3D) contacts, walls included
  int floaters_grown = 0;  // how many were made to fill their hole; known to the generator only
  double size_factor = 1;  // radii as packed / as asked for; known to the generator only
  int on_bottom = 0, on_top = 0;  // particles that touch the flat ends (rectangle, cylinder)
};

SpecimenStatistics measure_packing(const Container &container,
                                   const std::vector<Particle> &particles);

}  // namespace bondlab
