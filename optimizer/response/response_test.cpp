// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/random.h"
#include "response/loading_branch.h"

namespace bondlab {
namespace {

constexpr double modulus = 41.5e9, poisson = 0.23, strength = 138.8e6;
constexpr int samples = 400;

// A straight loading branch up to the peak at three quarters of the samples, then a fall to `rest`
// of the peak.
Curve compression_curve(double rest = 0.5) {
  Curve curve;
  curve.names = {"time",          "axial_stress", "force_top",     "force_bottom",
                 "strain_platen", "strain_axial", "strain_lateral"};
  curve.columns.resize(curve.names.size());
  const double peak_strain = strength / modulus;
  for (int i = 0; i < samples; ++i) {
    const double s = static_cast<double>(i) / (0.75 * samples);  // 1 at the peak
    const double strain = s * peak_strain;
    const double stress = s <= 1 ? modulus * strain : strength * std::max(rest, 1 - 5 * (s - 1));
    const double row[] = {1e-5 * i,     stress, 0.05 * stress,   0.05 * stress,
                          1.1 * strain, strain, poisson * strain};
    for (std::size_t c = 0; c < curve.columns.size(); ++c) curve.columns[c].push_back(row[c]);
  }
  curve.complete = true;
  return curve;
}

std::vector<double> &column(Curve &curve, const std::string &name) {
  for (std::size_t c = 0; c < curve.names.size(); ++c)
    if (curve.names[c] == name) return curve.columns[c];
  throw std::logic_error("no column " + name);
}

ResponseCause cause_of(const std::string &function, const Curve &curve,
                       const ResponseContext &context = {}) {
  try {
    evaluate(function, curve, context);
  } catch (const ResponseError &error) {
    EXPECT_FALSE(std::string(error.what()).empty());
    return error.cause();
  }
  ADD_FAILURE() << function << " gave a number";
  return ResponseCause::unknown_function;
}

TEST(Uniaxial, StraightBranchGivesItsModulusRatioAndStrength) {
  const Curve curve = compression_curve();
  EXPECT_NEAR(evaluate("uniaxial.tangent_modulus_gauge", curve, {}), modulus, 1e-9 * modulus);
  EXPECT_NEAR(evaluate("uniaxial.tangent_modulus_platen", curve, {}), modulus / 1.1,
              1e-9 * modulus);
  EXPECT_NEAR(evaluate("uniaxial.poisson_gauge", curve, {}), poisson, 1e-12);
  EXPECT_NEAR(evaluate("uniaxial.peak_stress", curve, {}), strength, 1e-9 * strength);
  EXPECT_NEAR(evaluate("uniaxial.peak_strain", curve, {}), strength / modulus, 1e-12);
}

TEST(Uniaxial, TangentIsTakenBetween40And60PercentOnly) {
  // Softer below 40 % of the peak and stiffer above 60 %: neither may show.
  Curve curve = compression_curve();
  auto &strain = column(curve, "strain_axial");
  const auto &stress = column(curve, "axial_stress");
  for (std::size_t i = 0; i < strain.size(); ++i) {
    const double share = stress[i] / strength;
    if (i > 300) continue;  // behind the peak
    if (share < 0.40) strain[i] -= 0.5 * (0.40 - share) * strength / modulus;
    if (share > 0.60) strain[i] += 2.0 * (share - 0.60) * strength / modulus;
  }
  EXPECT_NEAR(evaluate("uniaxial.tangent_modulus_gauge", curve, {}), modulus, 1e-6 * modulus);
}

TEST(Uniaxial, EarlySpikeOfThePlatenDoesNotWidenTheWindow) {
  Curve curve = compression_curve();
  for (int i = 5; i < 12; ++i)
    column(curve, "axial_stress")[static_cast<std::size_t>(i)] = 0.5 * strength;
  EXPECT_NEAR(evaluate("uniaxial.tangent_modulus_gauge", curve, {}), modulus, 1e-6 * modulus);
}

TEST(Uniaxial, ModulusUnderNoiseIsWithinItsStandardError) {
  RandomStream random(7);
  int inside = 0;
  constexpr int repeats = 200;
  for (int r = 0; r < repeats; ++r) {
    Curve curve = compression_curve();
    for (double &stress : column(curve, "axial_stress"))
      stress += 0.002 * strength * random.normal();
    const auto &load = curve.column("axial_stress");
    const auto fit =
        fit_line(curve.column("strain_axial"), load, loading_window(load, find_peak(load)));
    if (std::fabs(fit.slope - modulus) < 2 * fit.slope_error) ++inside;
  }
  EXPECT_GE(inside, 180);  // 95 % expected; 180 of 200 is 3.2 sd of the binomial below
  EXPECT_LE(inside, 199);
}

TEST(Uniaxial, MachineModulusIsThatOfTheMachinesStrain) {
  Curve curve = compression_curve();
  curve.names.push_back("strain_machine");
  curve.columns.push_back(curve.column("strain_axial"));
  for (double &strain : curve.columns.back()) strain *= 1.6;
  EXPECT_NEAR(evaluate("uniaxial.tangent_modulus_machine", curve, {}), modulus / 1.6,
              1e-9 * modulus);
}

TEST(Uniaxial, KineticShareIsTheLargestInTheWindow) {
  Curve curve = compression_curve();
  curve.names.push_back("kinetic_energy");
  curve.names.push_back("strain_energy");
  std::vector<double> kinetic(samples, 1e-3), strain(samples, 1.0);
  kinetic[10] = 5;     // before the window
  kinetic[150] = 0.02;  // half of the peak: in it
  kinetic[290] = 7;     // beyond
  curve.columns.push_back(kinetic);
  curve.columns.push_back(strain);
  EXPECT_DOUBLE_EQ(evaluate("uniaxial.kinetic_share", curve, {}), 0.02);
  EXPECT_DOUBLE_EQ(evaluate("brazilian.kinetic_share", curve, {}), 0.02);
  EXPECT_EQ(quality_figures("uniaxial.peak_stress", curve, {}).at("kinetic_share"), 0.02);
  column(curve, "strain_energy")[150] = 0;
  EXPECT_EQ(cause_of("uniaxial.kinetic_share", curve), ResponseCause::implausible);
}

TEST(Uniaxial, TestThatStoppedBeforeThePeakGivesNoNumber) {
  Curve curve = compression_curve();
  for (auto &values : curve.columns) values.resize(295);  // the peak is sample 300
  for (const std::string function :
       {"uniaxial.peak_stress", "uniaxial.tangent_modulus_gauge", "uniaxial.poisson_gauge"})
    EXPECT_EQ(cause_of(function, curve), ResponseCause::test_not_finished) << function;
  EXPECT_EQ(cause_of("uniaxial.peak_stress", compression_curve(0.97)),
            ResponseCause::test_not_finished);
}

TEST(Uniaxial, StrengthWithinAStrainIsThatOfASpecimenThatFlowsOrHasBroken) {
  const char *const function = "uniaxial.strength_within_strain";
  Curve curve = compression_curve(1);  // flows at its peak
  curve.names.push_back("strain_machine");
  curve.columns.push_back(column(curve, "strain_platen"));
  const double end = curve.columns.back().back();
  EXPECT_NEAR(evaluate(function, curve, {{{"max_strain", end}}}), strength, 1e-9 * strength);
  EXPECT_EQ(cause_of("uniaxial.peak_stress", curve), ResponseCause::test_not_finished);
  // Cut off before it got there, though it had not failed.
  EXPECT_EQ(cause_of(function, curve, {{{"max_strain", 1.1 * end}}}),
            ResponseCause::test_not_finished);
  EXPECT_EQ(cause_of(function, curve, {}), ResponseCause::missing_variable);
  Curve broken = compression_curve();
  broken.names.push_back("strain_machine");
  broken.columns.push_back(column(broken, "strain_platen"));
  EXPECT_NEAR(evaluate(function, broken, {{{"max_strain", 1.1 * end}}}), strength,
              1e-9 * strength);
  for (auto &value : column(broken, "axial_stress")) value = 0;
  EXPECT_EQ(cause_of(function, broken, {{{"max_strain", end}}}), ResponseCause::no_load);
}

TEST(Uniaxial, TooFewSamplesInTheWindowAreRefused) {
  Curve sparse = compression_curve();
  for (auto &values : sparse.columns) {
    std::vector<double> every;
    for (std::size_t i = 0; i < values.size(); i += 10) every.push_back(values[i]);
    values = every;
  }
  EXPECT_EQ(cause_of("uniaxial.tangent_modulus_gauge", sparse), ResponseCause::window_too_small);
  EXPECT_GT(evaluate("uniaxial.peak_stress", sparse, {}),
            0.9 * strength);  // the peak needs no window
}

TEST(Uniaxial, TimeThatGoesBackIsRefused) {
  Curve curve = compression_curve();
  column(curve, "time")[100] = column(curve, "time")[99];
  EXPECT_EQ(cause_of("uniaxial.peak_stress", curve), ResponseCause::time_not_monotonic);
}

TEST(Uniaxial, NotANumberAndMissingColumnsAreNamed) {
  Curve curve = compression_curve();
  column(curve, "strain_axial")[50] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cause_of("uniaxial.tangent_modulus_gauge", curve), ResponseCause::bad_data);
  curve = compression_curve();
  curve.names[5] = "something_else";
  EXPECT_EQ(cause_of("uniaxial.tangent_modulus_gauge", curve), ResponseCause::missing_column);
  curve = compression_curve();
  column(curve, "strain_axial").pop_back();
  EXPECT_EQ(cause_of("uniaxial.tangent_modulus_gauge", curve), ResponseCause::bad_data);
}

TEST(Uniaxial, UnloadedAndReversedCurvesAreRefused) {
  Curve curve = compression_curve();
  for (double &stress : column(curve, "axial_stress")) stress = 0;
  EXPECT_EQ(cause_of("uniaxial.peak_stress", curve), ResponseCause::no_load);
  curve = compression_curve();
  for (double &strain : column(curve, "strain_axial")) strain = -strain;
  EXPECT_EQ(cause_of("uniaxial.tangent_modulus_gauge", curve), ResponseCause::implausible);
  curve = compression_curve();
  for (double &strain : column(curve, "strain_axial")) strain = 1e-3;
  EXPECT_EQ(cause_of("uniaxial.poisson_gauge", curve), ResponseCause::implausible);
}

TEST(Uniaxial, UnequalPlatenForcesAreAQualityFigureAndNoError) {
  Curve curve = compression_curve();
  for (double &force : column(curve, "force_top")) force *= 1.10;
  // |1.1 - 1| at the window's top (60 %) over the mean 1.05 at its middle (50 %)
  EXPECT_NEAR(evaluate("uniaxial.platen_imbalance", curve, {}), 0.10 / 1.05 * 0.6 / 0.5, 2e-3);
  EXPECT_NEAR(evaluate("uniaxial.tangent_modulus_gauge", curve, {}), modulus, 1e-9 * modulus);
  const auto figures = quality_figures("uniaxial.peak_stress", curve, {});
  EXPECT_EQ(figures.count("platen_imbalance"), 1u);
  EXPECT_EQ(figures.count("tangent_modulus_platen"), 1u);
}

TEST(Brazilian, StrengthIsTwicePeakLoadOverPiDiameterThickness) {
  const Curve curve = compression_curve();
  const double diameter = 0.05, thickness = 0.025;
  const ResponseContext context{{{"diameter", diameter}, {"thickness", thickness}}};
  const double load = 0.05 * strength;
  EXPECT_NEAR(evaluate("brazilian.tensile_strength", curve, context),
              2 * load / (M_PI * diameter * thickness), 1e-6);
}

TEST(Brazilian, LoadIsTheMeanOfBothPlatens) {
  Curve curve = compression_curve();
  for (double &force : column(curve, "force_top")) force *= 1.2;
  const ResponseContext context{{{"diameter", 0.05}, {"thickness", 1.0}}};
  EXPECT_NEAR(evaluate("brazilian.tensile_strength", curve, context),
              1.1 * 2 * 0.05 * strength / (M_PI * 0.05), 1e-6);
  EXPECT_GT(quality_figures("brazilian.tensile_strength", curve, context).at("platen_imbalance"),
            0.15);
}

TEST(Brazilian, MissingOrZeroDimensionIsNamed) {
  const Curve curve = compression_curve();
  EXPECT_EQ(cause_of("brazilian.tensile_strength", curve, {{{"diameter", 0.05}}}),
            ResponseCause::missing_variable);
  EXPECT_EQ(
      cause_of("brazilian.tensile_strength", curve, {{{"diameter", 0.05}, {"thickness", 0.0}}}),
      ResponseCause::missing_variable);
}

TEST(Registry, UnknownFunctionIsAnsweredWithTheKnownOnes) {
  EXPECT_EQ(cause_of("uniaxial.young", compression_curve()), ResponseCause::unknown_function);
  try {
    evaluate("uniaxial.young", compression_curve(), {});
  } catch (const ResponseError &error) {
    EXPECT_NE(std::string(error.what()).find("uniaxial.peak_stress"), std::string::npos);
  }
  for (const auto &name : response_functions()) EXPECT_TRUE(is_response_function(name));
  EXPECT_FALSE(is_response_function("uniaxial.young"));
}

}  // namespace
}  // namespace bondlab
