// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what the closed-form laboratory's rock is made of: base parameters, and the size of every
//   effect that a model may lack.
// Method: an effect is one number that is 0 when the effect is absent, so that a model with effects
//   switched on is the same function of one longer vector. Some effects have a shape besides their
//   size (Norton's exponent); it stands at its usual value unless told otherwise.
// Why unlisted effects as well: a diagnosis must be tested on causes that its catalogue lacks.
// Units: SI; where an effect is a share, 1.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace bondlab::rheology {

struct Material {
  double E = 40e9;           // Pa
  double nu = 0.25;          // 1
  double cohesion = 40e6;    // Pa; shear strength without normal stress
  double tension = 8e6;      // Pa; tensile strength
  double brittleness = 1.5;  // 1; how fast the load falls after the peak
  double microcracks = 0.3;  // 1; share of the peak strain that precedes the peak as curvature
};
constexpr std::size_t base_count = 6;
double &base(Material &material, std::size_t index);
double base(const Material &material, std::size_t index);
const std::string &base_name(std::size_t index);

enum Effect : std::size_t {
  // in the catalogue
  norton_creep,          // strain rate at 50 MPa and 293 K, 1/s (shape: exponent m)
  arrhenius,             // activation energy of strength and a third of it of E, J/mol
  weibull,               // 1/k of bond strength
  missing_bonds,         // share of bonds
  platen_seating,        // Hertz closure at the platens at 10 MPa, over the length
  residual_friction,     // friction after break beyond the base's 0.4
  frame_compliance,      // 1/K_f, m/N
  end_parallelism,       // out-of-parallel at the ends, rad
  tilt,                  // of the specimen's axis, rad
  platen_friction,       // friction coefficient at the platens
  tension_compression,   // 1 - E_t/E_c
  pressure_dependence,   // tan(phi) of the bonds
  yielding,              // plastic share of the strain at the peak
  softening,             // share by which breaking is spread out
  inertia,               // rise of strength at 0.1/s, with rate^(2/3)
  rolling_resistance,    // of loose grains
  brazilian_conversion,  // error of the Brazilian stress formula, share
  shear_conversion,      // error of the direct-shear area, share
  // not in the catalogue
  anisotropy,            // weakness across the axis, share
  temperature_drift,     // softening in slow tests, share
  load_cell_saturation,  // share of the load above 80 MPa that is not shown
  kinematic_hardening,   // unloading softer than loading, share
  moisture_drift,        // loss of stiffness and strength over the order of tests, share
  gauge_drift,           // strain gauges read more when hot, share
  porosity_gradient,     // large specimens softer and weaker, share
  dilatancy,             // Poisson's ratio rises before the peak
  effect_count
};
constexpr std::size_t catalogue_count = anisotropy;
const std::string &effect_name(std::size_t effect);

struct Effects {
  std::array<double, effect_count> size{};
  double norton_exponent = 3;
  double operator[](Effect effect) const { return size[effect]; }
};

}  // namespace bondlab::rheology
