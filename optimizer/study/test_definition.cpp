// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/test_definition.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "base/table_file.h"
#include "base/units.h"
#include "study/toml_table.h"

namespace bondlab {

namespace {

// Every `variable NAME index DEFAULT` of a deck. Without a default LIGGGHTS itself refuses the
// line.
std::map<std::string, std::string> index_variables(const std::string &deck) {
  std::map<std::string, std::string> defaults;
  std::istringstream lines(deck);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string command, name, style, value;
    if (words >> command >> name >> style >> value && command == "variable" && style == "index") {
      if (value.size() > 1 && (value.front() == '"' || value.front() == '\'') &&
          value.back() == value.front())
        value = value.substr(1, value.size() - 2);
      defaults.emplace(name, value);  // the engine keeps the first
    }
  }
  return defaults;
}

DeckVariable read_variable(const std::string &name, TomlTable table) {
  DeckVariable variable;
  variable.name = name;
  variable.place = table.place();
  variable.description = table.text("description");
  variable.choices = table.words("choices");
  if (variable.choices.empty()) {
    const std::optional<std::string> unit = read_unit(table, true);
    variable.unit = unit.value_or("");
    variable.minimum = table.limit_if(unit, "minimum");
    variable.at_least = table.limit_if(unit, "at_least");
    variable.maximum = table.limit_if(unit, "maximum");
    if (variable.minimum && variable.maximum && *variable.minimum >= *variable.maximum)
      table.error("maximum", "'maximum' must be above 'minimum'");
  }
  table.finish();
  return variable;
}

}  // namespace

const std::vector<std::string> &variables_from_specimen() {
  static const std::vector<std::string> names{"specimen", "width", "height", "diameter",
                                              "length",   "notch_depth", "notch_width",
                                              "thickness"};
  return names;
}

TestDefinition read_test_definition(const std::filesystem::path &folder, ErrorCollector &errors) {
  TestDefinition definition;
  definition.folder = std::filesystem::absolute(folder).lexically_normal();
  const std::string file = (definition.folder / "test.toml").string();
  toml::table root;
  try {
    root = parse_toml(read_text_file(file), file);
  } catch (const UserError &error) {
    errors.add(error);
    return definition;
  }
  TomlTable top(root, "a test.toml", file, errors);

  if (const toml::table *table = top.table("test", true)) {
    TomlTable test(*table, "[test]", file, errors);
    definition.name = test.text("name", true);
    definition.description = test.text("description");
    definition.shapes = test.words("shapes");
    const std::string deck = test.text("deck", true);
    definition.deck = definition.folder / deck;
    if (!deck.empty()) {
      try {
        definition.deck_defaults = index_variables(read_text_file(definition.deck));
      } catch (const UserError &error) {
        test.error("deck", "the deck '" + deck + "' can't be read: " + error.text());
      }
    }
    test.finish();
  }

  if (const toml::table *table = top.table("variables", true)) {
    TomlTable variables(*table, "[variables]", file, errors);
    for (const auto &[name, node] : variables.entries()) {
      if (!node->is_table()) {
        errors.add(variables.place_of(*node), "variable '" + name +
                                                  "' must be a table: [variables." + name +
                                                  "] with unit = \"...\"");
        continue;
      }
      const auto &reserved = variables_from_specimen();
      if (std::find(reserved.begin(), reserved.end(), name) != reserved.end())
        errors.add(variables.key_place(name),
                   "'" + name + "' is filled in from the specimen and can't be declared here");
      else if (!definition.deck_defaults.empty() && !definition.deck_defaults.count(name))
        errors.add(variables.key_place(name),
                   "the deck has no line 'variable " + name + " index ...'");
      TomlTable variable(*node->as_table(), "[variables." + name + "]", file, errors);
      definition.variables[name] = read_variable(name, variable);
      definition.variables[name].place = variables.key_place(name);
      const auto default_value = definition.deck_defaults.find(name);
      if (default_value != definition.deck_defaults.end())
        definition.variables[name].default_text = default_value->second;
    }
  }

  if (const toml::table *table = top.table("outputs")) {
    TomlTable outputs(*table, "[outputs]", file, errors);
    if (outputs.has("curve")) definition.curve = outputs.text("curve", true);
    definition.columns = outputs.words("columns");
    definition.keep = outputs.words("keep");
    if (outputs.has("events")) definition.events = outputs.text("events");
    if (outputs.has("particles")) definition.particles = outputs.text("particles");
    outputs.finish();
  }

  if (const toml::table *table = top.table("responses", true)) {
    TomlTable responses(*table, "[responses]", file, errors);
    for (const auto &[name, node] : responses.entries()) {
      if (!node->is_table()) {
        errors.add(
            responses.place_of(*node),
            "response '" + name + "' must be a table: [responses." + name + "] with unit and from");
        continue;
      }
      TomlTable response(*node->as_table(), "[responses." + name + "]", file, errors);
      ResponseDefinition entry;
      entry.name = name;
      entry.unit = read_unit(response, true).value_or("");
      entry.function = response.text("from", true);
      entry.place = response.has("from") ? response.place("from") : response.place();
      response.text("description");
      response.finish();
      definition.responses[name] = entry;
    }
  }
  top.finish();
  return definition;
}

double deck_number(const DeckVariable &variable, double value) {
  const double exact = from_si(value, variable.unit);
  // 30 deg went to SI and comes back as 29.999999999999996: fifteen digits are what the user wrote,
  // if they mean the same.
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, exact, std::chars_format::scientific, 14).ptr;
  double rounded = exact;
  std::from_chars(buffer, end, rounded);
  return to_si(rounded, variable.unit) == value ? rounded : exact;
}

std::string why_not_allowed(const DeckVariable &variable, double value) {
  if (!variable.choices.empty()) return "it takes a word: " + join(variable.choices);
  const auto shown = [&](double limit) { return format_quantity(limit, variable.unit, 6); };
  if (variable.minimum && value <= *variable.minimum)
    return "it must be above " + shown(*variable.minimum);
  if (variable.at_least && value < *variable.at_least)
    return "it must be at least " + shown(*variable.at_least);
  if (variable.maximum && value > *variable.maximum)
    return "it must be at most " + shown(*variable.maximum);
  return "";
}

}  // namespace bondlab
