// SPDX-License-Identifier: GPL-2.0-or-later
#include "rheology/material.h"

#include <cassert>

namespace bondlab::rheology {

namespace {

double Material::*const members[base_count] = {&Material::E,           &Material::nu,
                                               &Material::cohesion,    &Material::tension,
                                               &Material::brittleness, &Material::microcracks};

const std::string base_names[base_count] = {"E",       "nu",          "cohesion",
                                            "tension", "brittleness", "microcracks"};

const std::string effect_names[effect_count] = {"norton_creep",
                                                "arrhenius",
                                                "weibull",
                                                "missing_bonds",
                                                "platen_seating",
                                                "residual_friction",
                                                "frame_compliance",
                                                "end_parallelism",
                                                "tilt",
                                                "platen_friction",
                                                "tension_compression",
                                                "pressure_dependence",
                                                "yielding",
                                                "softening",
                                                "inertia",
                                                "rolling_resistance",
                                                "brazilian_conversion",
                                                "shear_conversion",
                                                "anisotropy",
                                                "temperature_drift",
                                                "load_cell_saturation",
                                                "kinematic_hardening",
                                                "moisture_drift",
                                                "gauge_drift",
                                                "porosity_gradient",
                                                "dilatancy"};

}  // namespace

double &base(Material &material, std::size_t index) {
  assert(index < base_count);
  return material.*members[index];
}

double base(const Material &material, std::size_t index) {
  assert(index < base_count);
  return material.*members[index];
}

const std::string &base_name(std::size_t index) {
  assert(index < base_count);
  return base_names[index];
}

const std::string &effect_name(std::size_t effect) {
  assert(effect < effect_count);
  return effect_names[effect];
}

}  // namespace bondlab::rheology
