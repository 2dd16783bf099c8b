// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the size at which an effect is switched on, so that its change rises above the plan's noise
//   and is not so large that a slope says nothing of small sizes.
// Method: from 5 to 25 noise units are well; else the size that would have 8, were the change in
//   proportion, but no more than 8 times another one. An effect that grew by a factor g and whose
//   change did not grow by the root of g has saturated: the size before is taken, where the slope
//   is one; unless that change was noise, which does not grow with the size.
// Units: sizes any one; norms in noise units, off what the parameters can do. Failure: none.
#pragma once

#include <optional>
#include <vector>

namespace bondlab::diagnose {

struct SizeTried {
  double size = 0, norm = 0;
  double noise = 0;  // of the change, share
};

// What to try after `tried` (not empty, in order); nothing: the last one stays. `largest` is the
// largest admissible size.
std::optional<double> next_switch_on(const std::vector<SizeTried> &tried, double largest);

// Sizes tried in all, the first included.
constexpr int most_switch_ons = 4;

// Of a size at once: beyond it nothing that was run says what to expect.
constexpr double longest_growth = 8;

}  // namespace bondlab::diagnose
