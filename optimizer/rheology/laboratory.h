// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the tests of the closed-form laboratory and the curve of one test under one condition.
// Method: every curve is written down, not integrated: strain as a function of stress up to the
//   peak (elastic, crack closure, microcracks, Norton creep under constant rate, yield), stress as
//   an exponential fall to the residual stress behind it, an unloading at 0.7 of the peak and a
//   hold at half the peak of the mid rate (Norton relaxation in closed form). A curve takes a few
//   microseconds, so that thousands of laboratories can be diagnosed in a test.
// Why: the statistics of the diagnosis need thousands of cases; the engine gives dozens.
// Source: the signatures are those of the field's textbooks: Norton relaxation and peak below the
//   critical rate; Weibull size exponent 1/k; Hertz closure u ~ F^(2/3); frame compliance in series
//   with the specimen; Mohr-Coulomb 2c(sqrt(1+t^2)+t); bimodular beam 4 E_t
//   E_c/(sqrt(E_t)+sqrt(E_c))^2.
// Units: SI; strain 1. Failure: none.
// Limits: one-dimensional, no localisation; factors that only set how strong a trace is are
//   plausible, not measured. It is a test bench for statistics, not a model of a rock.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "rheology/material.h"

namespace bondlab::rheology {

enum class Kind { compression, brazilian, bending, shear, tension };
std::string to_string(Kind kind);

struct Series {
  std::string name;  // "uc_mid_293K"
  std::string test;  // "uniaxial_compression"
  Kind kind;
  double rate = 1e-3;        // 1/s
  double temperature = 293;  // K
  double normal_stress = 0;  // Pa; shear
  double slenderness = 2;    // length over diameter; compression
  double size = 1;           // length over that of the standard specimen of this test
  int order = 0;             // when in the campaign it was tested
};

// Every series that the laboratory offers, in the order of testing.
const std::vector<Series> &all_series();

// What makes one specimen (or one packing) differ from the mean: factors about 1.
struct Specimen {
  double stiffness = 1, strength = 1, post = 1;
  double seating = 0;  // platen strain more at the toe
};

struct Curve {
  static constexpr int rising = 13, falling = 6, points = rising + falling, peak = rising - 1;
  std::array<double, points> stress, platen, gauge, lateral, difference;
  double unload_modulus = 0, permanent = 0;  // Pa; strain left after unloading at 0.7 of the peak
  std::array<double, 3> relaxed{};           // share of the stress lost after 10, 100, 1000 s
};

// Position of the rising points as shares of the peak stress.
const std::array<double, Curve::rising> &rising_shares();
// Strain beyond the peak of the falling points.
const std::array<double, Curve::falling> &falling_strains();

Curve curve_of(const Series &series, const Material &material, const Effects &effects,
               const Specimen &specimen);

// Coefficient of variation of strength that the effects add to the specimens' own.
double added_strength_scatter(const Series &series, const Effects &effects);

}  // namespace bondlab::rheology
