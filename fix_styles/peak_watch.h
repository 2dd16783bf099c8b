// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: decide when a test is over: the load has passed its peak and dropped, or a second quantity
// (strain) has reached its limit.
//
// Rule: stop when value < (1 - drop) peak, once peak > minimum; or when second > limit. The peak is
// the largest value seen. The minimum keeps the noise before loading from looking like a peak.
//
// Units: those of the values watched; drop is a fraction. Failure: NaN never stops a test (the
// curve writer reports it).
#ifndef BONDLAB_PEAK_WATCH_H
#define BONDLAB_PEAK_WATCH_H

namespace bondlab {

struct PeakWatch {
  enum Verdict { go_on = 0, dropped = 1, limit_reached = 2 };

  double drop = 0.0;
  double minimum = 0.0;
  double limit = 0.0;  // of the second value

  double peak = 0.0;
  bool seen = false;  // a value was seen, so that negative values have a peak as well

  Verdict look(double value) {
    if (!seen || value > peak) {
      if (value == value) peak = value, seen = true;
    }
    return seen && peak > minimum && value < (1.0 - drop) * peak ? dropped : go_on;
  }
  Verdict look(double value, double second) {
    const Verdict first = look(value);
    if (first != go_on) return first;
    return second > limit ? limit_reached : go_on;
  }
};

}  // namespace bondlab

#endif
