// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/units.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace bondlab {
namespace {

std::string message(const std::string &text, const std::string &expected) {
  try {
    parse_quantity(text, expected);
  } catch (const UnitError &error) {
    return error.what();
  }
  return "accepted";
}

TEST(Units, EveryNamedUnitHasItsSiValue) {
  const struct {
    const char *text, *unit;
    double si;
  } cases[] = {{"41.5 GPa", "Pa", 41.5e9},
               {"9.5 MPa", "Pa", 9.5e6},
               {"3 kPa", "Pa", 3e3},
               {"0.66 mm", "m", 0.00066},
               {"5 um", "m", 5e-6},
               {"2 cm", "m", 0.02},
               {"120 s", "s", 120},
               {"2 ms", "s", 0.002},
               {"7 us", "s", 7e-6},
               {"2 min", "s", 120},
               {"1.5 h", "s", 5400},
               {"3 kg", "kg", 3},
               {"3 g", "kg", 0.003},
               {"2 kN", "N", 2000},
               {"2622 kg/m3", "kg/m3", 2622},
               {"2.622 g/cm3", "kg/m3", 2622},
               {"0.1 m/s", "m/s", 0.1},
               {"5 mm/s", "m/s", 0.005},
               {"6 mm/min", "m/s", 1e-4},
               {"0.5", "1", 0.5},
               {"3 %", "1", 0.03},
               {"300 K", "K", 300},
               {"20 degC", "K", 293.15},
               {"-10 degC", "K", 263.15},
               {"2 rad", "rad", 2},
               {"1e-5 1/s", "1/s", 1e-5},
               {"4 J", "J", 4},
               {"1 kN*m", "J", 1000},
               {"1.5 MPa m0.5", "Pa m0.5", 1.5e6},
               {"4 GPa/m", "N/m3", 4e9},
               {"41.5GPa", "Pa", 41.5e9},
               {" +2 mm ", "m", 0.002},
               {"1e9Pa", "Pa", 1e9}};
  for (const auto &c : cases) EXPECT_DOUBLE_EQ(parse_quantity(c.text, c.unit), c.si) << c.text;
  EXPECT_DOUBLE_EQ(parse_quantity("180 deg", "rad"), std::acos(-1.0));
}

TEST(Units, DecimalPrefixesRoundOnlyOnce) {
  EXPECT_EQ(parse_quantity("0.66 mm", "m"), 0.00066);
  EXPECT_EQ(parse_quantity("3 %", "1"), 0.03);
  EXPECT_EQ(parse_quantity("0.37 um", "m"), 0.37e-6);
  EXPECT_EQ(canonical_number(parse_quantity("0.66 mm", "m")), "0.00066");
}

TEST(Units, TheExpectedUnitMayBeAnyOfTheSameDimension) {
  EXPECT_EQ(parse_quantity("1 MPa", "GPa"), 1e6);
  EXPECT_TRUE(same_dimension("J", "N m"));
  EXPECT_FALSE(same_dimension("J", "rad"));
  EXPECT_TRUE(is_dimensionless("mm/m"));
}

TEST(Units, ADifferenceHasNoOffset) {
  EXPECT_EQ(parse_difference("2 degC", "K"), 2);
  EXPECT_EQ(parse_difference("1.2 GPa", "Pa"), 1.2e9);
}

TEST(Units, WrongDimensionNamesTheUnitsAllowed) {
  EXPECT_EQ(message("5 mm", "Pa"), "'5 mm' has the unit 'mm'; allowed here: Pa, kPa, MPa, GPa");
  EXPECT_EQ(message("5", "Pa"), "'5' has no unit; allowed here: Pa, kPa, MPa, GPa");
  EXPECT_EQ(message("30 deg", "1"), "'30 deg' has the unit 'deg'; allowed here: 1, %");
}

TEST(Units, UnknownUnitSuggestsTheNearest) {
  EXPECT_NE(message("5 Gpa", "Pa").find("unknown unit 'Gpa' (did you mean 'GPa'?)"),
            std::string::npos);
  EXPECT_NE(message("5 furlong", "m").find("unknown unit 'furlong'; known: 1, %, m, cm"),
            std::string::npos);
}

TEST(Units, MalformedQuantitiesAreRefused) {
  for (const char *text :
       {"", "  ", "GPa", "1,5 GPa", "1_000 Pa", "nan Pa", "inf Pa", "1e999 Pa", "1/s", "5 m/",
        "5 m//s", "5 m0.3", "5 m^", "5 J/kg K", "5 degC/s", "5 m99", "0x10 m", "5 $"})
    EXPECT_THROW(parse_unit(split_quantity(text).unit), UnitError) << text;
}

TEST(Units, CanonicalNumberReadsBackToTheSameBits) {
  RandomStream random(5);
  for (int i = 0; i < 2000; ++i) {
    const double value = std::ldexp(random.normal(), static_cast<int>(random.index(200)) - 100);
    EXPECT_EQ(std::stod(canonical_number(value)), value);
  }
  EXPECT_EQ(canonical_number(-0.0), "0");
  EXPECT_EQ(canonical_number(0.1), "0.1");
}

TEST(Units, ReadableUnitAvoidsLongNumbers) {
  EXPECT_EQ(readable_unit(4.1e10, "Pa"), "GPa");
  EXPECT_EQ(readable_unit(9.5e6, "Pa"), "MPa");
  EXPECT_EQ(readable_unit(0.00066, "m"), "mm");
  EXPECT_EQ(readable_unit(0, "Pa"), "Pa");
  EXPECT_EQ(readable_unit(0.23, "1"), "1");
  EXPECT_EQ(readable_unit(5e4, "1"), "1");
}

TEST(Units, FormattingIsTheInverseOfReading) {
  EXPECT_EQ(format_quantity(41.5e9, "GPa"), "41.5 GPa");
  EXPECT_EQ(format_quantity(293.15, "degC"), "20 degC");
  EXPECT_EQ(format_quantity(0.03, "%"), "3 %");
  EXPECT_EQ(format_quantity(0.23, "1"), "0.23");
}

}  // namespace
}  // namespace bondlab
