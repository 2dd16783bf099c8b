// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the sections of the study file that hold a published table: [[quantities]] (its columns),
// [[cases]] (its rows), [compare].
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "study/study_sections.h"

namespace bondlab {

namespace {

// "10 %" of the published value, or a quantity.
void read_tolerance(TomlTable &table, const toml::table &entry, const std::string &si_unit,
                    PublishedQuantity &quantity) {
  const toml::node *node = entry.get("tolerance");
  if (!node) {
    table.errors().add(table.place(), "'tolerance' is missing in [[quantities]]; write tolerance = \"10 %\" of the published value, or a quantity");
    return;
  }
  if (node->is_string()) {
    table.text("tolerance");
    try {
      const Quantity given = split_quantity(node->as_string()->get());
      quantity.relative = given.unit == "%";
      quantity.tolerance = quantity.relative ? given.number / 100
                                             : parse_difference(node->as_string()->get(), si_unit);
    } catch (const UnitError &error) {
      table.error("tolerance", error.text() + ", or a share such as \"10 %\"");
      return;
    }
  } else {
    quantity.relative = false;
    quantity.tolerance = table.quantity("tolerance", si_unit).value_or(1);
  }
  if (!(quantity.tolerance > 0))
    table.error("tolerance", "'tolerance' can't be " + shown(*node) + "; it must be above 0");
}

// What a case may give its specimens instead of the study's values: 1 where it has no dimension.
struct SpecimenNumber {
  const char *name, *unit;
  double *(*of)(SpecimenEntry &);
};
const SpecimenNumber specimen_numbers[] = {
    {"width", "m", [](SpecimenEntry &s) { return &s.size.width; }},
    {"height", "m", [](SpecimenEntry &s) { return &s.size.height; }},
    {"diameter", "m", [](SpecimenEntry &s) { return &s.size.diameter; }},
    {"length", "m", [](SpecimenEntry &s) { return &s.size.length; }},
    {"r_min", "m", [](SpecimenEntry &s) { return &s.r_min; }},
    {"r_ratio", "1", [](SpecimenEntry &s) { return &s.r_ratio; }},
};

std::vector<std::string> names_of_numbers() {
  std::vector<std::string> names;
  for (const SpecimenNumber &number : specimen_numbers) names.push_back(number.name);
  return names;
}

void read_exponents(TomlTable &table, const toml::table &given, const Study &study,
                    PublishedQuantity &quantity) {
  TomlTable exponents(given, "the exponents of quantity '" + quantity.name + "'", table.file(),
                      table.errors());
  std::vector<std::string> names = names_of(study.parameters);
  for (const std::string &name : names_of_numbers()) names.push_back(name);
  for (const std::string &name : names)
    if (const auto value = exponents.quantity(name, "1")) quantity.exponents[name] = *value;
  exponents.finish();
}

// `specimen = { diameter = "6 mm" }` in a case: tests and specimens of its own, so that everything
// below this room sees nothing but tests.
void read_own_specimen(TomlTable &table, const toml::table &given, Study &study,
                       PublishedCase &one) {
  TomlTable sizes(given, "the specimen of case '" + one.name + "'", table.file(), table.errors());
  const std::size_t errors_before = table.errors().errors().size();
  for (const SpecimenNumber &number : specimen_numbers)
    if (const auto value = sizes.quantity(number.name, number.unit)) {
      one.sizes[number.name] = *value;
      if (*value <= 0)
        sizes.error(number.name, std::string("'") + number.name + "' can't be " +
                                     sizes.given(number.name) + "; it must be above 0");
    }
  sizes.finish();
  if (table.errors().errors().size() != errors_before) return;
  std::vector<std::string> wanted;
  for (const PublishedQuantity &quantity : study.quantities) {
    if (!quantity.envelope.empty() && !find_entry(study.envelopes, quantity.envelope))
      continue;  // reported already
    for (const std::string &test : tests_of(study, quantity))
      if (std::find(wanted.begin(), wanted.end(), test) == wanted.end()) wanted.push_back(test);
  }
  for (const std::string &name : wanted) {
    const TestEntry *found = find_entry(study.tests, name);
    if (!found || !find_entry(study.specimens, found->specimen)) continue;  // reported already
    TestEntry test = *found;
    SpecimenEntry specimen = *find_entry(study.specimens, test.specimen);
    test.name = found->name + "@" + one.name;
    test.specimen = specimen.name = specimen.name + "@" + one.name;
    test.place = specimen.place = one.place;
    for (const SpecimenNumber &number : specimen_numbers) {
      const auto size = one.sizes.find(number.name);
      if (size == one.sizes.end()) continue;
      double *value = number.of(specimen);
      if (!(*value > 0)) {
        sizes.error(number.name, "the specimen '" + found->specimen + "' has no '" + number.name + "'");
        return;
      }
      *value = size->second;
    }
    check_specimen(table.errors(), specimen);
    one.own_tests[found->name] = test.name;
    if (!find_entry(study.specimens, specimen.name)) study.specimens.push_back(specimen);
    study.tests.push_back(test);
  }
}

void read_quantities(TomlTable &top, Study &study) {
  for (const toml::table *entry : top.tables("quantities")) {
    TomlTable table(*entry, "[[quantities]]", top.file(), top.errors());
    PublishedQuantity quantity;
    quantity.place = table.place();
    quantity.name = read_name(table, study.quantities);
    std::string si_unit = read_figure_source(table, study, quantity);
    if (si_unit.empty()) si_unit = "1";
    quantity.unit = read_unit(table, false).value_or(si_unit);
    if (!same_dimension(quantity.unit, si_unit)) {
      table.error("unit", "the unit '" + quantity.unit + "' isn't one of the response; allowed here: " + join(allowed_units(si_unit)));
      quantity.unit = si_unit;
    }
    read_tolerance(table, *entry, si_unit, quantity);
    quantity.judged = table.choice("judged", {"yes", "no"}) == "yes";
    if (const toml::table *exponents = table.table("exponents"))
      read_exponents(table, *exponents, study, quantity);
    table.finish();
    study.quantities.push_back(quantity);
  }
}

void read_set(TomlTable &table, const toml::table &given, const Study &study, PublishedCase &one) {
  TomlTable set(given, "the set of case '" + one.name + "'", table.file(), table.errors());
  std::vector<bool> seen(study.parameters.size(), false);
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    const Parameter &parameter = study.parameters[i];
    const std::optional<double> value = set.quantity(parameter.name, parameter.unit, true);
    one.values.push_back(value.value_or(parameter.lower));
  }
  set.finish();
}

void read_expected(TomlTable &table, const toml::table &given, const Study &study,
                   const char *key, std::map<std::string, double> &to) {
  TomlTable values(given, std::string("'") + key + "'", table.file(), table.errors());
  for (const PublishedQuantity &quantity : study.quantities)
    if (const auto value = values.quantity(quantity.name, quantity.unit)) to[quantity.name] = *value;
  values.finish();
}

}  // namespace

void read_published(TomlTable &top, Study &study) {
  read_quantities(top, study);
  for (const toml::table *entry : top.tables("cases")) {
    TomlTable table(*entry, "[[cases]]", top.file(), top.errors());
    PublishedCase one;
    one.place = table.place();
    one.name = read_name(table, study.cases);
    if (const toml::table *set = table.table("set", true)) read_set(table, *set, study, one);
    one.group = table.text("group");
    one.packings = static_cast<int>(table.whole("packings", 0, 1, 1000));
    one.heavy = table.choice("heavy", {"no", "yes"}) == "yes";
    if (const toml::table *sizes = table.table("specimen")) read_own_specimen(table, *sizes, study, one);
    const toml::table *expected = table.table("expect");
    if (expected && !study.quantities.empty())
      read_expected(table, *expected, study, "expect", one.expected);
    if (const toml::table *sd = table.table("expect_sd"))
      read_expected(table, *sd, study, "expect_sd", one.expected_sd);
    one.source = table.text("source");
    table.finish();
    study.cases.push_back(one);
  }
  if (!study.cases.empty() && study.quantities.empty())
    top.errors().add(study.cases.front().place, "[[cases]] need [[quantities]]: which responses the published table has");
  if (const toml::table *compare = top.table("compare")) {
    TomlTable table(*compare, "[compare]", top.file(), top.errors());
    study.case_packings = static_cast<int>(table.whole("packings", study.case_packings, 1, 1000));
    study.relative_cases = table.choice("relative", {"no", "yes"}) == "yes";
    table.finish();
  }
}

}  // namespace bondlab
