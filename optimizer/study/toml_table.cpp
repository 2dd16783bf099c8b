// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/toml_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/units.h"

namespace bondlab {

static Place place_in(const std::string &file, const toml::source_region &source) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

toml::table parse_toml(const std::string &text, const std::string &file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error &error) {
    throw UserError(place_in(file, error.source()), std::string(error.description()));
  }
}

std::string kind_of(const toml::node &node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number with a decimal point";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

std::string shown(const toml::node &node) {
  if (node.is_string()) return "\"" + node.as_string()->get() + "\"";
  if (node.is_floating_point()) return canonical_number(node.as_floating_point()->get());
  if (node.is_integer()) return std::to_string(node.as_integer()->get());
  if (node.is_boolean()) return node.as_boolean()->get() ? "true" : "false";
  return kind_of(node);
}

std::optional<double> quantity_of(const toml::node &node, const std::string &unit,
                                  const Place &place, ErrorCollector &errors) {
  if (node.is_string()) {
    try {
      return parse_quantity(node.as_string()->get(), unit);
    } catch (const UnitError &error) {
      errors.add(place, error.text());
      return std::nullopt;
    }
  }
  if (node.is_number() && is_dimensionless(unit)) {
    const double value = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                           : node.as_floating_point()->get();
    if (std::isfinite(value)) return value;
    errors.add(place, shown(node) + " isn't a finite number");
    return std::nullopt;
  }
  const std::string units = join(allowed_units(unit));
  if (node.is_number())
    errors.add(place, shown(node) + " has no unit; write a string with one of: " + units);
  else
    errors.add(place, shown(node) + " isn't a quantity; write a string such as \"1 " + unit +
                          "\" with one of: " + units);
  return std::nullopt;
}

TomlTable::TomlTable(const toml::table &table, std::string what, std::string file,
                     ErrorCollector &errors)
    : table_(table), what_(std::move(what)), file_(std::move(file)), errors_(errors) {}

Place TomlTable::place() const { return place_in(file_, table_.source()); }

Place TomlTable::place_of(const toml::node &node) const { return place_in(file_, node.source()); }

Place TomlTable::place(const std::string &key) const {
  const toml::node *node = table_.get(key);
  return node ? place_of(*node) : place();
}

Place TomlTable::key_place(const std::string &key) const {
  const auto found = table_.find(key);
  return found == table_.end() ? place() : place_in(file_, found->first.source());
}

void TomlTable::error(const std::string &key, const std::string &text) {
  errors_.add(place(key), text);
}

void TomlTable::know(const std::string &key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
}

const toml::node *TomlTable::get(const std::string &key, bool required, const char *example) {
  know(key);
  const toml::node *node = table_.get(key);
  if (!node && required)
    errors_.add(place(),
                "'" + key + "' is missing in " + what_ + "; write " + key + " = " + example);
  return node;
}

std::string TomlTable::text(const std::string &key, bool required) {
  const toml::node *node = get(key, required, "\"...\"");
  if (!node) return {};
  if (!node->is_string()) {
    error(key, "'" + key + "' must be a string, " + shown(*node) + " is " + kind_of(*node));
    return {};
  }
  const std::string value = node->as_string()->get();
  if (required && value.find_first_not_of(" \t\n") == std::string::npos)
    error(key, "'" + key + "' is empty");
  return value;
}

std::string TomlTable::choice(const std::string &key, const std::vector<std::string> &allowed,
                              bool required) {
  if (!has(key)) {
    get(key, required, ("\"" + allowed.front() + "\"").c_str());
    return allowed.front();
  }
  const toml::node *node = get(key, required, "");
  if (node->is_string() &&
      std::find(allowed.begin(), allowed.end(), node->as_string()->get()) != allowed.end())
    return node->as_string()->get();
  error(key, "'" + key + "' can't be " + shown(*node) + "; allowed: " + join(allowed));
  return allowed.front();
}

long TomlTable::whole(const std::string &key, long fallback, long minimum, long maximum,
                      bool required) {
  const toml::node *node = get(key, required, std::to_string(fallback).c_str());
  if (!node) return fallback;
  if (!node->is_integer()) {
    error(key, "'" + key + "' must be a whole number, " + shown(*node) + " is " + kind_of(*node));
    return fallback;
  }
  const std::int64_t value = node->as_integer()->get();
  if (value >= minimum && value <= maximum) return static_cast<long>(value);
  error(key, "'" + key + "' can't be " + std::to_string(value) +
                 "; allowed: " + std::to_string(minimum) + " to " + std::to_string(maximum));
  return fallback;
}

std::optional<double> TomlTable::quantity(const std::string &key, const std::string &unit,
                                          bool required) {
  const toml::node *node = get(key, required, ("\"1 " + unit + "\"").c_str());
  if (!node) return std::nullopt;
  return quantity_of(*node, unit, place(key), errors_);
}

std::optional<double> TomlTable::quantity_if(const std::optional<std::string> &unit,
                                             const std::string &key, bool required) {
  if (unit) return quantity(key, *unit, required);
  know(key);
  return std::nullopt;
}

std::optional<double> TomlTable::limit_if(const std::optional<std::string> &unit,
                                          const std::string &key) {
  const toml::node *node = table_.get(key);
  if (unit && node && node->is_number()) {
    know(key);
    const double value = node->is_integer() ? static_cast<double>(node->as_integer()->get())
                                            : node->as_floating_point()->get();
    if (std::isfinite(value)) return to_si(value, *unit);
    error(key, "'" + key + "' can't be " + shown(*node) + "; leave it out where there is no limit");
    return std::nullopt;
  }
  return quantity_if(unit, key);
}

std::string TomlTable::given(const std::string &key) const {
  const toml::node *node = table_.get(key);
  return node ? shown(*node) : "nothing";
}

std::optional<std::string> read_unit(TomlTable &table, bool required) {
  const std::size_t before = table.errors().errors().size();
  const std::string unit = table.text("unit", required);
  if (table.errors().errors().size() > before) return std::nullopt;
  if (unit.empty()) return "1";
  try {
    parse_unit(unit);
  } catch (const UnitError &error) {
    table.error("unit", error.text());
    return std::nullopt;
  }
  return unit;
}

std::vector<std::string> TomlTable::words(const std::string &key, bool required) {
  const toml::node *node = get(key, required, "[\"...\"]");
  std::vector<std::string> list;
  if (!node) return list;
  if (!node->is_array()) {
    error(key,
          "'" + key + "' must be a list of strings, " + shown(*node) + " is " + kind_of(*node));
    return list;
  }
  for (const toml::node &entry : *node->as_array()) {
    if (entry.is_string())
      list.push_back(entry.as_string()->get());
    else
      errors_.add(place_of(entry), "'" + key + "' must be a list of strings, " + shown(entry) +
                                       " is " + kind_of(entry));
  }
  if (required && node->as_array()->empty()) error(key, "'" + key + "' is an empty list");
  return list;
}

const toml::table *TomlTable::table(const std::string &key, bool required) {
  know(key);
  const toml::node *node = table_.get(key);
  if (!node) {
    if (required) errors_.add(place(), "the table [" + key + "] is missing");
    return nullptr;
  }
  if (!node->is_table()) {
    error(key, "'" + key + "' must be a table, " + shown(*node) + " is " + kind_of(*node));
    return nullptr;
  }
  return node->as_table();
}

std::vector<const toml::table *> TomlTable::tables(const std::string &key, bool required) {
  know(key);
  std::vector<const toml::table *> list;
  const toml::node *node = table_.get(key);
  if (!node) {
    if (required) errors_.add(place(), "at least one [[" + key + "]] is needed");
    return list;
  }
  if (node->is_table()) {
    error(key, "write [[" + key + "]] with two brackets: there can be several");
    return list;
  }
  if (!node->is_array()) {
    error(key, "'" + key + "' must be written as [[" + key + "]], " + shown(*node) + " is " +
                   kind_of(*node));
    return list;
  }
  for (const toml::node &entry : *node->as_array()) {
    if (entry.is_table())
      list.push_back(entry.as_table());
    else
      errors_.add(place_of(entry), "every entry of '" + key + "' must be a table, " + shown(entry) +
                                       " is " + kind_of(entry));
  }
  if (required && node->as_array()->empty()) error(key, "at least one [[" + key + "]] is needed");
  return list;
}

std::vector<std::pair<std::string, const toml::node *>> TomlTable::entries() {
  std::vector<std::pair<std::string, const toml::node *>> list;
  for (auto &&[key, node] : table_) {
    list.emplace_back(std::string(key.str()), &node);
    know(std::string(key.str()));
  }
  return list;
}

void TomlTable::finish() {
  for (auto &&[key, node] : table_) {
    const std::string name(key.str());
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    const std::string near = nearest_word(name, known_);
    errors_.add(place_in(file_, key.source()),
                "unknown key '" + name + "' in " + what_ +
                    (near.empty() ? "" : " (did you mean '" + near + "'?)") +
                    "; known: " + join(known_));
  }
}

}  // namespace bondlab
