// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/local_dump.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/table_file.h"
#include "base/user_error.h"

namespace bondlab {

namespace {

std::vector<std::string> words_of(const std::string &line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// What `compute ID GROUP bonded/local ...` of the log lists; empty when it isn't there.
std::vector<std::string> compute_words(const std::string &log, const std::string &id) {
  std::istringstream lines(log);
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> words = words_of(line);
    if (words.size() > 4 && words[0] == "compute" && words[1] == id && words[3] == "bonded/local")
      found.assign(words.begin() + 4, words.end());
  }
  return found;
}

// "c_bonds[3]" -> "bonds", 3
bool split_column(const std::string &head, std::string &id, std::size_t &number) {
  const std::size_t open = head.find('[');
  if (head.rfind("c_", 0) != 0 || open == std::string::npos || head.back() != ']') return false;
  id = head.substr(2, open - 2);
  number = 0;
  std::from_chars(head.data() + open + 1, head.data() + head.size() - 1, number);
  return number > 0;
}

std::vector<std::string> meanings(const std::vector<std::string> &heads, const std::string &log,
                                  const std::vector<std::string> &given, const Place &place) {
  if (!given.empty()) {
    if (given.size() != heads.size())
      throw UserError(place, std::to_string(heads.size()) + " columns, but " +
                                 std::to_string(given.size()) +
                                 " names were given: " + join(given));
    return given;
  }
  std::vector<std::string> names;
  for (const std::string &head : heads) {
    std::string id;
    std::size_t number = 0;
    if (!split_column(head, id, number)) {
      names.push_back(head);
      continue;
    }
    const std::vector<std::string> words = compute_words(log, id);
    if (number > words.size())
      throw UserError(place, "what the column " + head +
                                 " holds isn't in the run's log (allowed: a log with the line "
                                 "`compute " +
                                 id + " ... bonded/local ...`, or --bond-columns)");
    names.push_back(words[number - 1]);
  }
  return names;
}

}  // namespace

int LocalDump::column(const std::string &name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

LocalDump read_local_dump(const std::filesystem::path &file, const std::string &log,
                          const std::vector<std::string> &words) {
  std::istringstream in(read_text_file(file));
  LocalDump dump;
  std::string line;
  int number = 0;
  const auto next = [&] {
    ++number;
    return static_cast<bool>(std::getline(in, line));
  };
  const auto fail = [&](const std::string &what) {
    throw UserError(Place{file.string(), number, 0}, what);
  };
  const auto whole = [&](const char *what) {
    if (!next()) fail(std::string(what) + " is missing");
    long value = -1;
    std::from_chars(line.data(), line.data() + line.size(), value);
    if (value < 0) fail("'" + line + "' isn't " + what);
    return value;
  };
  bool found = false;
  long step = 0, count = 0;
  while (next()) {
    if (line.rfind("ITEM: TIMESTEP", 0) == 0) step = whole("the step");
    if (line.rfind("ITEM: NUMBER OF ", 0) == 0) count = whole("the number of rows");
    if (line.rfind("ITEM: ENTRIES", 0) != 0) continue;
    found = true;
    dump.step = step;
    dump.names = meanings(words_of(line.substr(13)), log, words, Place{file.string(), number, 0});
    dump.rows.clear();  // only the last frame counts
    for (long i = 0; i < count; ++i) {
      if (!next())
        fail("the dump ends after " + std::to_string(i) + " of " + std::to_string(count) + " rows");
      std::vector<double> row;
      for (const std::string &word : words_of(line)) {
        double value = 0;
        const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
        if (result.ec != std::errc() || result.ptr != word.data() + word.size() ||
            !std::isfinite(value))
          fail("'" + word + "' isn't a finite number");
        row.push_back(value);
      }
      if (row.size() != dump.names.size())
        fail(std::to_string(row.size()) + " numbers in a row of " +
             std::to_string(dump.names.size()) + " columns");
      dump.rows.push_back(std::move(row));
    }
  }
  if (!found)
    throw UserError(Place{file.string(), 0, 0},
                    "this isn't a `dump local` file: there is no 'ITEM: ENTRIES' line");
  return dump;
}

}  // namespace bondlab
