// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/impact.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bondlab {
namespace {

// A half sine of 1 kN between 20 and 120 of 200 samples.
Curve impact_curve() {
  Curve curve;
  curve.names = {"time",         "force_top",    "ball_energy",  "broken_bonds",
                 "intact_bonds", "largest_share", "passing_share"};
  curve.columns.resize(7);
  for (int i = 0; i < 200; ++i) {
    const double s = (i - 20) / 100.0;
    const double force = s > 0 && s < 1 ? 1000 * std::sin(M_PI * s) : 0;
    const double after = s > 0.5 ? 1 : 0;
    const double row[] = {1e-6 * i,          force,           0.05 - 0.02 * after, 30 * after,
                          100 - 30 * after, 1 - 0.4 * after, 0.1 * after};
    for (std::size_t c = 0; c < 7; ++c) curve.columns[c].push_back(row[c]);
  }
  curve.complete = true;
  return curve;
}

TEST(Impact, QuantitiesAreThoseOfTheEnd) {
  EXPECT_DOUBLE_EQ(evaluate("impact.peak_force", impact_curve(), {}), 1000);
  EXPECT_NEAR(evaluate("impact.contact_time", impact_curve(), {}), 98e-6, 1e-9);
  EXPECT_DOUBLE_EQ(evaluate("impact.absorbed_energy", impact_curve(), {}), 0.05 - (0.05 - 0.02));
  EXPECT_DOUBLE_EQ(evaluate("impact.broken_share", impact_curve(), {}), 0.3);
  EXPECT_DOUBLE_EQ(evaluate("impact.largest_share", impact_curve(), {}), 0.6);
  EXPECT_DOUBLE_EQ(evaluate("impact.passing_share", impact_curve(), {}), 0.1);
}

TEST(Impact, ARunThatEndsWhileTheBallPressesIsNotFinished) {
  Curve curve = impact_curve();
  for (auto &column : curve.columns) column.resize(110);
  for (const char *function : {"impact.absorbed_energy", "impact.broken_share",
                               "impact.largest_share", "impact.contact_time"}) {
    try {
      evaluate(function, curve, {});
      ADD_FAILURE() << function;
    } catch (const ResponseError &error) {
      EXPECT_EQ(error.cause(), ResponseCause::test_not_finished) << function;
    }
  }
}

}  // namespace
}  // namespace bondlab
