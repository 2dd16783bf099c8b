// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: which further test would separate effects that the present data cannot.
// Method: the model is linear about the present fit, for the rows there are and for those a further
//   test would add. If one rival is true at the size estimated for it, the other's best fit, with
//   all parameters free, stays behind by the squared norm of what it cannot follow; with the rows
//   of a further test that number grows. The advice is the test with the largest gap, taken for the
//   pair of rivals that it separates worst; and whether that gap is enough (twice the margin that a
//   name needs, so that noise does not eat it).
// Source: sensor placement for isolability (Krysander & Frisk, IEEE Trans. SMC A 38(6), 2008), here
//   with sizes and noise instead of structure.
// Units: chi squared. Failure: none; with fewer than two rivals there is nothing to advise.
#pragma once

#include <string>
#include <vector>

#include "diagnose/refit.h"

namespace bondlab::diagnose {

struct TestOption {
  std::string name;
  std::vector<int> rows;  // of the linearisation
};

struct Advice {
  std::string test;
  double separation = 0;  // chi squared, of the worst pair
  bool enough = false;
};

// Every option, best first. `model` holds the rows of all tests; `present` marks those there are.
// `amplitudes` are the rivals' estimates, in the order of `rivals`.
std::vector<Advice> advise(const Linearisation &model, const std::vector<bool> &present,
                           const std::vector<TestOption> &options,
                           const std::vector<std::size_t> &rivals,
                           const std::vector<double> &amplitudes);

}  // namespace bondlab::diagnose
