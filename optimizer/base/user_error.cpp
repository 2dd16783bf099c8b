// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/user_error.h"

#include <algorithm>
#include <cctype>

namespace bondlab {

std::string to_string(const Place &place) {
  std::string text = place.file;
  if (place.file.empty() || place.line <= 0) return text;
  text += ":" + std::to_string(place.line);
  if (place.column > 0) text += ":" + std::to_string(place.column);
  return text;
}

static std::string with_place(const Place &place, const std::string &text) {
  const std::string where = to_string(place);
  return where.empty() ? text : where + ": " + text;
}

UserError::UserError(const Place &place, const std::string &text)
    : std::runtime_error(with_place(place, text)), place_(place), text_(text) {}

static std::string all_lines(const std::vector<UserError> &errors) {
  std::string lines;
  for (const UserError &error : errors) {
    if (!lines.empty()) lines += "\n";
    lines += error.what();
  }
  return lines;
}

UserErrors::UserErrors(std::vector<UserError> errors)
    : UserError(Combined{}, all_lines(errors), errors.at(0).place(), errors.at(0).text()),
      errors_(std::move(errors)) {}

void ErrorCollector::add(const UserError &error) {
  if (const auto *several = dynamic_cast<const UserErrors *>(&error))
    errors_.insert(errors_.end(), several->errors().begin(), several->errors().end());
  else
    errors_.push_back(error);
}

void ErrorCollector::throw_if_any() const {
  if (errors_.empty()) return;
  std::vector<std::string> files;  // in the order of their first error
  const auto rank = [&files](const UserError &e) {
    return std::find(files.begin(), files.end(), e.place().file) - files.begin();
  };
  for (const UserError &e : errors_)
    if (rank(e) == static_cast<std::ptrdiff_t>(files.size())) files.push_back(e.place().file);
  std::vector<UserError> sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const UserError &a, const UserError &b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    if (a.place().line != b.place().line) return a.place().line < b.place().line;
    return a.place().column < b.place().column;
  });
  throw UserErrors(std::move(sorted));
}

// Edit distance with neighbouring letters exchanged counted as one edit (optimal string alignment).
static std::size_t edit_distance(const std::string &a, const std::string &b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

std::string nearest_word(const std::string &given, const std::vector<std::string> &known) {
  const auto plain = [](const std::string &word) {  // case and underscores are the commonest slips:
                                                    // they cost nothing
    std::string letters;
    for (const char c : word)
      if (c != '_' && c != '-')
        letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return letters;
  };
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, given.size() / 3) + 1;
  for (const std::string &word : known) {
    const std::size_t distance = edit_distance(plain(given), plain(word));
    if (distance < best_distance) {
      best_distance = distance;
      best = word;
    }
  }
  return best;
}

std::string join(const std::vector<std::string> &words, const std::string &separator) {
  std::string text;
  for (const std::string &word : words) {
    if (!text.empty()) text += separator;
    text += word;
  }
  return text;
}

}  // namespace bondlab
