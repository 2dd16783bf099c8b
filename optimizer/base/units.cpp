// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/units.h"

#include <charconv>
#include <cmath>

namespace bondlab {

namespace {

struct NamedUnit {
  const char *name;
  double multiply, divide,
      offset;  // two whole numbers, so that "0.66 mm" is the double nearest to 0.00066
  double kg, m, s, K, rad;
};

constexpr double kPi = 3.14159265358979323846;

const NamedUnit kNamed[] = {
    {"1", 1, 1, 0, 0, 0, 0, 0, 0},        {"%", 1, 100, 0, 0, 0, 0, 0, 0},
    {"m", 1, 1, 0, 0, 1, 0, 0, 0},        {"cm", 1, 100, 0, 0, 1, 0, 0, 0},
    {"mm", 1, 1000, 0, 0, 1, 0, 0, 0},    {"um", 1, 1e6, 0, 0, 1, 0, 0, 0},
    {"s", 1, 1, 0, 0, 0, 1, 0, 0},        {"ms", 1, 1000, 0, 0, 0, 1, 0, 0},
    {"us", 1, 1e6, 0, 0, 0, 1, 0, 0},     {"min", 60, 1, 0, 0, 0, 1, 0, 0},
    {"h", 3600, 1, 0, 0, 0, 1, 0, 0},     {"kg", 1, 1, 0, 1, 0, 0, 0, 0},
    {"g", 1, 1000, 0, 1, 0, 0, 0, 0},     {"N", 1, 1, 0, 1, 1, -2, 0, 0},
    {"kN", 1000, 1, 0, 1, 1, -2, 0, 0},   {"Pa", 1, 1, 0, 1, -1, -2, 0, 0},
    {"kPa", 1000, 1, 0, 1, -1, -2, 0, 0}, {"MPa", 1e6, 1, 0, 1, -1, -2, 0, 0},
    {"GPa", 1e9, 1, 0, 1, -1, -2, 0, 0},  {"J", 1, 1, 0, 1, 2, -2, 0, 0},
    {"K", 1, 1, 0, 0, 0, 0, 1, 0},        {"degC", 1, 1, 273.15, 0, 0, 0, 1, 0},
    {"rad", 1, 1, 0, 0, 0, 0, 0, 1},      {"deg", kPi, 180, 0, 0, 0, 0, 0, 1}};

// What to offer in a message; products that have no name of their own.
const char *const kOffered[] = {
    "1",   "%",   "m",    "cm",   "mm",    "um",    "s",       "ms",       "us",     "min",  "h",
    "kg",  "g",   "N",    "kN",   "Pa",    "kPa",   "MPa",     "GPa",      "J",      "K",    "degC",
    "rad", "deg", "m2",   "mm2",  "kg/m3", "g/cm3", "m/s",     "mm/s",     "mm/min", "m/s2", "1/s",
    "1/h", "N/m", "kN/m", "J/m2", "Pa/m",  "GPa/m", "Pa m0.5", "MPa m0.5", "1/K",    "Pa s"};

const NamedUnit *find_unit(const std::string &name) {
  for (const NamedUnit &unit : kNamed)
    if (name == unit.name) return &unit;
  return nullptr;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const NamedUnit &unit : kNamed) names.emplace_back(unit.name);
  return names;
}

bool is_name_char(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Reads one term, a name with an optional exponent ("m3", "m0.5", "s^-1"), at `at`, and multiplies
// it into `unit`.
void multiply_term(const std::string &text, std::size_t &at, double sign, Unit &unit,
                   int &terms_with_offset) {
  std::size_t end = at;
  if (text[end] == '1')
    ++end;
  else
    while (end < text.size() && is_name_char(text[end])) ++end;
  const std::string name = text.substr(at, end - at);
  const NamedUnit *named = find_unit(name);
  if (name.empty()) throw UnitError("'" + text + "' isn't a unit; known: " + join(all_names()));
  if (!named) {
    const std::string near = nearest_word(name, all_names());
    throw UnitError("unknown unit '" + name + "'" +
                    (near.empty() ? "" : " (did you mean '" + near + "'?)") +
                    "; known: " + join(all_names()) + " and products of them such as kg/m3, 1/s");
  }
  at = end;
  double power = 1;
  if (name != "1" && at < text.size() &&
      (text[at] == '^' || text[at] == '-' || is_digit(text[at]))) {
    if (text[at] == '^') ++at;
    const char *first = text.data() + at;
    const auto [last, status] =
        std::from_chars(first, text.data() + text.size(), power, std::chars_format::fixed);
    if (status != std::errc() || power * 2 != std::round(power * 2) || std::abs(power) > 12)
      throw UnitError("the exponent after '" + name + "' in '" + text +
                      "' must be a whole or half number");
    at += static_cast<std::size_t>(last - first);
  }
  power *= sign;
  if (named->offset != 0) ++terms_with_offset;
  const double over = std::pow(named->multiply, std::abs(power)),
               under = std::pow(named->divide, std::abs(power));
  unit.multiply *= power > 0 ? over : under;
  unit.divide *= power > 0 ? under : over;
  unit.offset = named->offset;
  const double exponent[5] = {named->kg, named->m, named->s, named->K, named->rad};
  for (int i = 0; i < 5; ++i) unit.dimension.exponent[i] += power * exponent[i];
}

double to_number(const std::string &text, const std::string &expected_unit, bool with_offset) {
  const Unit expected = parse_unit(expected_unit);
  const Quantity quantity = split_quantity(text);
  const Unit unit = parse_unit(quantity.unit.empty() ? "1" : quantity.unit);
  if (unit.dimension != expected.dimension) {
    const std::string given =
        quantity.unit.empty() ? "has no unit" : "has the unit '" + quantity.unit + "'";
    throw UnitError("'" + text + "' " + given +
                    "; allowed here: " + join(allowed_units(expected_unit)));
  }
  return quantity.number * unit.multiply / unit.divide + (with_offset ? unit.offset : 0);
}

}  // namespace

Unit parse_unit(const std::string &text) {
  Unit unit;
  std::size_t at = 0;
  int terms = 0, terms_with_offset = 0;
  bool divide = false, divided = false;
  while (at < text.size()) {
    const char c = text[at];
    if (c == ' ' || c == '*') {
      ++at;
    } else if (c == '/') {
      if (divide || terms == 0)
        throw UnitError("'" + text + "' isn't a unit: a name is missing before '/'");
      divide = divided = true;
      ++at;
    } else {
      if (divided && !divide)
        throw UnitError("the unit '" + text +
                        "' can be read in two ways; write every divisor with its own '/', last");
      multiply_term(text, at, divide ? -1 : 1, unit, terms_with_offset);
      divide = false;
      ++terms;
    }
  }
  if (terms == 0 || divide)
    throw UnitError("'" + text + "' isn't a unit; known: " + join(all_names()));
  if (terms_with_offset > 0 && terms > 1)
    throw UnitError("degC has a zero of its own and can't stand in the product '" + text +
                    "'; use K there");
  return unit;
}

Quantity split_quantity(const std::string &text) {
  std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos)
    throw UnitError("a number with a unit is expected, the text is empty");
  const std::size_t end = text.find_last_not_of(" \t") + 1;
  if (text[begin] == '+') ++begin;
  Quantity quantity;
  const auto [last, status] =
      std::from_chars(text.data() + begin, text.data() + end, quantity.number);
  if (status == std::errc::result_out_of_range)
    throw UnitError("the number in '" + text + "' is out of range");
  if (status != std::errc())
    throw UnitError("'" + text + "' doesn't begin with a number; write for example \"41.5 GPa\"");
  if (!std::isfinite(quantity.number)) throw UnitError("'" + text + "' isn't a finite number");
  std::size_t unit_begin = static_cast<std::size_t>(last - text.data());
  if (unit_begin < end && (text[unit_begin] == ',' || text[unit_begin] == '_'))
    throw UnitError("'" + text + "': write the number with a decimal point and without separators");
  while (unit_begin < end && (text[unit_begin] == ' ' || text[unit_begin] == '\t')) ++unit_begin;
  quantity.unit = text.substr(unit_begin, end - unit_begin);
  if (!quantity.unit.empty() && quantity.unit[0] == '/')
    throw UnitError("'" + text + "' has no number before the unit; write for example \"5 1/s\"");
  return quantity;
}

double parse_quantity(const std::string &text, const std::string &expected_unit) {
  return to_number(text, expected_unit, true);
}

double parse_difference(const std::string &text, const std::string &expected_unit) {
  return to_number(text, expected_unit, false);
}

double to_si(double value, const std::string &unit) {
  const Unit u = parse_unit(unit);
  return value * u.multiply / u.divide + u.offset;
}

double from_si(double si, const std::string &unit) {
  const Unit u = parse_unit(unit);
  return (si - u.offset) * u.divide / u.multiply;
}

bool same_dimension(const std::string &unit_a, const std::string &unit_b) {
  return parse_unit(unit_a).dimension == parse_unit(unit_b).dimension;
}

bool is_dimensionless(const std::string &unit) { return parse_unit(unit).dimension == Dimension{}; }

std::vector<std::string> allowed_units(const std::string &unit) {
  const Dimension dimension = parse_unit(unit).dimension;
  std::vector<std::string> names;
  for (const char *name : kOffered)
    if (parse_unit(name).dimension == dimension) names.emplace_back(name);
  if (names.empty()) names.push_back(unit);
  return names;
}

std::string canonical_number(double value) {
  if (value == 0) value = 0;  // no minus sign on zero: it would make two keys of one value
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, result.ptr);
}

std::string readable_unit(double si, const std::string &unit) {
  const Unit given = parse_unit(unit);
  if (given.dimension == Dimension{} || given.offset != 0) return unit;
  if (si == 0) return unit;
  std::string best = unit;
  double best_distance = HUGE_VAL;  // in decades from 10: two digits before the point read best
  for (const std::string &name : allowed_units(unit)) {
    if (parse_unit(name).offset != 0) continue;
    const double distance = std::abs(std::log10(std::abs(from_si(si, name))) - 1);
    if (distance >= best_distance) continue;
    best = name;
    best_distance = distance;
  }
  return best;
}

std::string format_quantity(double si, const std::string &unit, int digits) {
  char buffer[64];
  const double value = unit.empty() ? si : from_si(si, unit);
  const auto result =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  std::string text(buffer, result.ptr);
  if (!unit.empty() && unit != "1") text += " " + unit;
  return text;
}

}  // namespace bondlab
