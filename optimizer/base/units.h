// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: turn what a user writes ("41.5 GPa", "0.1 m/s", "3 %") into a number in SI units of an
// expected dimension, and back. Method: a unit is a factor (as a quotient of whole numbers where it
// can be), an offset (degC only) and exponents of kg, m, s, K and angle; products, quotients and
// powers
//   of the known names are accepted ("kg/m3", "MPa m0.5", "N/m"). Angle has an exponent of its own
//   so that "30 deg" given for a friction coefficient is an error. A '/' divides by the one term
//   after it, and no product may follow a '/'
//   ("J/kg/K", not "J/kg K", which people read in two ways).
// Units: numbers inside BondLab are SI always; the unit text is only for reading and showing.
// Failure: UnitError (a UserError without a place; the reader that knows the place adds it) with
// the value given and the
//   units allowed. Limits: no electrical or chemical units; degC only alone, never inside a
//   product.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/user_error.h"

namespace bondlab {

class UnitError : public UserError {
 public:
  using UserError::UserError;
};

// Exponents of kg, m, s, K, rad; halves are exact in double (K_IC is in Pa m0.5).
struct Dimension {
  std::array<double, 5> exponent{};
  bool operator==(const Dimension &other) const { return exponent == other.exponent; }
  bool operator!=(const Dimension &other) const { return !(*this == other); }
};

struct Unit {
  double multiply = 1, divide = 1, offset = 0;  // value in SI = value * multiply / divide + offset
  Dimension dimension;
};

Unit parse_unit(const std::string &text);

// "41.5 GPa" -> 41.5e9 when `expected_unit` is any unit of pressure. A number without unit is
// accepted only where `expected_unit` is dimensionless.
double parse_quantity(const std::string &text, const std::string &expected_unit);

// The same for a difference (a standard deviation, a step): "2 degC" is 2 K.
double parse_difference(const std::string &text, const std::string &expected_unit);

// Number and unit apart, without judging the dimension: "3 %" -> {3, "%"}.
struct Quantity {
  double number = 0;
  std::string unit;  // "" when none was written
};
Quantity split_quantity(const std::string &text);

double to_si(double value, const std::string &unit);
double from_si(double si, const std::string &unit);
bool same_dimension(const std::string &unit_a, const std::string &unit_b);
bool is_dimensionless(const std::string &unit);

// The named units that may be written where `unit` is expected: "Pa", "kPa", "MPa", "GPa".
std::vector<std::string> allowed_units(const std::string &unit);

// Shortest text that reads back to the same bits, independent of the locale: what goes into decks
// and keys.
std::string canonical_number(double value);

// The named unit of the same dimension in which the number is easiest to read: 4.1e10 "Pa" ->
// "GPa". `unit` itself where nothing reads better.
std::string readable_unit(double si, const std::string &unit);

// "41.5 GPa" with `digits` significant digits, for reading by people.
std::string format_quantity(double si, const std::string &unit, int digits = 4);

}  // namespace bondlab
