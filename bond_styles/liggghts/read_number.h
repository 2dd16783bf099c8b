// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: read a number from a word of a deck, the whole word and nothing else. The engine's own reader
// stops with a message that doesn't name the word.
// Failure: NaN, which no range allows, so that the caller's message carries the word and what is
// allowed. Units: none.
#ifndef BONDLAB_READ_NUMBER_H
#define BONDLAB_READ_NUMBER_H

#include <cstdlib>
#include <limits>

namespace bondlab {

inline double read_number(const char *word) {
  char *end = nullptr;
  const double value = std::strtod(word, &end);
  return end == word || *end ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace bondlab

#endif
