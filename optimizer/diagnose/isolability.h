// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the table of effects that a set of tests can't tell apart, in lines that a person reads.
// Method: effects any two of which are confused most of the time are one line, however many they
//   are: with one figure more than there are parameters that is all of them. The other pairs stand
//   alone, the most confused first, and no more than a dozen.
// Units: chance as a share. Failure: none.
#pragma once

#include <string>
#include <vector>

namespace bondlab::diagnose {

struct Confusable {
  std::string first, second;
  double cosine = 0, chance = 0;  // at ten noise units
};

constexpr std::size_t most_pairs_told = 12;
constexpr std::size_t least_group = 4;   // effects; fewer are told as pairs
constexpr double one_for_another = 0.9;  // least chance within a group

// `pairs` by chance, the largest first. Empty where there are none.
std::vector<std::string> isolability_lines(const std::vector<Confusable> &pairs);

}  // namespace bondlab::diagnose
