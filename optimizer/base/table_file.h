// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: read a text table strictly: `# key: value` lines, then rows of cells, each known by line and
// column. Method: the file is read whole and cut into views; nothing is guessed. Lines that begin
// with '#' are header lines, also
//   after the rows (`# complete: ...`). Empty lines are skipped. Every row must have as many cells
//   as `# names:` lists.
// Units: none here; the `# units:` line is handed on. Failure: UserError with file:line:column;
// NotFinite (a UserError)
//   for nan and inf, so that a caller can tell a diverged simulation from a mistyped file.
// Limits: no quoting: a cell can't contain the separator.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/user_error.h"

namespace bondlab {

class NotFinite : public UserError {
 public:
  using UserError::UserError;
};

// Whole file as text; UserError when it can't be read.
std::string read_text_file(const std::filesystem::path &file);

class TableFile {
 public:
  struct HeaderLine {
    int line;
    std::string key;    // text before the first ':'; all of it when there is none
    std::string value;  // text after it, trimmed
  };
  struct Row {
    int line;
    std::vector<std::string_view> cells;
  };

  // Reads `file`; the separator is '\t' or ','. `# names:` is required, `# units:` must have as
  // many entries when present.
  TableFile(const std::filesystem::path &file, char separator);

  const std::vector<HeaderLine> &header() const { return header_; }
  const HeaderLine *find(const std::string &key) const;  // nullptr when absent
  const std::vector<std::string> &names() const { return names_; }
  const std::vector<std::string> &units() const { return units_; }
  const std::vector<Row> &rows() const { return rows_; }
  bool last_line_is_whole() const { return last_line_is_whole_; }  // ends with a line break
  bool header_line_is_last(const HeaderLine &header_line) const {
    return header_line.line == last_line_;
  }

  std::size_t column_index(const std::string &name) const;  // UserError that lists the names
  double number(const Row &row, std::size_t column) const;
  long whole_number(const Row &row, std::size_t column) const;
  std::string word(const Row &row, std::size_t column) const;
  Place place(const Row &row, std::size_t column) const;
  Place place(int line) const { return {file_.string(), line, 0}; }

 private:
  std::filesystem::path file_;
  std::shared_ptr<const std::string> text_;  // the rows are views into it
  std::vector<HeaderLine> header_;
  std::vector<std::string> names_, units_;
  std::vector<Row> rows_;
  int last_line_ = 0;
  bool last_line_is_whole_ = true;
};

}  // namespace bondlab
