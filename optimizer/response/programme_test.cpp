// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/programme.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "response/run_quality.h"

namespace bondlab {
namespace {

// Loading with modulus 10 GPa, a hold in which stress relaxes to 80 %, a kept load that creeps at 2
// 1/s after a transient, an unloading with 15 GPa.
Curve programme_curve() {
  Curve curve;
  curve.names = {"time", "phase", "axial_stress", "strain_axial"};
  curve.columns.resize(4);
  double time = 0, stress = 0, strain = 0;
  const auto add = [&](double phase) {
    time += 1e-5;
    const double row[] = {time, phase, stress, strain};
    for (std::size_t c = 0; c < 4; ++c) curve.columns[c].push_back(row[c]);
  };
  for (int i = 0; i < 100; ++i) strain += 1e-5, stress += 1e5, add(0);
  for (int i = 0; i <= 50; ++i) stress = 1e7 * (1 - 0.2 * i / 50.0), add(2);
  for (int i = 0; i < 90; ++i) strain += 2e-5 + 1e-5 * std::exp(-i / 3.0), add(3);
  for (int i = 0; i < 60; ++i) strain -= 6e-6, stress -= 15e9 * 6e-6, add(4);
  for (int i = 0; i < 60; ++i) strain += 1e-5, stress += 1e5, add(0);
  curve.complete = true;
  return curve;
}

ResponseCause cause_of(const std::string &function, const Curve &curve) {
  try {
    evaluate(function, curve, {});
  } catch (const ResponseError &error) {
    return error.cause();
  }
  ADD_FAILURE() << function << " gave a number";
  return ResponseCause::unknown_function;
}

TEST(Programme, EachPhaseGivesItsQuantity) {
  const Curve curve = programme_curve();
  EXPECT_NEAR(evaluate("programme.unloading_modulus", curve, {}), 15e9, 1.0);
  EXPECT_NEAR(evaluate("programme.relaxed_share", curve, {}), 0.2, 1e-12);
  // 2e-5 a sample of 1e-5 s; the transient has died out by exp(-20)
  EXPECT_NEAR(evaluate("programme.creep_rate", curve, {}), 2.0, 1e-6);
}

TEST(Programme, APhaseThatNeverCameGivesNoNumber) {
  Curve curve = programme_curve();
  for (double &phase : curve.columns[1]) phase = 0;
  for (const char *function :
       {"programme.unloading_modulus", "programme.relaxed_share", "programme.creep_rate"})
    EXPECT_EQ(cause_of(function, curve), ResponseCause::test_not_finished) << function;
}

TEST(Programme, TooFewSamplesAreRefused) {
  Curve curve = programme_curve();
  for (auto &column : curve.columns) {
    std::vector<double> every;
    for (std::size_t i = 0; i < column.size(); i += 8) every.push_back(column[i]);
    column = every;
  }
  EXPECT_EQ(cause_of("programme.unloading_modulus", curve), ResponseCause::window_too_small);
  EXPECT_EQ(cause_of("programme.creep_rate", curve), ResponseCause::window_too_small);
}

// The end of the kept load counts, not the servo's first knock; without one, the hold.
TEST(Programme, TheEndOfTheHoldIsJudged) {
  Curve curve = programme_curve();
  curve.names.insert(curve.names.end(),
                     {"force_top", "force_bottom", "kinetic_energy", "strain_energy"});
  for (const double value : {100.0, 100.0, 1e-6, 1.0})
    curve.columns.emplace_back(curve.rows(), value);
  auto &bottom = curve.columns[5], &kinetic = curve.columns[6];
  const auto &phase = curve.columns[1];
  const auto keeps = static_cast<std::size_t>(std::find(phase.begin(), phase.end(), 3) - phase.begin());
  const auto holds = static_cast<std::size_t>(std::find(phase.begin(), phase.end(), 2) - phase.begin());
  bottom[keeps + 2] = 300, kinetic[keeps + 2] = 0.5;
  bottom[holds + 40] = 150, kinetic[holds + 40] = 0.25;
  bottom[keeps + 80] = 98, kinetic[keeps + 80] = 2e-3;
  auto figures = quality_figures("programme.creep_rate", curve, {});
  EXPECT_NEAR(figures.at("hold_platen_imbalance"), 0.02, 2e-4);
  EXPECT_NEAR(figures.at("hold_kinetic_share"), 2e-3, 1e-12);
  for (double &p : curve.columns[1])
    if (p == 3) p = 0;
  figures = quality_figures("programme.relaxed_share", curve, {});
  // 50 N of a mean of 101.5 N over the 17 points of the last third
  EXPECT_NEAR(figures.at("hold_platen_imbalance"), 50 / 101.47, 1e-3);
  EXPECT_NEAR(figures.at("hold_kinetic_share"), 0.25, 1e-12);
}

TEST(RunQuality, WarnsBeyondItsBoundsOnly) {
  const std::vector<std::pair<std::string, double>> bounds = {
      {"platen_imbalance", 0.05}, {"hold_platen_imbalance", 0.05},    {"kinetic_share", 0.01},
      {"hold_kinetic_share", 0.01}, {"first_cracks", 2.0 / 3}};
  for (const auto &[figure, bound] : bounds) {
    EXPECT_EQ(quality_warning(figure, 0.99 * bound), "") << figure;
    EXPECT_NE(quality_warning(figure, 1.01 * bound), "") << figure;
    EXPECT_NE(quality_words(figure), "") << figure;
  }
  EXPECT_EQ(quality_warning("peak_strain", 1e9), "");
  EXPECT_NE(quality_warning("hold_kinetic_share", 1).find("the end of the hold"), std::string::npos);
  EXPECT_NE(quality_warning("kinetic_share", 1).find("of the peak"), std::string::npos);
}

}  // namespace
}  // namespace bondlab
