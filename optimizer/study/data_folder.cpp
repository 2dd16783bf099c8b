// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: read_data_folder(): manifest.toml and the curves it names. The format is documented in
// data_folder.md.
#include <algorithm>

#include "base/table_file.h"
#include "base/units.h"
#include "study/measurement.h"
#include "study/study_sections.h"
#include "study/toml_table.h"

namespace bondlab {

namespace fs = std::filesystem;

namespace {

MeasuredCurve read_measured_curve(const fs::path &folder, const std::string &name,
                                  const Measurement &series) {
  const fs::path file = folder / name;
  const std::string extension = file.extension().string();
  if (extension != ".csv" && extension != ".tsv")
    throw UserError(
        {file.string(), 0, 0},
        "'" + extension + "' isn't a curve file's ending; allowed: .csv (commas), .tsv (tabs)");
  const TableFile table(file, extension == ".csv" ? ',' : '\t');
  const TableFile::HeaderLine *units_line = table.find("units");
  if (!units_line)
    throw UserError(table.place(table.find("names")->line),
                    "a '# units:' line is needed below the names, one unit a column (1 for none)");
  if (table.rows().size() < 2) throw UserError(table.place(0), "a curve needs at least two rows");
  if (!table.last_line_is_whole())
    throw UserError(table.place(0), "the last line has no line break: the file may be cut off");

  for (const std::string *column : {&series.x, &series.y})
    if (!column->empty()) table.column_index(*column);  // throws when absent

  MeasuredCurve curve;
  curve.file = name;
  const TableFile::HeaderLine *label = table.find("replicate");
  curve.replicate = label ? label->value : file.stem().string();
  curve.names = table.names();
  curve.units = table.units();
  std::vector<Unit> units;
  for (const std::string &text : curve.units) {
    try {
      units.push_back(parse_unit(text));
    } catch (const UnitError &error) {
      throw UserError(table.place(units_line->line), error.text());
    }
  }
  curve.columns.assign(curve.names.size(), {});
  for (const TableFile::Row &row : table.rows())
    for (std::size_t i = 0; i < units.size(); ++i)
      curve.columns[i].push_back(table.number(row, i) * units[i].multiply / units[i].divide +
                                 units[i].offset);
  return curve;
}

// Conditions carry their own units: any quantity is allowed.
std::map<std::string, double> read_conditions(TomlTable &series) {
  std::map<std::string, double> conditions;
  const toml::table *entries = series.table("conditions");
  if (!entries) return conditions;
  TomlTable table(*entries, "the conditions", series.file(), series.errors());
  for (const auto &[name, node] : table.entries()) {
    std::string unit = "1";
    try {
      if (node->is_string()) unit = split_quantity(node->as_string()->get()).unit;
      if (unit.empty()) unit = "1";
      parse_unit(unit);
    } catch (const UnitError &error) {
      table.error(name, error.text());
      continue;
    }
    if (const auto value = quantity_of(*node, unit, table.place(name), table.errors()))
      conditions[name] = *value;
  }
  return conditions;
}

void read_series(TomlTable &table, DataFolder &data) {
  ErrorCollector &errors = table.errors();
  Measurement series;
  series.place = table.place();
  series.name = read_name(table, data.measurements);
  series.test = table.text("test");
  series.source = table.text("source");
  series.x = table.text("x", true);
  series.y = table.text("y", true);
  series.conditions = read_conditions(table);
  const std::vector<std::string> files = table.words("files", true);
  table.finish();
  bool all_read = !files.empty();
  for (const std::string &file : files) {
    try {
      MeasuredCurve curve = read_measured_curve(data.folder, file, series);
      for (const MeasuredCurve &other : series.replicates)
        if (other.file == file)
          throw UserError(table.place("files"),
                          "the file '" + file + "' stands twice in series '" + series.name + "'");
      series.replicates.push_back(std::move(curve));
    } catch (const UserError &error) {
      errors.add(error);
      all_read = false;
    }
  }
  if (all_read && !series.x.empty() && !series.y.empty()) {
    try {
      series.envelope = make_envelope(series.replicates, series.x, series.y);
    } catch (const UserError &error) {
      errors.add(table.place("files"), "series '" + series.name + "': " + error.what());
    }
  }
  data.measurements.push_back(std::move(series));
}

}  // namespace

DataFolder read_data_folder(const fs::path &folder) {
  DataFolder data;
  data.folder = folder;
  const std::string file = (folder / "manifest.toml").string();
  const toml::table root = parse_toml(read_text_file(file), file);
  ErrorCollector errors;
  TomlTable top(root, "a data manifest", file, errors);
  if (top.whole("schema", 1, 0, 1000000, true) != 1)
    top.error("schema",
              "'schema' must be 1: this version of bondlab reads data manifests of schema 1");
  if (const toml::table *entry = top.table("data")) {
    TomlTable table(*entry, "[data]", file, errors);
    data.title = table.text("title");
    data.source = table.text("source");
    data.licence = table.text("licence");
    table.finish();
  }
  for (const toml::table *entry : top.tables("series", true)) {
    TomlTable table(*entry, "[[series]]", file, errors);
    read_series(table, data);
  }
  top.finish();
  errors.throw_if_any();
  return data;
}

}  // namespace bondlab
