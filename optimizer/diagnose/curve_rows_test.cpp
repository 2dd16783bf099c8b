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

TEST(CurveRows, ACompressionWithAllGaugesHasEachPartOnce) {
  const auto quantities = quantities_of(straight(true).names, {"E"});
  std::map<P, std::vector<std::string>> by_part;
  for (const auto &q : quantities) by_part[q.part].push_back(q.name);
  const std::map<P, std::vector<std::string>> expected = {
      {P::toe, {"platen strain to 0.2", "gauge strain to 0.2"}},
      {P::slope,
       {"platen compliance 0.3 to 0.6", "gauge compliance 0.3 to 0.6",
        "Poisson's ratio 0.3 to 0.6"}},
      {P::pre_peak, {"gauge compliance 0.6 to 0.9", "Poisson's ratio 0.6 to 0.9"}},
      {P::peak, {"log peak"}},
      {P::post_peak, {"fall to 0.8"}}};
  EXPECT_EQ(by_part, expected);
}

TEST(CurveRows, AreTheClosedFormOfAStraightCurve) {
  const Curve c = straight(true);
  EXPECT_NEAR(row(c, "log peak"), std::log(strength), 1e-12);
  for (const std::string part : {"0.3 to 0.6", "0.6 to 0.9"}) {
    EXPECT_NEAR(row(c, "gauge compliance " + part), -std::log(modulus), 1e-9);
    EXPECT_NEAR(row(c, "Poisson's ratio " + part), nu, 1e-9);
  }
  EXPECT_NEAR(row(c, "platen compliance 0.3 to 0.6"), std::log(softer / modulus), 1e-9);
  EXPECT_NEAR(row(c, "gauge strain to 0.2"), 0.2 / 0.3, 1e-9);
  const double slope = 0.3 * softer * strength / modulus;
  EXPECT_NEAR(row(c, "platen strain to 0.2"), 0.2 / 0.3 + seating / slope, 1e-9);
  // 0.8 of the peak is reached a fifth down the fall.
  const double whole = softer * strength / modulus;
  EXPECT_NEAR(row(c, "fall to 0.8"), 0.2 * way_down * whole / (whole + seating), 1e-9);
}

TEST(CurveRows, AWrongConversionMovesOnlyTheRowsThatHaveALoadInThem) {
  const Curve before = straight(true);
  Curve after = before;
  scale_loads(after, 1.07);
  for (const auto &q : quantities_of(before.names, {})) {
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

}  // namespace
}  // namespace bondlab::diagnose
