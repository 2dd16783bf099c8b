// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: take one TOML table apart strictly: every key is asked for once with its type, what is left
// over is an error. Method: each getter records its key; finish() reports the keys nobody asked
// for, with the nearest known one. A value of
//   the wrong type or unit goes to the collector and the getter returns its fallback, so that
//   reading goes on.
// Why not toml++'s own conversions: they accept numbers where a unit is needed and say nothing of
// unknown keys. Units: quantity getters return SI. Failure: errors go to the collector with
// file:line:column of the value. Limits: included by the .cpp files of this room only; nobody else
// knows TOML.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

#include "base/user_error.h"

namespace bondlab {

// Parses the file; a syntax error is a UserError with its place.
toml::table parse_toml(const std::string &text, const std::string &file);

class TomlTable {
 public:
  // `what` names the table in messages: "[study]", "[[tests]]", "the variables of test 'ucs'".
  TomlTable(const toml::table &table, std::string what, std::string file, ErrorCollector &errors);

  bool has(const std::string &key) const { return table_.contains(key); }
  Place place() const;                        // of the table
  Place place(const std::string &key) const;  // of the value; of the table when the key is absent
  Place key_place(const std::string &key) const;

  // Text. Required ones that are absent or empty are errors.
  std::string text(const std::string &key, bool required = false);
  // One of `allowed`; the first is the fallback.
  std::string choice(const std::string &key, const std::vector<std::string> &allowed,
                     bool required = false);
  // Whole number in [minimum, maximum].
  long whole(const std::string &key, long fallback, long minimum, long maximum,
             bool required = false);
  // "41.5 GPa" of the dimension of `unit`; a bare number only where `unit` is dimensionless.
  std::optional<double> quantity(const std::string &key, const std::string &unit,
                                 bool required = false);
  // The same where the unit itself may have been wrong: then the key only counts as known.
  std::optional<double> quantity_if(const std::optional<std::string> &unit, const std::string &key,
                                    bool required = false);
  // A number in `unit` itself, or a quantity; for test.toml, where the unit stands two lines above.
  std::optional<double> limit_if(const std::optional<std::string> &unit, const std::string &key);
  std::vector<std::string> words(const std::string &key, bool required = false);
  // Sub-table or nullptr; array of tables or an empty list.
  const toml::table *table(const std::string &key, bool required = false);
  std::vector<const toml::table *> tables(const std::string &key, bool required = false);
  // Every key with its value, for tables whose keys are names; marks all as known.
  std::vector<std::pair<std::string, const toml::node *>> entries();

  Place place_of(const toml::node &node) const;
  void error(const std::string &key, const std::string &text);  // at the value of `key`
  std::string given(const std::string &key) const;  // the value as written, for messages
  void know(const std::string &key);                // finish() won't complain of it
  void finish();                                    // unknown keys

  const std::string &file() const { return file_; }
  const std::string &what() const { return what_; }
  ErrorCollector &errors() { return errors_; }

 private:
  const toml::node *get(const std::string &key, bool required, const char *example);

  const toml::table &table_;
  std::string what_, file_;
  ErrorCollector &errors_;
  std::vector<std::string> known_;
};

// A quantity from a node (string with a unit, or number where dimensionless); nullopt and an error
// otherwise.
std::optional<double> quantity_of(const toml::node &node, const std::string &unit,
                                  const Place &place, ErrorCollector &errors);

// The key `unit`: a unit's text, nullopt after an error; "1" when it is absent and not required.
std::optional<std::string> read_unit(TomlTable &table, bool required);

// "a string", "an integer", ... for messages.
std::string kind_of(const toml::node &node);
// The value as a user wrote it, for messages.
std::string shown(const toml::node &node);

}  // namespace bondlab
