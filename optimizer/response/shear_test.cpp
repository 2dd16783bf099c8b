// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/shear.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace bondlab {
namespace {

// Settling until sample 20 (the lid sinks by 1e-6), up to 8 MPa at 100, down to 3 MPa at 150, on.
Curve shear_curve(int samples = 400) {
  Curve curve;
  curve.names = {"time",      "displacement", "shear_stress", "lift",
                 "force_top", "force_bottom", "normal_stress"};
  curve.columns.resize(7);
  for (int i = 0; i < samples; ++i) {
    const int s = std::max(0, i - 20);
    const double stress = s <= 100 ? 8e4 * s : std::max(3e6, 8e6 - 1e5 * (s - 100));
    const double lift = (i < 20 ? -5e-8 * i : -1e-6) + 1e-8 * s - (s > 200 ? 5e-9 * (s - 200) : 0);
    const double row[] = {1e-5 * i,
                          1e-6 * s,
                          stress,
                          lift,
                          stress,
                          0.9 * stress,
                          s == 100 ? 5.5e6 : s > 300 ? 4.5e6 : 5e6};
    for (std::size_t c = 0; c < 7; ++c) curve.columns[c].push_back(row[c]);
  }
  curve.complete = true;
  return curve;
}

TEST(Shear, PeakAndResidualStrength) {
  EXPECT_DOUBLE_EQ(evaluate("shear.peak_strength", shear_curve(), {}), 8e6);
  EXPECT_DOUBLE_EQ(evaluate("shear.residual_strength", shear_curve(), {}), 3e6);
}

TEST(Shear, NormalStressIsWhatTheServoHeld) {
  EXPECT_DOUBLE_EQ(evaluate("shear.normal_stress_at_peak", shear_curve(), {}), 5.5e6);
  // the last fifth begins at 0.8 of 379 steps
  EXPECT_DOUBLE_EQ(evaluate("shear.normal_stress_at_residual", shear_curve(), {}), 4.5e6);
  EXPECT_THROW(evaluate("shear.normal_stress_at_residual", shear_curve(135), {}), ResponseError);
}

TEST(Shear, DilationCountsFromTheStartOfShearing) {
  // up by 3.79e-6 - 0.895e-6 at the end, from where the lid stood after settling
  EXPECT_NEAR(evaluate("shear.dilation", shear_curve(), {}), 3.79e-6 - 179 * 5e-9, 1e-12);
}

TEST(Shear, ATestThatEndsAtItsPeakHasNoResidualStrength) {
  EXPECT_NO_THROW(evaluate("shear.peak_strength", shear_curve(135), {}));
  EXPECT_THROW(evaluate("shear.residual_strength", shear_curve(135), {}), ResponseError);
  EXPECT_THROW(evaluate("shear.peak_strength", shear_curve(110), {}), ResponseError);
}

TEST(Shear, StrengthWithinAShearIsThatOfASpecimenThatFlowsOrHasBroken) {
  const char *const function = "shear.strength_within_shear";
  const Curve broken = shear_curve(), climbing = shear_curve(110);  // to 89 and 379 um
  const auto box = [](double across, double most) {
    return ResponseContext{{{"dim", 3}, {"diameter", across}, {"width", 1}, {"max_shear", most}}};
  };
  EXPECT_DOUBLE_EQ(evaluate(function, broken, box(0.01, 0.1)), 8e6);
  EXPECT_NEAR(evaluate(function, climbing, box(0.01, 0.0089)), 8.9e4 * 80, 1);
  EXPECT_THROW(evaluate(function, climbing, box(0.01, 0.02)), ResponseError);
  // A box has its width in two dimensions.
  EXPECT_NEAR(evaluate(function, climbing, {{{"dim", 2}, {"width", 0.01}, {"max_shear", 0.0089}}}),
              8.9e4 * 80, 1);
  EXPECT_THROW(evaluate(function, climbing, {{{"dim", 2}, {"width", 0.01}}}), ResponseError);
}

TEST(Shear, TheHalvesForcesAreCompared) {
  EXPECT_NEAR(quality_figures("shear.peak_strength", shear_curve(), {}).at("platen_imbalance"),
              0.1 / 0.95 * 0.6 / 0.5, 3e-3);
}

}  // namespace
}  // namespace bondlab
