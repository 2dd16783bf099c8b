// SPDX-License-Identifier: GPL-2.0-or-later
#include "rheology/laboratory.h"

#include <algorithm>
#include <cmath>

namespace bondlab::rheology {

namespace {

constexpr double room = 293;             // K
constexpr double gas = 8.314;            // J/(mol K)
constexpr double creep_stress = 50e6;    // Pa; where norton_creep is counted
constexpr double creep_energy = 60e3;    // J/mol; of the creep rate
constexpr double closure_stress = 8e6;   // Pa; at which open cracks have closed by 63 %
constexpr double closure_strain = 1e-3;  // of a rock of nothing but cracks
constexpr double base_friction = 0.4;

std::vector<Series> make_series() {
  std::vector<Series> list;
  const auto add = [&](Series series) {
    series.order = static_cast<int>(list.size());
    list.push_back(std::move(series));
  };
  const std::string uc = "uniaxial_compression";
  add({"uc_slow_293K", uc, Kind::compression, 1e-5, 293});
  add({"uc_mid_293K", uc, Kind::compression, 1e-3, 293});
  add({"uc_fast_293K", uc, Kind::compression, 1e-1, 293});
  add({"uc_slow_343K", uc, Kind::compression, 1e-5, 343});
  add({"uc_mid_343K", uc, Kind::compression, 1e-3, 343});
  add({"uc_fast_343K", uc, Kind::compression, 1e-1, 343});
  add({"uc_short", uc, Kind::compression, 1e-3, 293, 0, 1});
  add({"uc_large", uc, Kind::compression, 1e-3, 293, 0, 2, 2});
  add({"bd_small", "brazilian", Kind::brazilian, 1e-3, 293, 0, 0.5, 1});
  add({"bd_large", "brazilian", Kind::brazilian, 1e-3, 293, 0, 0.5, 2});
  add({"tpb_small", "three_point_bending", Kind::bending, 1e-3, 293, 0, 4, 1});
  add({"tpb_large", "three_point_bending", Kind::bending, 1e-3, 293, 0, 4, 2});
  add({"ds_low", "direct_shear", Kind::shear, 1e-3, 293, 2e6});
  add({"ds_mid", "direct_shear", Kind::shear, 1e-3, 293, 8e6});
  add({"ds_high", "direct_shear", Kind::shear, 1e-3, 293, 20e6});
  add({"dt_mid", "direct_tension", Kind::tension, 1e-3, 293});
  add({"dt_slow", "direct_tension", Kind::tension, 1e-5, 293});
  return list;
}

// Stressed volume over that of the standard compression specimen: for Weibull's size effect.
double stressed_volume(const Series &s) {
  const double cube = s.size * s.size * s.size;
  switch (s.kind) {
    case Kind::compression:
      return cube * s.slenderness / 2;
    case Kind::brazilian:
      return 0.1 * cube;
    case Kind::bending:
      return 0.02 * cube;
    case Kind::shear:
      return 0.2 * cube;
    case Kind::tension:
      return 0.6 * cube;
  }
  return 1;
}

// Strain at the platens for 1 Pa and a frame of 1 m/N: A / L.
double frame_lever(const Series &s) {
  constexpr double diameter = 0.05;
  switch (s.kind) {
    case Kind::compression:
      return 0.785 * diameter * s.size / s.slenderness;
    case Kind::brazilian:
      return 1.57 * diameter * 0.5 * s.size;
    case Kind::bending:
      return 0.02 * diameter * s.size;
    case Kind::shear:
      return 0.8 * diameter * s.size;
    case Kind::tension:
      return 0.785 * diameter * s.size / 2;
  }
  return 0;
}

bool has_platens(Kind kind) { return kind != Kind::shear && kind != Kind::tension; }

// exp(-x) without the cost where nothing is asked.
double thermal_factor(double energy, double temperature) {
  if (energy == 0 || temperature == room) return 1;
  return std::exp(energy / gas * (1 / temperature - 1 / room));
}

struct State {  // what the condition makes of the material
  double E, peak, residual, fall, micro, nu;
};

double peak_stress(const Series &s, const Material &m, const Effects &e) {
  const double t = e[pressure_dependence];
  switch (s.kind) {
    case Kind::compression:
      return 2 * m.cohesion * (std::sqrt(1 + t * t) + t);
    case Kind::brazilian:
      return m.tension * 1.05;
    case Kind::bending:
      return m.tension * 1.6;
    case Kind::shear:
      return m.cohesion + s.normal_stress * (t + 0.25 * e[residual_friction]);
    case Kind::tension:
      return m.tension;
  }
  return 0;
}

double residual_stress(const Series &s, double peak, const Effects &e) {
  const double friction = base_friction + e[residual_friction];
  switch (s.kind) {
    case Kind::compression:
      return 0.1 * peak + 12e6 * e[residual_friction] + 9e6 * e[rolling_resistance];
    case Kind::shear:
      return friction * s.normal_stress + e[rolling_resistance] * std::sqrt(s.normal_stress * 3e6);
    case Kind::bending:
      return 0.03 * peak + 0.25 * e[softening] * peak;
    case Kind::tension:
      return 0.01 * peak + 0.15 * e[softening] * peak;
    case Kind::brazilian:
      return 0.15 * peak;
  }
  return 0;
}

State state_of(const Series &s, const Material &m, const Effects &e, const Specimen &specimen) {
  State state;
  const bool compression = s.kind == Kind::compression;
  const double heat = thermal_factor(e[arrhenius], s.temperature);
  double E = m.E * specimen.stiffness, P = specimen.strength * peak_stress(s, m, e);
  // E of the test, relative to compression
  const double q = e[tension_compression];
  switch (s.kind) {
    case Kind::compression:
      break;
    case Kind::brazilian:
      E *= 0.8 * (1 - 0.25 * q);
      break;
    case Kind::bending: {
      const double root = std::sqrt(1 - q);
      E *= 4 * (1 - q) / ((1 + root) * (1 + root));
      break;
    }
    case Kind::shear:
      E *= 0.5 / (1 + m.nu);
      break;
    case Kind::tension:
      E *= 1 - q;
      break;
  }
  // stiffness
  E *= std::cbrt(heat) * (1 - (compression ? 1.5 : 1.0) * e[missing_bonds]);
  if (s.kind == Kind::tension || s.kind == Kind::bending) E *= 1 - 1.2 * e[missing_bonds];
  if (compression) E *= 1 + 0.1 * e[platen_friction] / s.slenderness;
  // strength
  P *= heat * (1 - 1.2 * e[missing_bonds]);
  const double w = e[weibull];
  if (w != 0) P *= std::pow(stressed_volume(s), -w) * (1 - 0.6 * w);
  if (e[inertia] != 0) P *= 1 + e[inertia] * std::pow(s.rate / 0.1, 2.0 / 3);
  if (compression) {
    P *= 1 + 0.6 * e[platen_friction] / s.slenderness;
    P *= 1 - 12 * e[end_parallelism];
    P *= 1 - 4 * e[tilt];
  }
  if (s.kind == Kind::bending) P *= 1 + e[softening] * (0.5 / s.size);
  if (s.kind == Kind::brazilian) P *= 1 + 0.1 * e[softening];
  if (e[norton_creep] > 0) {
    const double A = e[norton_creep] * thermal_factor(creep_energy, s.temperature);
    const double flow = creep_stress * std::pow(s.rate / A, 1 / e.norton_exponent);
    const double ratio = P / flow;
    P *= std::pow(1 + ratio * ratio * ratio * ratio, -0.25);
  }
  // outside the catalogue
  const double large = s.size > 1 ? 1 : 0;
  E *= 1 - e[porosity_gradient] * large;
  P *= 1 - 1.3 * e[porosity_gradient] * large;
  E *= 1 - e[moisture_drift] * s.order / 16.0;
  P *= 1 - 1.5 * e[moisture_drift] * s.order / 16.0;
  if (s.rate < 1e-4) {
    E *= 1 - 0.5 * e[temperature_drift];
    P *= 1 - e[temperature_drift];
  }
  if (s.kind == Kind::brazilian) P *= 1 - e[anisotropy], E *= 1 - 0.6 * e[anisotropy];
  if (s.kind == Kind::bending) P *= 1 - 0.3 * e[anisotropy], E *= 1 - 0.2 * e[anisotropy];
  if (s.kind == Kind::shear) P *= 1 - 0.7 * e[anisotropy], E *= 1 - 0.8 * e[anisotropy];

  state.E = E;
  state.peak = P;
  state.residual = residual_stress(s, P, e) * specimen.post;
  state.fall = m.brittleness * specimen.post * (1 - e[softening]) * (1 - 1.5 * w);
  if (compression)
    state.fall *= (1 - 0.5 * e[platen_friction] / s.slenderness) * (1 + 6 * e[tilt]) *
                  (1 - 0.3 * e[rolling_resistance]);
  state.micro = m.microcracks * (1 + 5 * w);
  state.nu = m.nu;
  return state;
}

// Loss of stress in a hold of given length, Norton in closed form.
double relaxed_share(double stress, double E, double A, double m, double time) {
  const double rate = E * A / creep_stress * std::pow(stress / creep_stress, m - 1);
  return 1 - std::pow(1 + (m - 1) * rate * time, 1 / (1 - m));
}

}  // namespace

std::string to_string(Kind kind) {
  switch (kind) {
    case Kind::compression:
      return "compression";
    case Kind::brazilian:
      return "brazilian";
    case Kind::bending:
      return "bending";
    case Kind::shear:
      return "shear";
    case Kind::tension:
      return "tension";
  }
  return "";
}

const std::vector<Series> &all_series() {
  static const std::vector<Series> list = make_series();
  return list;
}

const std::array<double, Curve::rising> &rising_shares() {
  static const std::array<double, Curve::rising> shares = {0.05, 0.1, 0.2, 0.3,  0.4,  0.5, 0.6,
                                                           0.7,  0.8, 0.9, 0.95, 0.98, 1};
  return shares;
}

const std::array<double, Curve::falling> &falling_strains() {
  static const std::array<double, Curve::falling> strains = {0.25e-3, 0.5e-3, 1e-3,
                                                             1.5e-3,  2.5e-3, 4e-3};
  return strains;
}

Curve curve_of(const Series &s, const Material &material, const Effects &e,
               const Specimen &specimen) {
  const bool compression = s.kind == Kind::compression;
  const State state = state_of(s, material, e, specimen);
  const double m = e.norton_exponent;
  const double A =
      e[norton_creep] > 0 ? e[norton_creep] * thermal_factor(creep_energy, s.temperature) : 0;
  const double creep_scale = A > 0 ? A * creep_stress / (state.E * s.rate * (m + 1)) : 0;
  const double seating_scale = has_platens(s.kind) ? e[platen_seating] : 0;
  const double wedge = compression ? e[end_parallelism] : 0;
  const double wedge_stress = 12e6;
  const double frame = e[frame_compliance] * frame_lever(s);
  double conversion = 1;
  if (s.kind == Kind::brazilian) conversion += e[brazilian_conversion];
  if (s.kind == Kind::shear) conversion += e[shear_conversion];
  const double peak_strain = state.peak / state.E;
  const double gauge_factor = 1 + (s.temperature > room ? e[gauge_drift] : 0);

  const auto platen_extra = [&](double stress) {
    double extra = frame * stress;
    if (seating_scale > 0) extra += seating_scale * std::cbrt(stress * stress / 1e14);
    if (wedge > 0) extra += 0.5 * wedge * std::sqrt(std::min(1.0, stress / wedge_stress));
    if (specimen.seating != 0) extra += specimen.seating * std::min(1.0, stress / 4e6);
    return extra;
  };

  Curve curve;
  for (int i = 0; i < Curve::rising; ++i) {
    const double share = rising_shares()[i], stress = share * state.peak;
    const double cube = share * share * share;
    double strain = stress / state.E + peak_strain * state.micro * cube * cube;
    double nu = state.nu + 0.3 * state.micro * cube * cube;
    if (compression && e[missing_bonds] > 0) {
      const double open = std::exp(-stress / closure_stress);
      strain += closure_strain * e[missing_bonds] * (1 - open) * 3;
      nu *= 1 - 2 * e[missing_bonds] * open;
    }
    if (share > 0.5 && e[yielding] != 0)
      strain += peak_strain * e[yielding] * 4 * (share - 0.5) * (share - 0.5);
    if (creep_scale > 0) strain += creep_scale * std::pow(stress / creep_stress, m + 1);
    nu += e[dilatancy] * cube;
    curve.stress[i] = stress;
    curve.gauge[i] = strain * gauge_factor;
    curve.lateral[i] = nu * strain * gauge_factor;
    curve.platen[i] = strain + platen_extra(stress);
    // strain of one side less the other, over the mean: seating leaves a constant, tilt a share
    const double seated = 0.5 * 0.5 * wedge * std::sqrt(std::min(1.0, stress / wedge_stress));
    curve.difference[i] = seated / strain + 3 * e[tilt];
  }
  const double start = curve.gauge[Curve::peak];
  for (int i = 0; i < Curve::falling; ++i) {
    const double beyond = falling_strains()[i];
    const int at = Curve::rising + i;
    const double stress =
        state.residual + (state.peak - state.residual) * std::exp(-state.fall * beyond / 1e-3);
    curve.stress[at] = stress;
    curve.gauge[at] = start + beyond;
    curve.platen[at] = start + beyond + platen_extra(stress);
    curve.lateral[at] = curve.lateral[Curve::peak];
    curve.difference[at] = curve.difference[Curve::peak];
  }
  if (compression) {
    const double damage = 0.25 * e[softening] + 0.35 * state.micro * 0.12;
    curve.unload_modulus =
        state.E / (1 - 0.9 * e[missing_bonds]) * (1 - damage) * (1 - e[kinematic_hardening]);
    double left = 0.3 * state.micro * peak_strain * 0.1176 + peak_strain * e[yielding] * 0.16;
    left += 0.3 * e[kinematic_hardening] * peak_strain;
    const double stress = 0.7 * state.peak;
    if (creep_scale > 0) left += creep_scale * std::pow(stress / creep_stress, m + 1);
    if (e[missing_bonds] > 0) left += 0.1 * closure_strain * e[missing_bonds];
    curve.permanent = left;
    const double held = material.cohesion;  // half of the strength of the base
    constexpr double times[3] = {10, 100, 1000};
    for (int i = 0; i < 3; ++i) {
      curve.relaxed[i] = A > 0 ? relaxed_share(held, state.E, A, m, times[i]) : 0;
      if (s.rate < 1e-4) curve.relaxed[i] += 0.3 * e[temperature_drift] * times[i] / 1000;
    }
  }
  const double cut = e[load_cell_saturation];
  for (double &stress : curve.stress) {
    stress *= conversion;
    if (cut != 0 && compression && stress > 70e6) stress -= cut * (stress - 70e6);
  }
  return curve;
}

double added_strength_scatter(const Series &s, const Effects &e) {
  const double share = s.kind == Kind::compression ? 0.4 : s.kind == Kind::shear ? 0.6 : 1.0;
  const double by_ends = s.kind == Kind::compression ? 5 * e[end_parallelism] + e[tilt] : 0;
  return std::hypot(share * e[weibull], by_ends);
}

}  // namespace bondlab::rheology
