// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: read_study() and the sections that say what is tested: [study], [[specimens]], [[tests]],
// [[assumptions]], [data].
#include <algorithm>

#include "base/table_file.h"
#include "base/units.h"
#include "study/input_folders.h"
#include "study/specimen_request.h"
#include "study/study.h"
#include "study/study_sections.h"

namespace bondlab {

namespace fs = std::filesystem;

std::string unknown_name(const std::string &complaint, const std::string &name,
                         const std::vector<std::string> &known) {
  const std::string near = nearest_word(name, known);
  return complaint + " '" + name + "'" + (near.empty() ? "" : " (did you mean '" + near + "'?)") +
         "; known: " + (known.empty() ? "none" : join(known));
}

namespace {

void read_study_table(TomlTable &top, Study &study) {
  const toml::table *table = top.table("study", true);
  if (!table) return;
  TomlTable head(*table, "[study]", top.file(), top.errors());
  study.name = read_name(head, std::vector<SpecimenEntry>());
  study.title = head.text("title");
  study.notes = head.words("notes");
  head.finish();
}

// A length that must be above zero.
double positive_length(TomlTable &table, const std::string &key, bool required,
                       double fallback = 0) {
  const std::optional<double> value = table.quantity(key, "m", required);
  if (!value) return fallback;
  if (*value <= 0)
    table.error(key, "'" + key + "' can't be " + table.given(key) + "; it must be above 0 m");
  return *value;
}

void read_dimensions(TomlTable &table, SpecimenEntry &specimen) {
  std::vector<std::string> own;
  for (const NamedDimension &dimension : dimensions_of(specimen.shape)) {
    own.push_back(dimension.name);
    specimen.size.*dimension.value = positive_length(table, dimension.name, true);
  }
  if (can_have_notch(specimen.shape)) {
    own.insert(own.end(), {"notch_depth", "notch_width"});
    // One of them alone makes the other required.
    const bool notched = table.has("notch_depth") || table.has("notch_width");
    specimen.size.notch_depth = notched ? positive_length(table, "notch_depth", true) : 0;
    specimen.size.notch_width = notched ? positive_length(table, "notch_width", true) : 0;
  }
  if (is_flat(specimen.shape)) {
    own.push_back("thickness");
    specimen.thickness = positive_length(table, "thickness", false, specimen.thickness);
  }
  for (const char *name :
       {"width", "height", "diameter", "length", "notch_depth", "notch_width", "thickness"}) {
    if (!table.has(name) || std::find(own.begin(), own.end(), name) != own.end()) continue;
    positive_length(table, name, false);
    table.errors().add(
        table.key_place(name),
        "a " + shape_name(specimen.shape) + " has no '" + name + "'; it has: " + join(own));
  }
}

// The size distribution with the keys it has, and the way of packing.
void read_sizes(TomlTable &table, SpecimenEntry &specimen) {
  specimen.sizes = table.has("sizes") ? table.text("sizes", true) : specimen.sizes;
  const std::string &sizes = specimen.sizes;
  const auto belongs = [&](const char *key, const char *to) {
    if (sizes == to) return true;
    if (!table.has(key)) return false;
    table.errors().add(table.key_place(key), std::string("'") + key + "' belongs to sizes = \"" + to +
                                                 "\"; here they are \"" + sizes + "\"");
    table.know(key);
    return false;
  };
  const auto known = size_distribution_names();
  if (std::find(known.begin(), known.end(), sizes) == known.end()) {
    for (const char *key : {"r_min", "r_ratio", "r_median", "r_spread", "classes", "d10", "d50", "d90"})
      table.know(key);
  } else {
    if (belongs("r_min", "uniform")) specimen.r_min = positive_length(table, "r_min", true);
    if (belongs("r_ratio", "uniform"))
      specimen.r_ratio = table.quantity("r_ratio", "1").value_or(specimen.r_ratio);
    if (specimen.r_ratio < 1)
      table.error("r_ratio", "'r_ratio' (largest over smallest radius) can't be " +
                                 canonical_number(specimen.r_ratio) + "; it must be at least 1");
    if (belongs("r_median", "log-normal"))
      specimen.r_median = positive_length(table, "r_median", true);
    if (belongs("r_spread", "log-normal"))
      specimen.r_spread = table.quantity("r_spread", "1", true).value_or(0.1);
    if (belongs("classes", "discrete"))
      for (const std::string &text : table.words("classes", true)) try {
          specimen.classes.push_back(parse_size_class(text));
        } catch (const UserError &error) {
          table.error("classes", error.text());
        }
    for (const auto &[key, value] : {std::pair{"d10", &specimen.d10}, {"d50", &specimen.d50}, {"d90", &specimen.d90}})
      if (belongs(key, "d10-d50-d90")) *value = positive_length(table, key, true);
  }
  specimen.method = table.choice("method", packing_methods());
  if (specimen.method == "insertion") {
    specimen.tries = table.whole("tries", default_tries, 1, most_tries);
  } else if (table.has("tries")) {
    table.errors().add(table.key_place("tries"), "'tries' belongs to method = \"insertion\"; here it is \"" + specimen.method + "\"");
    table.know("tries");
  }
}

}  // namespace

// What only the generator knows: the size distributions there are, how many particles it takes.
void check_specimen(ErrorCollector &errors, SpecimenEntry &specimen) {
  try {
    const SpecimenRequest request = specimen_request(specimen, 0);
    check_request(request);
    if (specimen.sizes != "uniform") {  // as reports show it
      const auto sizes = size_distribution(request.size_settings(), specimen.dimensions());
      specimen.r_min = sizes->smallest();
      specimen.r_ratio = sizes->largest() / sizes->smallest();
    }
  } catch (const UserErrors &several) {
    for (const UserError &error : several.errors())
      errors.add(specimen.place, "specimen '" + specimen.name + "': " + error.text());
  } catch (const UserError &error) {
    errors.add(specimen.place, "specimen '" + specimen.name + "': " + error.text());
  }
}

void read_specimens(TomlTable &top, Study &study) {
  for (const toml::table *entry : top.tables("specimens", true)) {
    TomlTable table(*entry, "[[specimens]]", top.file(), top.errors());
    const std::size_t errors_before = table.errors().errors().size();
    SpecimenEntry specimen;
    specimen.place = table.place();
    specimen.name = read_name(table, study.specimens);
    const std::string shape = table.choice("shape", container_shape_names(), true);
    for (const std::string &name : container_shape_names())
      if (name == shape) specimen.shape = shape_from_name(name);
    read_dimensions(table, specimen);
    read_sizes(table, specimen);
    specimen.density = table.quantity("density", "kg/m3").value_or(specimen.density);
    if (specimen.density <= 0) table.error("density", "'density' must be above 0 kg/m3");
    specimen.seed = static_cast<std::uint64_t>(table.whole("seed", 1, 1, 2147483647));
    table.finish();
    if (table.errors().errors().size() == errors_before) check_specimen(table.errors(), specimen);
    study.specimens.push_back(specimen);
  }
}

namespace {

void read_test_variables(TomlTable &table, const toml::table &entries, TestEntry &test) {
  TomlTable variables(entries, "the variables of test '" + test.name + "'", table.file(),
                      table.errors());
  std::vector<std::string> known;
  for (const auto &[name, definition] : test.definition.variables) known.push_back(name);
  for (const auto &[name, node] : variables.entries()) {
    const auto &reserved = variables_from_specimen();
    const auto found = test.definition.variables.find(name);
    if (std::find(reserved.begin(), reserved.end(), name) != reserved.end()) {
      variables.errors().add(variables.key_place(name),
                             "'" + name + "' is filled in from the specimen and can't be set here");
      continue;
    }
    if (found == test.definition.variables.end()) {
      if (!test.definition.variables.empty())
        variables.errors().add(
            variables.key_place(name),
            unknown_name("the test '" + test.test + "' has no variable", name, known));
      continue;
    }
    const DeckVariable &variable = found->second;
    if (variable.unit.empty()) continue;  // reported where it stands
    DeckValue value;
    if (!variable.choices.empty()) {
      value.word = variables.choice(name, variable.choices);
    } else {
      const std::optional<double> number =
          quantity_of(*node, variable.unit, variables.place(name), variables.errors());
      if (!number) continue;
      value.number = *number;
      const std::string why = why_not_allowed(variable, *number);
      if (!why.empty())
        variables.error(name, "'" + name + "' can't be " + shown(*node) + "; " + why);
    }
    test.variables[name] = value;
  }
}

// The deck's dimension must be the specimen's; a disc for a compression deck would only fail in the
// engine.
void check_specimen_fits(TomlTable &table, const TestEntry &test, const SpecimenEntry &specimen) {
  const auto &shapes = test.definition.shapes;
  if (!shapes.empty() &&
      std::find(shapes.begin(), shapes.end(), shape_name(specimen.shape)) == shapes.end())
    table.error("specimen", "the specimen '" + specimen.name + "' is a " +
                                shape_name(specimen.shape) + "; the test '" + test.test +
                                "' takes: " + join(shapes));
  const auto in_deck = test.definition.deck_defaults.find("dim");
  if (in_deck == test.definition.deck_defaults.end()) return;
  const auto set = test.variables.find("dim");
  const std::string dim = set == test.variables.end() ? in_deck->second : set->second.text();
  if (dim != std::to_string(specimen.dimensions()))
    table.errors().add(table.has("variables") ? table.place("variables") : table.place("specimen"),
                       "the specimen '" + specimen.name + "' (" + shape_name(specimen.shape) +
                           ") needs dim = " + std::to_string(specimen.dimensions()) +
                           ", the test has dim = " + dim +
                           (set == test.variables.end() ? " (the deck's default)" : ""));
}

}  // namespace

void read_tests(TomlTable &top, Study &study) {
  for (const toml::table *entry : top.tables("tests", true)) {
    TomlTable table(*entry, "[[tests]]", top.file(), top.errors());
    TestEntry test;
    test.place = table.place();
    test.name = read_name(table, study.tests);
    test.test = table.text("test", true);
    if (!test.test.empty()) {
      const fs::path folder = find_test_folder(test.test, study.file.parent_path());
      const auto read_before =
          std::find_if(study.tests.begin(), study.tests.end(),
                       [&](const TestEntry &other) { return other.definition.folder == folder; });
      if (!folder.empty() && read_before != study.tests.end())
        test.definition = read_before->definition;  // so that its errors aren't reported twice
      else if (!folder.empty())
        test.definition = read_test_definition(folder, top.errors());
      else if (test.test.find('/') != std::string::npos)
        table.error("test",
                    "there is no folder '" + (study.file.parent_path() / test.test).string() + "'");
      else
        table.error("test", unknown_name("there is no virtual test", test.test, known_tests()));
    }
    test.ranks = static_cast<int>(table.whole("ranks", 1, 1, 4096));
    test.wall_limit = table.quantity("wall_limit", "s").value_or(600);
    if (test.wall_limit <= 0) table.error("wall_limit", "'wall_limit' must be above 0 s");
    test.specimen = table.text("specimen", true);
    if (const toml::table *variables = table.table("variables"))
      read_test_variables(table, *variables, test);
    const SpecimenEntry *specimen = find_entry(study.specimens, test.specimen);
    if (specimen)
      check_specimen_fits(table, test, *specimen);
    else if (!test.specimen.empty())
      table.error("specimen",
                  unknown_name("there is no specimen", test.specimen, names_of(study.specimens)));
    table.finish();
    study.tests.push_back(test);
  }
}

namespace {

void read_assumptions(TomlTable &top, Study &study) {
  for (const toml::table *entry : top.tables("assumptions")) {
    TomlTable table(*entry, "[[assumptions]]", top.file(), top.errors());
    Assumption assumption;
    assumption.text = table.text("text", true);
    assumption.source = table.text("source");
    table.finish();
    study.assumptions.push_back(assumption);
  }
}

void read_data(TomlTable &top, Study &study) {
  const toml::table *entry = top.table("data");
  if (!entry) return;
  TomlTable table(*entry, "[data]", top.file(), top.errors());
  const std::string folder = table.text("folder", true);
  table.finish();
  if (folder.empty()) return;
  std::error_code error;
  const fs::path path = study.file.parent_path() / folder;
  if (!fs::is_directory(path, error)) {
    table.error("folder", "there is no folder '" + path.string() + "'");
    return;
  }
  try {
    study.data = read_data_folder(path);
  } catch (const UserError &user_error) {
    top.errors().add(user_error);
    return;
  }
  for (const Measurement &series : study.data->measurements)
    if (!series.test.empty() && !find_entry(study.tests, series.test))
      top.errors().add(series.place,
                       "series '" + series.name + "': " +
                           unknown_name("there is no test", series.test, names_of(study.tests)) +
                           " (in " + study.file.string() + ")");
}

}  // namespace

Study read_study(const fs::path &file) {
  Study study;
  study.file = file;
  study.source_text = read_text_file(file);
  const toml::table root = parse_toml(study.source_text, file.string());
  ErrorCollector errors;
  TomlTable top(root, "the study file", file.string(), errors);
  if (top.whole("schema", 1, 0, 1000000, true) != 1)
    top.error("schema", "'schema' can't be " + shown(*root.get("schema")) +
                            "; this version of bondlab reads schema 1");
  read_study_table(top, study);
  read_specimens(top, study);
  read_tests(top, study);
  read_parameters(top, study);
  read_envelopes(top, study);
  read_targets(top, study);
  read_fits(top, study);
  read_published(top, study);
  read_fit_options(top, study);
  read_assumptions(top, study);
  read_data(top, study);
  top.finish();
  errors.throw_if_any();
  return study;
}

}  // namespace bondlab
