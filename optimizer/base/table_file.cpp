// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/table_file.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace bondlab {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = line.find(separator, begin);
    cells.push_back(trimmed(line.substr(begin, end == std::string_view::npos ? end : end - begin)));
    if (end == std::string_view::npos) return cells;
    begin = end + 1;
  }
}

}  // namespace

std::string read_text_file(const std::filesystem::path &file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw UserError({file.string(), 0, 0}, "there is no such file");
  if (!std::filesystem::is_regular_file(file, error))
    throw UserError({file.string(), 0, 0}, "this isn't a file");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw UserError({file.string(), 0, 0}, "the file can't be read");
  return text.str();
}

TableFile::TableFile(const std::filesystem::path &file, char separator)
    : file_(file), text_(std::make_shared<const std::string>(read_text_file(file))) {
  const std::string_view text = *text_;
  int names_line = 0, units_line = 0, line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    std::string_view row_text =
        text.substr(begin, end == std::string_view::npos ? end : end - begin);
    begin = end == std::string_view::npos ? text.size() : end + 1;
    last_line_is_whole_ = end != std::string_view::npos;
    ++line;
    if (trimmed(row_text).empty()) continue;
    last_line_ = line;
    if (row_text.front() == '#') {
      const std::string_view comment = trimmed(row_text.substr(1));
      const std::size_t colon = comment.find(':');
      const std::string key(trimmed(comment.substr(0, colon)));
      // The list keeps its separators: a value is trimmed of blanks only by cell.
      const std::string value(colon == std::string_view::npos ? ""
                                                              : trimmed(comment.substr(colon + 1)));
      if (key == "names" || key == "units") {
        std::vector<std::string> &list = key == "names" ? names_ : units_;
        int &list_line = key == "names" ? names_line : units_line;
        if (list_line)
          throw UserError(place(line), "a second '# " + key + ":' line; the first is line " +
                                           std::to_string(list_line));
        list_line = line;
        for (const std::string_view cell : split(value, separator)) list.emplace_back(cell);
      }
      header_.push_back({line, key, value});
      continue;
    }
    if (!names_line)
      throw UserError(place(line), "a row before the '# names:' line; name the columns first");
    if (!row_text.empty() && row_text.back() == '\r') row_text.remove_suffix(1);
    rows_.push_back({line, split(row_text, separator)});
    if (rows_.back().cells.size() != names_.size() && (last_line_is_whole_ || begin < text.size()))
      throw UserError(place(line),
                      "cells in this row: " + std::to_string(rows_.back().cells.size()) +
                          ", names in the '# names:' line: " + std::to_string(names_.size()) +
                          " (separator: " + (separator == '\t' ? "tab" : "comma") + ")");
  }
  // A row cut off in mid-line is what a killed writer leaves: it is no data.
  if (!last_line_is_whole_ && !rows_.empty() && rows_.back().line == last_line_) rows_.pop_back();
  if (!names_line) throw UserError(place(0), "there is no '# names:' line");
  if (units_line && units_.size() != names_.size())
    throw UserError(place(units_line), std::to_string(units_.size()) + " units for " +
                                           std::to_string(names_.size()) + " names");
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (names_[i].empty())
      throw UserError(place(names_line), "column " + std::to_string(i + 1) + " has no name");
    for (std::size_t j = 0; j < i; ++j)
      if (names_[i] == names_[j])
        throw UserError(place(names_line), "two columns are named '" + names_[i] + "'");
  }
}

const TableFile::HeaderLine *TableFile::find(const std::string &key) const {
  for (const HeaderLine &line : header_)
    if (line.key == key) return &line;
  return nullptr;
}

std::size_t TableFile::column_index(const std::string &name) const {
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (names_[i] == name) return i;
  const HeaderLine *names = find("names");
  throw UserError(place(names ? names->line : 0),
                  "there is no column '" + name + "'; columns: " + join(names_));
}

Place TableFile::place(const Row &row, std::size_t column) const {
  const std::string_view cell = row.cells.at(column);
  if (cell.data() == nullptr) return place(row.line);  // an empty cell has no address
  const std::size_t offset = static_cast<std::size_t>(cell.data() - text_->data());
  const std::size_t line_begin = text_->rfind('\n', offset);
  return {file_.string(), row.line,
          static_cast<int>(line_begin == std::string::npos ? offset + 1 : offset - line_begin)};
}

double TableFile::number(const Row &row, std::size_t column) const {
  const std::string_view cell = row.cells.at(column);
  double value = 0;
  const char *first = cell.data(), *last = cell.data() + cell.size();
  if (first != last && *first == '+') ++first;
  const auto result = std::from_chars(first, last, value);
  if (result.ec == std::errc() && result.ptr == last && !std::isfinite(value))
    throw NotFinite(place(row, column), "'" + std::string(cell) + "' in column '" + names_[column] +
                                            "' isn't a finite number");
  if (first == last || result.ec != std::errc() || result.ptr != last)
    throw UserError(place(row, column), "'" + std::string(cell) + "' in column '" + names_[column] +
                                            "' isn't a number");
  return value;
}

long TableFile::whole_number(const Row &row, std::size_t column) const {
  const double value = number(row, column);
  if (value != std::floor(value) || std::abs(value) > 9e15)
    throw UserError(place(row, column), "'" + std::string(row.cells[column]) + "' in column '" +
                                            names_[column] + "' isn't a whole number");
  return static_cast<long>(value);
}

std::string TableFile::word(const Row &row, std::size_t column) const {
  return std::string(row.cells.at(column));
}

}  // namespace bondlab
