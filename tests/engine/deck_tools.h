// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what the tests of the virtual laboratory's decks share: a deck's text, its arguments, a slope
// on the loading branch, the same files on 1, 2 and 4 ranks.
//
// Units: SI. Failure: a deck that isn't there gives an empty text.
#ifndef BONDLAB_TESTS_DECK_TOOLS_H
#define BONDLAB_TESTS_DECK_TOOLS_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine_run.h"

namespace engine::decks {

inline const std::string kInputs = std::string(BONDLAB_SOURCE_DIR) + "/inputs/";

inline std::string deck(const std::string &test) {
  std::ifstream in(kInputs + test + "/in." + test);
  std::stringstream all;
  all << in.rdbuf();
  return all.str();
}

inline std::vector<std::string> with_specimen(const std::string &name, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"-var", "specimen", kInputs + "specimens/" + name};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// Slope of y over x where x lies between two shares of its value at the peak of y.
inline double slope(const std::vector<double> &x, const std::vector<double> &y, double from, double to) {
  const auto peak = std::max_element(y.begin(), y.end());
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; y.begin() + k < peak; ++k) {
    if (y[k] < from * *peak || y[k] > to * *peak) continue;
    n += 1, sx += x[k], sy += y[k], sxx += x[k] * x[k], sxy += x[k] * y[k];
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

inline void expect_same_on_ranks(const std::string &test, const std::vector<std::string> &arguments,
                                 std::size_t at_least_broken = 10) {
  engine::EngineFolder one;
  const auto first = engine::run_deck(one, deck(test), 1, arguments, 120);
  ASSERT_TRUE(first.ok()) << first.screen;
  EXPECT_GT(engine::read_table(one.file("broken_bonds.tsv")).rows.size(), at_least_broken);
  for (const int ranks : {2, 4}) {
    engine::EngineFolder more;
    const auto run = engine::run_deck(more, deck(test), ranks, arguments, 240);
    ASSERT_TRUE(run.ok()) << run.screen;
    for (const char *file : {"curve.tsv", "broken_bonds.tsv", "particles_end.txt"})
      EXPECT_EQ(one.read(file), more.read(file)) << file << " on " << ranks << " ranks";
  }
}

// Runs a deck and gives its curve; the folder keeps the files.
inline engine::Table curve_of(const engine::EngineFolder &folder, const std::string &test,
                              const std::vector<std::string> &arguments, int ranks = 1,
                              double limit = 120) {
  const auto run = engine::run_deck(folder, deck(test), ranks, arguments, limit);
  EXPECT_TRUE(run.ok()) << run.screen;
  return engine::read_table(folder.file("curve.tsv"));
}

inline std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string> &b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

using Values = std::vector<std::pair<std::string, std::string>>;  // deck variables

inline Values operator+(Values a, const Values &b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// {"alpha", "1"} -> {"-var", "alpha", "1"}
inline std::vector<std::string> var(const Values &values) {
  std::vector<std::string> arguments;
  for (const auto &[name, value] : values) {
    arguments.push_back("-var");
    arguments.push_back(name);
    arguments.push_back(value);
  }
  return arguments;
}

inline double largest(const std::vector<double> &x) { return *std::max_element(x.begin(), x.end()); }

// Unbreakable bonds.
inline const std::pair<std::string, std::string> kStrong{"sigma_c", "1e12"}, kTough{"tau_c", "1e12"};

// Least squares slope of y over x for the points that `keep` picks.
template <class Keep>
double slope_where(const std::vector<double> &x, const std::vector<double> &y, Keep keep) {
  double n = 0, mx = 0, my = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (keep(k)) n += 1, mx += x[k], my += y[k];
  mx /= n, my /= n;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (keep(k)) sxx += (x[k] - mx) * (x[k] - mx), sxy += (x[k] - mx) * (y[k] - my);
  return sxy / sxx;
}

}  // namespace engine::decks

#endif
