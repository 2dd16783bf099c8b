// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/bending.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bondlab {
namespace {

constexpr double stiffness = 3e6, peak = 120;

Curve bending_curve() {
  Curve curve;
  curve.names = {"time", "force_top", "force_bottom", "deflection"};
  curve.columns.resize(4);
  for (int i = 0; i < 300; ++i) {
    const double s = i / 200.0, load = peak * (s <= 1 ? s : std::fmax(0.2, 1 - 4 * (s - 1)));
    const double row[] = {1e-5 * i, 1.02 * load, 0.98 * load, s * peak / stiffness};
    for (std::size_t c = 0; c < 4; ++c) curve.columns[c].push_back(row[c]);
  }
  curve.complete = true;
  return curve;
}

ResponseContext plane() {
  return {{{"dim", 2}, {"height", 0.02}, {"thickness", 0.5}, {"span", 0.08}, {"poisson", 0.25},
           {"notch_depth", 0.01}}};
}
ResponseContext bar() {
  return {{{"dim", 3}, {"diameter", 0.01}, {"length", 0}, {"span", 0.0333}, {"poisson", 0.3},
           {"notch_depth", 0.0036}, {"height", 0.04}}};
}

TEST(Bending, StrengthIsTheOuterFibresStressOfTheSection) {
  EXPECT_NEAR(evaluate("bending.flexural_strength", bending_curve(), plane()),
              3 * peak * 0.08 / (2 * 0.5 * 0.02 * 0.02), 1e-6 * peak);
  EXPECT_NEAR(evaluate("bending.flexural_strength", bending_curve(), bar()),
              8 * peak * 0.0333 / (M_PI * 1e-6), 1.0);
}

TEST(Bending, APrismIsARectangle) {
  ResponseContext context = bar();
  context.variables["length"] = 0.05;
  context.variables["width"] = 0.006;
  context.variables["height"] = 0.008;
  EXPECT_NEAR(evaluate("bending.flexural_strength", bending_curve(), context),
              3 * peak * 0.0333 / (2 * 0.006 * 0.008 * 0.008), 1.0);
}

TEST(Bending, ModulusTakesItsTimoshenkoDeflectionBack) {
  // E from a beam of known E: delta = F S^3/(48 E I) + F S/(4 kappa G A)
  for (const bool round : {false, true}) {
    const ResponseContext context = round ? bar() : plane();
    const double span = round ? 0.0333 : 0.08, d = round ? 0.01 : 0.02, nu = round ? 0.3 : 0.25;
    const double area = round ? M_PI * d * d / 4 : 0.5 * d;
    const double inertia = round ? M_PI * d * d * d * d / 64 : 0.5 * d * d * d / 12;
    const double kappa = round ? 6 * (1 + nu) / (7 + 6 * nu) : 10 * (1 + nu) / (12 + 11 * nu);
    const double e = evaluate("bending.flexural_modulus", bending_curve(), context);
    const double shear_modulus = e / (2 * (1 + nu));
    EXPECT_NEAR(span * span * span / (48 * e * inertia) + span / (4 * kappa * shear_modulus * area),
                1 / stiffness, 1e-9 / stiffness);
    const double slender = evaluate("bending.flexural_modulus_slender", bending_curve(), context);
    EXPECT_NEAR(slender, stiffness * span * span * span / (48 * inertia), 1e-6 * slender);
    EXPECT_NEAR(e / slender, 1 + 24 * (1 + nu) * inertia / (kappa * area * span * span), 1e-9);
  }
}

TEST(Bending, ShortBarOfTheMilledIceIsHalfShear) {
  // PHYSICS 5.3: S/d = 1.5, nu .3: factor 1.98
  ResponseContext context = bar();
  context.variables["span"] = 0.015;
  EXPECT_NEAR(evaluate("bending.flexural_modulus", bending_curve(), context) /
                  evaluate("bending.flexural_modulus_slender", bending_curve(), context),
              1.98, 0.005);
}

TEST(Bending, ToughnessFollowsTheStandards) {
  // Seed 001's bar: x = .36 gives Y' = 9.36; E399 at x = .5: f = 2.66 (its table)
  EXPECT_NEAR(bending::senrbb_shape(0.36), 9.36, 0.01);
  EXPECT_NEAR(bending::e399_shape(0.5), 2.66, 0.005);
  EXPECT_NEAR(evaluate("bending.toughness", bending_curve(), plane()),
              peak * 0.08 / (0.5 * std::pow(0.02, 1.5)) * bending::e399_shape(0.5), 1e-3);
  EXPECT_NEAR(evaluate("bending.toughness", bending_curve(), bar()),
              0.25 * 3.33 * bending::senrbb_shape(0.36) * peak / 1e-3, 1e-3);
}

TEST(Bending, ToughnessOutsideItsFormulaIsRefused) {
  for (const auto &[name, value] : std::map<std::string, double>{{"span", 0.04}, {"notch_depth", 1e-3}}) {
    ResponseContext context = plane();
    context.variables[name] = value;
    try {
      evaluate("bending.toughness", bending_curve(), context);
      ADD_FAILURE() << name;
    } catch (const ResponseError &error) {
      EXPECT_EQ(error.cause(), ResponseCause::implausible) << name;
    }
  }
}

TEST(Bending, LoadAndReactionAreCompared) {
  // |1.02 - .98| at 60 % over the mean at 50 %
  EXPECT_NEAR(quality_figures("bending.toughness", bending_curve(), plane()).at("platen_imbalance"),
              0.04 * 0.6 / 0.5, 1e-3);
}

}  // namespace
}  // namespace bondlab
