// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the constants of a Norton bond type as a user gives them, and what the law needs of them at a
// temperature.
//
// Bond length L: the distance of the centres at bonding (MUSEN's strain), or that of the surfaces,
// not below a floor, since touching spheres have none (the other reading of the printed "bond
// length"), or the sum of the radii (the parallel bond's). Radius: half a given diameter, or lambda min(R_i, R_j).
//
// The printed form (seed paper 002, eqs. 10-15), as far as it can be run: normal and shear creep apart
// and with one A (eq. 12 and "the same power law"), elastic moments, |F_n| in eq. 15, which is a
// crushing strength equal to the tensile one, stress cut at the yield stress in tension only and with
// nothing remaining of it (eq. 11). Not as printed, because it can't be computed: A sigma^m of a
// compressive stress is complex for most m, so it is A |sigma|^m sign(sigma); explicit creep, which
// turns signs at large steps, is the exact step (they agree to a relative h/2 of what creeps in a
// step, h = E A s^(m-1) dt). Moments count fully (beta = 1).
//
// Units: SI; A in Pa^-m s^-1. 1 MPa^-m s^-1 = 10^(-6m) Pa^-m s^-1: a slip by this factor is easy, so
// creep_rate_in_mpa() names it. Failure: none; ranges are checked by the caller.
#ifndef BONDLAB_LAWS_NORTON_TYPE_H
#define BONDLAB_LAWS_NORTON_TYPE_H

#include <algorithm>
#include <cmath>

#include "norton.h"
#include "temperature.h"

namespace bondlab::laws {

enum class BondLength { center, surface, radii };

struct NortonType {
  double modulus = 0.0;       // E_b, Pa
  double poisson = 0.3;       // nu_b; G = E/(2 (1 + nu))
  double diameter = 0.0;      // d_b, m; 0: from lambda
  double lambda = 1.0;
  double beta = 1.0;
  double exponent = 1.0;      // m
  double log_rate = -1e3;     // ln A
  double rate_factor = 1.0;   // c
  double shear_ratio = 0.0;   // A_s/A; 0: of von Mises, 3^((m+1)/2)
  double crush = kNever, yield_t = kNever, yield_c = kNever, yield_s = kNever;  // Pa
  CreepKind creep = CreepKind::coupled;
  bool moments = false;       // do they creep?
  BondLength length = BondLength::center;
  double least_length = 0.0;  // m, floor of a length between surfaces
  bool cut_only = false;
  TemperatureLaw temperature;
};

// The printed form, see above. Call it after the other parameters are set.
inline void use_printed_form(NortonType &t, double sigma_max) {
  t.creep = CreepKind::separate;
  t.shear_ratio = 1.0;
  t.moments = false;
  t.beta = 1.0;
  t.crush = sigma_max;
  t.yield_c = t.yield_s = kNever;
  t.cut_only = true;
}

inline double creep_rate_in_mpa(double a_per_mpa, double m) {
  return a_per_mpa * std::pow(10.0, -6.0 * m);
}
// ln A from a strain rate (1/s) at a stress (Pa): no powers of Pa, any exponent.
inline double log_rate_at(double rate, double stress, double m) {
  return std::log(rate) - m * std::log(stress);
}

inline double norton_radius(const NortonType &t, double ri, double rj) {
  return t.diameter > 0.0 ? 0.5 * t.diameter : t.lambda * std::min(ri, rj);
}
// L: the distance of the centres at bonding, that of the surfaces, or the sum of the radii, which is
// the parallel bond's.
inline double norton_length(const NortonType &t, double rest, double ri, double rj) {
  if (t.length == BondLength::surface) return std::max(rest - ri - rj, t.least_length);
  return t.length == BondLength::radii ? ri + rj : rest;
}
inline double log_shear_ratio(const NortonType &t) {
  return t.shear_ratio > 0.0 ? std::log(t.shear_ratio) : log_mises_ratio(t.exponent);
}
inline double norton_bend_shape(const NortonType &t, bool flat) {
  return flat ? strip_bend_shape(t.exponent) : round_bend_shape(t.exponent);
}
// Values at a temperature: E, ln(c A), and the share of strengths and yield stresses.
inline double modulus_at(const NortonType &t, double kelvin) {
  return t.modulus * linear_share(t.temperature.modulus, kelvin, t.temperature.reference);
}
inline double log_creep_at(const NortonType &t, double kelvin) {
  return t.log_rate + std::log(t.rate_factor) + log_arrhenius(t.temperature, kelvin);
}
inline double strength_share_at(const NortonType &t, double kelvin) {
  return linear_share(t.temperature.strength, kelvin, t.temperature.reference);
}

}  // namespace bondlab::laws

#endif
