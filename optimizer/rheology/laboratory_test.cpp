// SPDX-License-Identifier: GPL-2.0-or-later
#include "rheology/laboratory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bondlab::rheology {
namespace {

const Series &series(const std::string &name) {
  for (const auto &s : all_series())
    if (s.name == name) return s;
  throw std::runtime_error(name);
}

Curve curve(const std::string &name, const Effects &effects = {}, const Material &material = {}) {
  return curve_of(series(name), material, effects, {});
}

double peak(const std::string &name, const Effects &effects = {}) {
  return curve(name, effects).stress[Curve::peak];
}

Effects with(Effect effect, double size) {
  Effects effects;
  effects.size[effect] = size;
  return effects;
}

TEST(Laboratory, BaseStrengthsAreThoseOfTheMaterial) {
  const Material m;
  EXPECT_DOUBLE_EQ(peak("uc_mid_293K"), 2 * m.cohesion);
  EXPECT_DOUBLE_EQ(peak("dt_mid"), m.tension);
  EXPECT_DOUBLE_EQ(peak("ds_low"), peak("ds_high"));
}

TEST(Laboratory, WithoutEffectsRateTemperatureAndSizeDoNotMatter) {
  const auto one = curve("uc_slow_293K"), other = curve("uc_fast_343K"), large = curve("uc_large");
  for (int i = 0; i < Curve::points; ++i) {
    EXPECT_EQ(one.stress[i], other.stress[i]);
    EXPECT_EQ(one.platen[i], other.platen[i]);
    EXPECT_EQ(one.platen[i], large.platen[i]);
  }
}

TEST(Laboratory, EveryEffectChangesSomeCurveAndIsOffAtZero) {
  for (std::size_t effect = 0; effect < effect_count; ++effect) {
    bool changed = false;
    for (const auto &s : all_series()) {
      const auto without = curve_of(s, {}, {}, {});
      const auto on = curve_of(s, {}, with(static_cast<Effect>(effect), 1e-2), {});
      for (int i = 0; i < Curve::points; ++i)
        changed |= on.stress[i] != without.stress[i] || on.platen[i] != without.platen[i] ||
                   on.gauge[i] != without.gauge[i] || on.lateral[i] != without.lateral[i];
      changed |= on.relaxed != without.relaxed || on.unload_modulus != without.unload_modulus;
    }
    EXPECT_TRUE(changed) << effect_name(effect);
  }
}

// d ln(peak) / d ln(rate) = 1/m far below the critical rate, 0 far above (Norton).
TEST(Laboratory, NortonPeakFollowsTheRateWithOneOverM) {
  Effects effects = with(norton_creep, 1);
  const double slow = peak("uc_slow_293K", effects), mid = peak("uc_mid_293K", effects);
  EXPECT_NEAR(std::log(mid / slow) / std::log(100.0), 1.0 / 3, 1e-3);
  effects = with(norton_creep, 1e-16);
  EXPECT_NEAR(peak("uc_slow_293K", effects) / peak("uc_mid_293K", effects), 1, 1e-3);
}

// d sigma / dt = -E A (sigma/s0)^m, integrated step by step.
TEST(Laboratory, HoldRelaxesAsTheIntegratedNortonLaw) {
  const Material m;
  const double A = 1e-8;
  const auto held = curve("uc_mid_293K", with(norton_creep, A));
  double stress = m.cohesion;
  const double dt = 0.01;
  for (int i = 0; i < 100000; ++i) {
    const auto rate = [&](double s) { return -m.E * A * std::pow(s / 50e6, 3); };
    const double half = stress + 0.5 * dt * rate(stress);
    stress += dt * rate(half);
  }
  EXPECT_NEAR(held.relaxed[2], 1 - stress / m.cohesion, 1e-6);
}

TEST(Laboratory, FrameComplianceAddsTheSameDisplacementPerForceAndSparesTheGauge) {
  const double C = 1e-10;
  const auto effects = with(frame_compliance, C);
  const auto on = curve("uc_mid_293K", effects), off = curve("uc_mid_293K");
  const auto short_on = curve("uc_short", effects), short_off = curve("uc_short");
  for (int i = 0; i < Curve::rising; ++i) {
    EXPECT_EQ(on.gauge[i], off.gauge[i]);
    // A/L doubles for half the length: so does the strain for the same stress
    EXPECT_NEAR(short_on.platen[i] - short_off.platen[i], 2 * (on.platen[i] - off.platen[i]),
                1e-12);
  }
  const double area = 0.25 * 3.14 * 0.05 * 0.05, length = 0.1;
  EXPECT_NEAR(on.platen[Curve::peak] - off.platen[Curve::peak],
              on.stress[Curve::peak] * area / length * C, 1e-9);
}

TEST(Laboratory, CracksGiveACompressionToeAndNoneInTheBrazilianTest) {
  const auto effects = with(missing_bonds, 0.05);
  const auto toe = [](const Curve &c) {  // compliance at the start over that in the middle
    return (c.gauge[1] / c.stress[1]) / ((c.gauge[6] - c.gauge[4]) / (c.stress[6] - c.stress[4]));
  };
  EXPECT_GT(toe(curve("uc_mid_293K", effects)), 1.2 * toe(curve("uc_mid_293K")));
  EXPECT_NEAR(toe(curve("bd_small", effects)), toe(curve("bd_small")), 1e-9);
}

TEST(Laboratory, PressureDependenceIsTheSlopeOfShearStrengthOverNormalStress) {
  const auto effects = with(pressure_dependence, 0.3);
  EXPECT_NEAR((peak("ds_high", effects) - peak("ds_low", effects)) / (20e6 - 2e6), 0.3, 1e-9);
}

TEST(Laboratory, WeibullSizeExponentIsOneOverK) {
  const auto effects = with(weibull, 0.1);
  EXPECT_NEAR(std::log(peak("bd_large", effects) / peak("bd_small", effects)) / std::log(8.0), -0.1,
              1e-9);
  EXPECT_GT(added_strength_scatter(series("dt_mid"), effects),
            added_strength_scatter(series("uc_mid_293K"), effects));
}

TEST(Laboratory, ConversionErrorScalesOneTestAndKeepsItsShape) {
  const auto effects = with(brazilian_conversion, 0.5);
  const auto on = curve("bd_small", effects), off = curve("bd_small");
  for (int i = 0; i < Curve::points; ++i) EXPECT_NEAR(on.stress[i] / off.stress[i], 1.5, 1e-12);
  EXPECT_EQ(peak("uc_mid_293K", effects), peak("uc_mid_293K"));
}

TEST(Laboratory, YieldLeavesStrainAndDoesNotRelax) {
  const auto effects = with(yielding, 0.2);
  const auto on = curve("uc_mid_293K", effects), off = curve("uc_mid_293K");
  EXPECT_GT(on.permanent, off.permanent);
  EXPECT_EQ(on.relaxed[2], 0);
  EXPECT_EQ(on.unload_modulus, off.unload_modulus);
}

}  // namespace
}  // namespace bondlab::rheology
