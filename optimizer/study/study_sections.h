// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one reader a section of the study file, each checking its entries against the sections read
// before it. Method: sections are read in the order below, so that every name, unit and bound can
// be judged where it stands and its
//   place is at hand. What is wrong goes to the collector and reading goes on; an entry that is too
//   broken to be checked further is kept with its name, so that references to it aren't reported as
//   well.
// Units: SI. Failure: errors are collected with file:line:column. Limits: internal to this room;
// others include study.h.
#pragma once

#include "study/study.h"
#include "study/toml_table.h"

namespace bondlab {

void read_specimens(TomlTable &top, Study &study);
void check_specimen(ErrorCollector &errors, SpecimenEntry &specimen);  // by the generator
void read_tests(TomlTable &top, Study &study);  // and the test.toml of each
void read_parameters(TomlTable &top, Study &study);
void read_envelopes(TomlTable &top, Study &study);
void read_targets(TomlTable &top, Study &study);
void read_fits(TomlTable &top, Study &study);
void read_published(TomlTable &top, Study &study);  // [[quantities]], [[cases]], [compare]
void read_fit_options(TomlTable &top, Study &study);

// `test` or `envelope`, and `response`, of a [[targets]] or [[quantities]] entry. Returns the
// figure's SI unit, "" when it isn't known (reported).
std::string read_figure_source(TomlTable &table, const Study &study, FigureSource &source);

// The `name` of an entry: required, made of letters, digits, '_', '-', '.', and not used by an
// earlier entry of its kind.
template <class Entry>
std::string read_name(TomlTable &table, const std::vector<Entry> &earlier) {
  const std::string name = table.text("name", true);
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") !=
      std::string::npos)
    table.error("name", "'" + name + "' can't be a name: use letters, digits, '_', '-' and '.'");
  for (const Entry &entry : earlier)
    if (!name.empty() && entry.name == name)
      table.error("name", "the name '" + name + "' is used twice in " + table.what() +
                              "; first in line " + std::to_string(entry.place.line));
  return name;
}

template <class Entry>
const Entry *find_entry(const std::vector<Entry> &entries, const std::string &name) {
  for (const Entry &entry : entries)
    if (entry.name == name) return &entry;
  return nullptr;
}

template <class Entry>
std::vector<std::string> names_of(const std::vector<Entry> &entries) {
  std::vector<std::string> names;
  for (const Entry &entry : entries) names.push_back(entry.name);
  return names;
}

// "there is no test 'usc' (did you mean 'ucs'?); known: ucs, brazilian"; `complaint` is the part
// before the name.
std::string unknown_name(const std::string &complaint, const std::string &name,
                         const std::vector<std::string> &known);

}  // namespace bondlab
