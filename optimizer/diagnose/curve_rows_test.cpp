// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/curve_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace bondlab::diagnose {
namespace {

using P = CurvePart;

constexpr double modulus = 40e9, strength = 120e6, nu = 0.25, softer = 1.6;
constexpr double seating = 5e-4;   // travel of the platen before the specimen is loaded
constexpr double way_down = 0.25;  // strain over that at the peak, until nothing is carried

// Straight up to the peak in every gauge, straight down after it. The platen sees `softer` times
// the strain and, before, a seating at a tenth of the load.
Curve straight(bool with_fall) {
  Curve c;
  c.names = {"time", "axial_stress", "strain_platen", "strain_axial", "strain_lateral"};
  c.units = {"s", "Pa", "1", "1", "1"};
  c.columns.resize(c.names.size());
  const int up = 200, down = with_fall ? 100 : 0;
  for (int i = 0; i <= up + down; ++i) {
    const double s = i <= up ? i / double(up) : 1 + way_down * (i - up) / double(down);
    const double load = i <= up ? strength * s : strength * (1 - (i - up) / double(down));
    const double gauge = s * strength / modulus;
    const double platen = softer * gauge + seating * std::min(1.0, s / 0.1);
    const double row[] = {1e-5 * i, load, platen, gauge, nu * gauge};
    for (std::size_t k = 0; k < c.columns.size(); ++k) c.columns[k].push_back(row[k]);
  }
  return c;
}

// A load over a travel, as bending and the Brazilian test give it; the two platens disagree.
Curve load_over_travel(double stiffness) {
  Curve c;
  c.names = {"displacement", "force_top", "force_bottom"};
  c.units = {"m", "N", "N"};
  c.columns.resize(3);
  for (int i = 0; i <= 100; ++i) {
    const double u = 1e-6 * i, force = stiffness * u;
    c.columns[0].push_back(u);
    c.columns[1].push_back(0.9 * force);
    c.columns[2].push_back(1.1 * force);
  }
  return c;
}

double row(const Curve &curve, const std::string &name) {
  const auto quantities = quantities_of(curve.names, {});
  const auto rows = rows_of_curve(curve, quantities, TestDefinition(), {});
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i].name == name) return rows(static_cast<Eigen::Index>(i));
  ADD_FAILURE() << "no row " << name;
  return 0;
}

// A short specimen whose loaded corner is not where the gauges are: they hardly move, or go back.
TEST(CurveRows, AGaugeThatHardlyMovesWhileTheLoadClimbsHasNoToe) {
  Curve curve = straight(true);
  EXPECT_GT(row(curve, "gauge strain to 0.2"), 0);
  for (const double moved : {0.02, -0.5}) {
    Curve other = curve;
    auto &gauge = other.columns[3];
    const auto &load = other.columns[1];
    // From 0.25 of the peak on the gauges go on by this share of what they did.
    for (std::size_t i = 1; i < gauge.size(); ++i) {
      const double step = curve.columns[3][i] - curve.columns[3][i - 1];
      gauge[i] = gauge[i - 1] + (load[i] > 0.25 * strength ? moved : 1) * step;
    }
    EXPECT_TRUE(std::isnan(row(other, "gauge strain to 0.2"))) << moved;
    EXPECT_GT(row(other, "platen strain to 0.2"), 0);
  }
}

TEST(CurveRows, ACompressionWithAllGaugesHasEachPartOnce) {
  const auto quantities = quantities_of(straight(true).names, {"E"});
  std::map<P, std::vector<std::string>> by_part;
  for (const auto &q : quantities) by_part[q.part].push_back(q.name);
  const std::map<P, std::vector<std::string>> expected = {
      {P::toe, {"platen strain to 0.2", "gauge strain to 0.2"}},
      {P::slope,
       {"platen compliance 0.3 to 0.6", "gauge compliance 0.3 to 0.6",
        "Poisson's ratio 0.3 to 0.6"}},
      {P::pre_peak, {"platen compliance 0.6 to 0.9"}},
      {P::peak, {"log peak"}},
      {P::post_peak, {"fall to 0.8", "residual load"}}};
  EXPECT_EQ(by_part, expected);
}

TEST(CurveRows, AreTheClosedFormOfAStraightCurve) {
  const Curve c = straight(true);
  EXPECT_NEAR(row(c, "log peak"), std::log(strength), 1e-12);
  EXPECT_NEAR(row(c, "gauge compliance 0.3 to 0.6"), -std::log(modulus), 1e-9);
  EXPECT_NEAR(row(c, "Poisson's ratio 0.3 to 0.6"), nu, 1e-9);
  for (const std::string part : {"0.3 to 0.6", "0.6 to 0.9"})
    EXPECT_NEAR(row(c, "platen compliance " + part), std::log(softer / modulus), 1e-9);
  EXPECT_NEAR(row(c, "gauge strain to 0.2"), 0.2 / 0.3, 1e-9);
  const double slope = 0.3 * softer * strength / modulus;
  EXPECT_NEAR(row(c, "platen strain to 0.2"), 0.2 / 0.3 + seating / slope, 1e-9);
  // 0.8 of the peak is reached a fifth down the fall.
  const double whole = softer * strength / modulus;
  EXPECT_NEAR(row(c, "fall to 0.8"), std::log(0.01 + 0.2 * way_down * whole / (whole + seating)),
              1e-9);
}

TEST(CurveRows, AWrongConversionMovesOnlyTheRowsThatHaveALoadInThem) {
  const Curve before = straight(true);
  Curve after = before;
  scale_loads(after, 1.07);
  for (const auto &q : quantities_of(before.names, {})) {
    if (std::isnan(row(before, q.name))) continue;  // not this test's
    const bool compliance = q.name.find("compliance") != std::string::npos;
    const double change = q.name == "log peak" ? std::log(1.07) : compliance ? -std::log(1.07) : 0;
    EXPECT_NEAR(row(after, q.name) - row(before, q.name), change, 1e-9) << q.name;
  }
}

TEST(CurveRows, ACurveThatEndsBeforeItsLoadHasFallenHasNoFall) {
  EXPECT_TRUE(std::isnan(row(straight(false), "fall to 0.8")));
  EXPECT_NEAR(row(straight(false), "log peak"), std::log(strength), 1e-12);
  Curve cut = straight(true);
  for (auto &column : cut.columns) column.resize(201 + 15);  // at 0.85 of the peak
  EXPECT_TRUE(std::isnan(row(cut, "fall to 0.8")));
}

TEST(CurveRows, ALoadOverATravelUsesTheMeanOfBothPlatens) {
  const Curve c = load_over_travel(3e7);
  EXPECT_NEAR(row(c, "log peak"), std::log(3e7 * 1e-4), 1e-9);
  EXPECT_NEAR(row(c, "platen compliance 0.6 to 0.9"), -std::log(3e7), 1e-9);
}

TEST(CurveRows, WithoutLoadOrTravelTheLogarithmsOfTheResponsesStand) {
  TestDefinition test;
  test.responses["UCS"] = {"UCS", "Pa", "uniaxial.peak_stress", {}};
  const auto quantities = quantities_of({"time", "axial_stress"}, {"UCS"});
  ASSERT_EQ(quantities.size(), 1u);
  EXPECT_EQ(quantities[0].name, "response UCS");
  const auto rows = rows_of_curve(straight(true), quantities, test, {});
  EXPECT_NEAR(rows(0), std::log(strength), 1e-9);
  Curve other;  // a column the response needs is missing
  other.names = {"time"}, other.units = {"s"}, other.columns = {{0, 1, 2}};
  EXPECT_TRUE(std::isnan(rows_of_curve(other, quantities, test, {})(0)));
}

TEST(CurveRows, ARunThatNeverCarriedALoadHasNone) {
  Curve c = straight(true);
  for (double &v : c.columns[1]) v = 0;
  const auto quantities = quantities_of(c.names, {});
  const auto rows = rows_of_curve(c, quantities, TestDefinition(), {});
  for (Eigen::Index i = 0; i < rows.size(); ++i) EXPECT_TRUE(std::isnan(rows(i)));
}

// Load up to 25 MPa with an unloading at 20 MPa, a relaxation and a creep at 25 MPa, then to a peak
// at 50 MPa. Unloading is `stiffer` than loading.
constexpr double stiffer = 1.25, relaxed = 0.08, crept = 0.12;

Curve programme() {
  Curve c;
  c.names = {"time", "axial_stress", "strain_axial", "strain_machine", "phase"};
  c.units = {"s", "Pa", "1", "1", "1"};
  c.columns.resize(c.names.size());
  double stress = 0, strain = 0;
  const auto go = [&](double to, double slope, int phase, double creep, int steps) {
    const double from = stress, start = strain;
    for (int i = 1; i <= steps; ++i) {
      stress = from + (to - from) * i / steps;
      strain = start + (to - from) * i / steps / slope + creep * i / steps;
      const double row[] = {1e-5 * static_cast<double>(c.columns[0].size()), stress, strain,
                            2 * strain, double(phase)};
      for (std::size_t k = 0; k < c.columns.size(); ++k) c.columns[k].push_back(row[k]);
    }
  };
  const double E = modulus;
  c.columns = {{0}, {0}, {0}, {0}, {0}};
  go(20e6, E, 0, 0, 100);
  go(2e6, stiffer * E, 4, 0, 90);
  go(20e6, stiffer * E, 0, 0, 90);
  go(25e6, E, 0, 0, 25);
  go(25e6 * (1 - relaxed), 1e30, 2, 0, 100);
  go(25e6, E, 0, 0, 20);
  go(25e6, E, 3, crept * 25e6 / E, 100);
  go(50e6, E, 0, 0, 100);
  go(10e6, -E, 0, 0, 100);
  return c;
}

TEST(CurveRows, AProgrammeGivesItsHoldsAndItsUnloading) {
  const Curve c = programme();
  EXPECT_NEAR(row(c, "compliance to the first turn"), -std::log(modulus), 1e-9);
  EXPECT_NEAR(row(c, "unloading stiffness over loading"), std::log(stiffer), 1e-6);
  // Between 0.2 and 0.8 of the way down, 16.4 and 5.6 MPa, on the line down from 20 MPa.
  const double down = 20e6 / modulus - 14.4e6 / (stiffer * modulus), up = 5.6e6 / modulus;
  EXPECT_NEAR(row(c, "strain left after unloading"), (down - up) / (20e6 / modulus), 0.02);
  // Means over the first and the last tenth.
  EXPECT_NEAR(row(c, "load fallen in a hold"), 0.9 * relaxed, 0.002);
  EXPECT_GT(row(c, "strain gained in a hold"), 0.7 * crept);
  EXPECT_LT(row(c, "strain gained in a hold"), 0.9 * crept);
}

TEST(CurveRows, AProgrammeHasNoRowsThatItsTurnsWouldSpoil) {
  const Curve c = programme();
  for (const std::string name : {"gauge compliance 0.3 to 0.6", "machine strain to 0.2",
                                 "machine fall to 0.8", "gauge strain to 0.2"})
    EXPECT_TRUE(std::isnan(row(c, name))) << name;
  EXPECT_NEAR(row(c, "log peak"), std::log(50e6), 1e-12);
}

TEST(CurveRows, ACurveWithoutTurnsHasNoRowsOfAProgramme) {
  Curve c = straight(true);
  c.names.push_back("phase"), c.units.push_back("1");
  c.columns.push_back(std::vector<double>(c.rows(), 0.0));
  for (int i = 0; i < 5; ++i) c.columns.back()[static_cast<std::size_t>(i)] = 2;  // set up, no load
  EXPECT_TRUE(std::isnan(row(c, "strain gained in a hold")));
  EXPECT_TRUE(std::isnan(row(c, "compliance to the first turn")));
  EXPECT_NEAR(row(c, "gauge compliance 0.3 to 0.6"), -std::log(modulus), 1e-9);
}

TEST(CurveRows, TheMachinesTravelStandsForThePlatensWhereItIsMeasured) {
  Curve c = straight(true);
  c.names.push_back("strain_machine"), c.units.push_back("1");
  c.columns.push_back(c.column("strain_platen"));
  for (std::size_t i = 0; i < c.rows(); ++i)
    c.columns.back()[i] += 1e-12 * c.column("axial_stress")[i];  // a frame in series
  for (const auto &q : quantities_of(c.names, {}))
    EXPECT_TRUE(q.name.rfind("platen", 0) != 0) << q.name;
  EXPECT_NEAR(row(c, "machine compliance 0.3 to 0.6"), std::log(softer / modulus + 1e-12), 1e-9);
}

TEST(CurveRows, ABeamsDeflectionIsItsGauge) {
  Curve c = load_over_travel(3e7);
  c.names.push_back("deflection"), c.units.push_back("m");
  c.columns.push_back(c.column("displacement"));
  for (double &v : c.columns.back()) v *= 0.5;
  EXPECT_NEAR(row(c, "gauge compliance 0.3 to 0.6"), -std::log(6e7), 1e-9);
}

TEST(CurveRows, ATestThatGoesOnHasAResidualLoadAndOneWithALateralCellASideForce) {
  Curve c;
  c.names = {"displacement", "force_top", "side_force"};
  c.units = {"m", "N", "N"};
  c.columns.resize(3);
  for (int i = 0; i <= 300; ++i) {
    const double force = i <= 100 ? i : 40;
    const double row[] = {1e-6 * i, force, 0.03 * force};
    for (std::size_t k = 0; k < 3; ++k) c.columns[k].push_back(row[k]);
  }
  EXPECT_NEAR(row(c, "residual load"), 0.4, 1e-9);
  EXPECT_NEAR(row(c, "side force 0.3 to 0.6"), 0.03, 1e-9);
  for (auto &column : c.columns) column.resize(190);  // at 1.9 times the way to the peak
  EXPECT_TRUE(std::isnan(row(c, "residual load")));
}

}  // namespace
}  // namespace bondlab::diagnose
