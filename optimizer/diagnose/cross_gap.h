// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: does what was named predict series that it was not fitted to?
// Method: every series is held out in turn; the parameters alone, and the parameters with the named
//   effects, are fitted to the others, and judged by the whitened residual of the one held out. The
//   floor is what a right model would leave: a row's own noise and the fit's. The placebo is the
//   first effect's trace with the signs of its rows drawn at random (placebo.h), fitted in the same
//   way, to first order; the mean over 50 draws. It is not a number where there is none.
// Source: leave-one-group-out cross validation, Stone 1974.
// Units: chi squared over all rows. Failure: a series whose fits give no figures is left out,
//   and one that the others cannot predict, because it alone shows the effect.
#pragma once

#include <cstdint>

#include "diagnose/diagnose.h"

namespace bondlab::diagnose {

struct CrossGap {
  double before = 0, after = 0, placebo = 0, floor = 0;
  // Of the way to the floor; 0 when there was no way to go.
  double closed() const { return before > floor ? (before - after) / (before - floor) : 0; }
  double closed_by_placebo() const {
    return before > floor ? (before - placebo) / (before - floor) : 0;
  }
};

// `prober` is the model of the parameters alone, `with_effects` that of the fit after: the same, or
// the one made right there.
CrossGap cross_gap(Prober &prober, Prober &with_effects, const Evidence &evidence,
                   const std::vector<EffectEntry> &catalogue, const Diagnosis &diagnosis,
                   std::uint64_t seed);

}  // namespace bondlab::diagnose
