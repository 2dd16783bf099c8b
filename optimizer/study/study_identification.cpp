// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the sections of the study file that say what is identified: [[parameters]], [[targets]],
// [[fits]], [fit].
#include <algorithm>

#include "base/units.h"
#include "study/study_sections.h"

namespace bondlab {

namespace {

// Parameters by the deck variables they set, to find a variable that gets two values.
const Parameter *who_sets(const Study &study, const std::string &variable) {
  for (const Parameter &parameter : study.parameters)
    if (std::find(parameter.sets.begin(), parameter.sets.end(), variable) != parameter.sets.end())
      return &parameter;
  return nullptr;
}

// The places of a list's entries: the list's own when it was read from a default.
Place entry_place(TomlTable &table, const toml::table &entry, const std::string &key,
                  std::size_t index) {
  const toml::array *list = entry.get(key) ? entry.get(key)->as_array() : nullptr;
  return list && index < list->size() ? table.place_of(*list->get(index)) : table.place(key);
}

// Each deck variable a parameter sets: known to a test, free, of the parameter's dimension, its
// limits outside the bounds (judged only when the bounds are good in themselves).
void check_sets(TomlTable &table, const toml::table &entry, const Study &study,
                const Parameter &parameter, bool good_bounds) {
  bool bound_complained = false;
  for (std::size_t i = 0; i < parameter.sets.size(); ++i) {
    const std::string &name = parameter.sets[i];
    const Place place = entry_place(table, entry, "sets", i);
    ErrorCollector &errors = table.errors();
    if (std::count(parameter.sets.begin(), parameter.sets.begin() + static_cast<long>(i), name))
      errors.add(place, "'" + name + "' stands twice in 'sets'");
    if (const Parameter *other = who_sets(study, name))
      errors.add(place, "the deck variable '" + name + "' is set by the parameter '" + other->name +
                            "' already (line " + std::to_string(other->place.line) + ")");
    std::vector<std::string> known;
    bool found = false, complained = false, all_tests_read = true;
    for (const TestEntry &test : study.tests) {
      if (test.definition.variables.empty()) all_tests_read = false;
      for (const auto &[variable_name, variable] : test.definition.variables)
        known.push_back(variable_name);
      const auto declared = test.definition.variables.find(name);
      if (declared == test.definition.variables.end()) continue;
      found = true;
      if (complained) continue;  // once is enough: the other tests share the variable
      const DeckVariable &variable = declared->second;
      if (variable.unit.empty()) continue;  // reported in test.toml
      if (test.variables.count(name)) {
        errors.add(place, "the deck variable '" + name + "' is fixed in the test '" + test.name +
                              "' (line " + std::to_string(test.place.line) +
                              ") and can't be a parameter too");
        complained = true;
      } else if (!variable.choices.empty()) {
        errors.add(place, "the deck variable '" + name + "' takes a word (" +
                              join(variable.choices) + ") and can't be a parameter");
        complained = true;
      } else if (!same_dimension(variable.unit, parameter.unit)) {
        errors.add(table.place("unit"),
                   "the unit '" + parameter.unit + "' isn't one of the deck variable '" + name +
                       "'; allowed here: " + join(allowed_units(variable.unit)));
        complained = true;
      } else if (good_bounds && !bound_complained) {
        for (const auto &[key, bound] :
             {std::make_pair("lower", parameter.lower), std::make_pair("upper", parameter.upper)}) {
          const std::string why = table.has(key) ? why_not_allowed(variable, bound) : "";
          if (why.empty()) continue;
          table.error(key, "'" + std::string(key) + "' can't be " +
                               format_quantity(bound, parameter.unit, 6) +
                               " for the deck variable '" + name + "'; " + why);
          complained = bound_complained = true;
        }
      }
    }
    if (found || !all_tests_read) continue;
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    errors.add(place, "no test has a deck variable '" + name + "'" +
                          (nearest_word(name, known).empty()
                               ? ""
                               : " (did you mean '" + nearest_word(name, known) + "'?)") +
                          "; known: " + join(known));
  }
}

// False when something is wrong with them.
bool check_bounds(TomlTable &table, const Parameter &parameter) {
  const std::size_t before = table.errors().errors().size();
  const auto shown_value = [&](double value) { return format_quantity(value, parameter.unit, 6); };
  if (parameter.lower >= parameter.upper)
    table.error("lower",
                "the bounds are reversed or equal: lower = " + shown_value(parameter.lower) +
                    ", upper = " + shown_value(parameter.upper));
  for (const auto &[key, bound] :
       {std::make_pair("lower", parameter.lower), std::make_pair("upper", parameter.upper)})
    if (parameter.scale == Scale::logarithmic && bound <= 0)
      table.error(key, "'" + std::string(key) + "' can't be " + shown_value(bound) +
                           " with scale = \"log\"; it must be above 0");
  if (parameter.start &&
      (*parameter.start <= parameter.lower || *parameter.start >= parameter.upper) &&
      parameter.lower < parameter.upper)
    table.error("start", "'start' can't be " + shown_value(*parameter.start) +
                             "; it must lie between " + shown_value(parameter.lower) + " and " +
                             shown_value(parameter.upper));
  return table.errors().errors().size() == before;
}

}  // namespace

void read_parameters(TomlTable &top, Study &study) {
  for (const toml::table *entry : top.tables("parameters")) {
    TomlTable table(*entry, "[[parameters]]", top.file(), top.errors());
    Parameter parameter;
    parameter.place = table.place();
    parameter.name = read_name(table, study.parameters);
    const std::optional<std::string> unit = read_unit(table, true);
    parameter.unit = unit.value_or("1");
    const std::optional<double> lower = table.quantity_if(unit, "lower", true),
                                upper = table.quantity_if(unit, "upper", true);
    parameter.lower = lower.value_or(0);
    parameter.upper = upper.value_or(0);
    parameter.start = table.quantity_if(unit, "start");
    parameter.scale =
        table.choice("scale", {"linear", "log"}) == "log" ? Scale::logarithmic : Scale::linear;
    parameter.source = table.text("source");
    parameter.sets = table.words("sets", table.has("sets"));
    if (!table.has("sets")) parameter.sets = {parameter.name};
    table.finish();
    const bool good_bounds = lower && upper && check_bounds(table, parameter);
    if (unit) check_sets(table, *entry, study, parameter, good_bounds);
    study.parameters.push_back(parameter);
  }
}

namespace {

// The sd of a target: "3 %" is a share of the value, anything else a quantity of the value's
// dimension.
double read_sd(TomlTable &table, const toml::table &entry, const std::string &unit, double value) {
  const toml::node *node = entry.get("sd");
  if (!node) {
    table.text("sd");
    table.errors().add(
        table.place(),
        "'sd' is missing in [[targets]]; write sd = \"3 %\" of the value, or a quantity");
    return 1;
  }
  double sd = 0;
  bool relative = false;
  if (node->is_string()) {
    table.text("sd");
    try {
      const Quantity quantity = split_quantity(node->as_string()->get());
      relative = quantity.unit == "%";
      sd = relative ? quantity.number / 100 * std::abs(value)
                    : parse_difference(node->as_string()->get(), unit);
    } catch (const UnitError &error) {
      table.error("sd", error.text() + ", or a share of the value such as \"3 %\"");
      return 1;
    }
  } else {
    const std::optional<double> number = table.quantity("sd", unit);
    if (!number) return 1;
    sd = *number;
  }
  if (sd > 0) return sd;
  if (relative && value == 0)
    table.error("sd", "'sd' is a share of a value of 0; give it as a quantity");
  else
    table.error("sd", "'sd' can't be " + shown(*node) + "; it must be above 0");
  return 1;
}

// The unit a quantity was written with, to show results in; `fallback` for a bare number.
std::string unit_as_written(const toml::node *node, const std::string &fallback) {
  if (!node || !node->is_string()) return fallback;
  try {
    const Quantity quantity = split_quantity(node->as_string()->get());
    return quantity.unit.empty() ? fallback : quantity.unit;
  } catch (const UnitError &) {
    return fallback;
  }
}

}  // namespace

void read_targets(TomlTable &top, Study &study) {
  for (const toml::table *entry : top.tables("targets")) {
    TomlTable table(*entry, "[[targets]]", top.file(), top.errors());
    Target target;
    target.place = table.place();
    target.name = read_name(table, study.targets);
    std::string si_unit = read_figure_source(table, study, target);
    if (si_unit.empty())
      si_unit =
          unit_as_written(entry->get("value"), "1");  // unknown figure: judge what can be judged
    const std::optional<double> value = table.quantity("value", si_unit, true);
    target.value = value.value_or(1);
    target.unit = unit_as_written(entry->get("value"), si_unit);
    target.sd = read_sd(table, *entry, si_unit, target.value);
    target.source = table.text("source");
    target.sd_source = table.text("sd_source");
    table.finish();
    study.targets.push_back(target);
  }
}

void read_fits(TomlTable &top, Study &study) {
  for (const toml::table *entry : top.tables("fits")) {
    TomlTable table(*entry, "[[fits]]", top.file(), top.errors());
    FitEntry fit;
    fit.place = table.place();
    fit.name = read_name(table, study.fits);
    fit.targets = table.words("targets", true);
    fit.predicted = table.words("predicted");
    for (const char *key : {"targets", "predicted"}) {
      const std::vector<std::string> &list =
          key == std::string("targets") ? fit.targets : fit.predicted;
      for (std::size_t i = 0; i < list.size(); ++i) {
        const Place place = entry_place(table, *entry, key, i);
        if (!find_entry(study.targets, list[i]))
          table.errors().add(place,
                             unknown_name("there is no target", list[i], names_of(study.targets)));
        if (std::count(list.begin(), list.begin() + static_cast<long>(i), list[i]))
          table.errors().add(place, "'" + list[i] + "' stands twice in '" + key + "'");
        if (&list == &fit.predicted && std::count(fit.targets.begin(), fit.targets.end(), list[i]))
          table.errors().add(
              place, "'" + list[i] + "' is fitted in the same fit and can't be predicted by it");
      }
    }
    if (study.parameters.empty())
      table.errors().add(table.place(),
                         "the fit '" + fit.name + "' needs at least one [[parameters]]");
    table.finish();
    study.fits.push_back(fit);
  }
}

void read_fit_options(TomlTable &top, Study &study) {
  const toml::table *entry = top.table("fit");
  if (!entry) return;
  TomlTable table(*entry, "[fit]", top.file(), top.errors());
  FitOptions &options = study.options;
  options.lhs_points = static_cast<int>(table.whole("lhs_points", options.lhs_points, 0, 100000));
  options.max_iterations =
      static_cast<int>(table.whole("max_iterations", options.max_iterations, 0, 1000));
  options.seed = static_cast<std::uint64_t>(table.whole("seed", 1, 1, 2147483647));
  options.packings = static_cast<int>(table.whole("packings", options.packings, 0, 1000));
  options.jobs = static_cast<int>(table.whole("jobs", options.jobs, 0, 100000));
  options.max_failed = static_cast<int>(table.whole("max_failed", options.max_failed, 0, 1000000));
  options.difference_step =
      table.quantity("difference_step", "1").value_or(options.difference_step);
  if (options.difference_step < 0.02 || options.difference_step > 0.5)
    table.error("difference_step",
                "'difference_step' can't be " + canonical_number(options.difference_step) +
                    "; allowed: 0.02 to 0.5 (breaking is discrete: smaller steps measure noise)");
  options.prior_sd = table.quantity("prior_sd", "1").value_or(options.prior_sd);
  if (options.prior_sd <= 0) table.error("prior_sd", "'prior_sd' must be above 0");
  table.finish();
}

}  // namespace bondlab
