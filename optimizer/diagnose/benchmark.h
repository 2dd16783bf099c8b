// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how often the diagnosis is right, on thousands of hidden-effect laboratories.
// Method: one function a question; each says what it counts. Everything is seeded, so that the
//   counts are the same on every run; the limits of a rate are Clopper & Pearson's (exact
//   binomial).
// What is judged where: the test beside this file holds the counts against the goals;
//   benchmark_table() gives the whole table as text, for as many cases as wanted.
// Units: shares. Failure: none. Limits: the closed-form laboratory is one of many; its traces are
//   simpler than the engine's, whose own benchmark is counted apart.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "diagnose/bench_case.h"

namespace bondlab::diagnose {

struct Rate {
  int hits = 0, cases = 0;
  void count(bool hit) { hits += hit, ++cases; }
  double share() const { return cases > 0 ? static_cast<double>(hits) / cases : 0; }
  double upper() const;  // 95 %, one-sided
  std::string text() const;
};

struct NullResult {
  Rate alarms, noise_reported;
};
NullResult null_benchmark(Bench &bench, int cases, double stated_over_true);

struct NamingResult {
  Rate unique, within_set, wrong, missed, unexplained;  // of all cases
  Rate size_covered, gain_foretold;  // of cases named rightly: 95 % interval; within a factor of 2
  Rate inside_before, inside_after;  // planted base parameters in their 95 % intervals
  Rate shifted_inside_before, shifted_inside_after;  // those that the effect shifts by over 2 sd
  struct Other {
    std::string name;
    Rate unique, within_set, wrong, better;  // better: right where the diagnosis was not
  };
  std::array<Other, 3> others;
  std::vector<Rate> unique_by_effect;
};
NamingResult naming_benchmark(Bench &bench, int cases_per_effect, double lambda);

struct LeftOutResult {
  Rate said_so, wrongly_named, missed;
  std::vector<Rate> said_so_by_effect;
};
// Every catalogued effect, left out of the catalogue.
LeftOutResult left_out_benchmark(Bench &bench, int cases_per_effect, double lambda);
// Effects that the catalogue never had.
LeftOutResult outsider_benchmark(Bench &bench, int cases_per_effect, double lambda);

struct PairResult {
  Rate both, one_right_none_wrong, any_wrong;
};
PairResult pair_benchmark(Bench &bench, int cases, double lambda);

struct HoldoutResult {
  double closed_by_effect = 0, closed_by_placebo = 0;  // shares of the gap above the noise floor
  int cases = 0;
};
HoldoutResult holdout_benchmark(Bench &bench, int cases_per_effect, double lambda);

struct IsolabilityResult {
  double rank_correlation = 0;
  int pairs = 0, confused_pairs = 0;
};
// Foretold chance of confusion against counted confusion, over all ordered pairs of effects that
// laboratories with one to three tests can see.
IsolabilityResult isolability_benchmark(const std::vector<std::vector<std::string>> &laboratories,
                                        int cases_per_effect, double lambda);

struct AdviceResult {
  Rate separated, separated_by_random;  // of ambiguous cases
};
AdviceResult advice_benchmark(const std::vector<std::string> &series, int cases, double lambda);

// Laboratories whose frame yields: called_bond: an effect of bonds is named and the frame is not;
// bond_beside: the frame is named and an effect of bonds with it, as a second cause.
struct FrameResult {
  Rate called_bond, bond_beside;
};
FrameResult frame_benchmark(Bench &bench, int cases, double lambda);

// Series of the laboratory with few tests, and of laboratories in which much can be confused.
const std::vector<std::string> &few_series();
const std::vector<std::vector<std::string>> &poor_laboratories();

std::string benchmark_table(int scale);

}  // namespace bondlab::diagnose
