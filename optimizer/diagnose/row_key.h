// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: where a row of a residual comes from.
// Method: a test under one condition is a series ("uc_slow_343K"); a series' curve has parts; a
//   part has one or more quantities (rows). Everything that is located, blocked or drawn later goes
//   by these four names.
// Units: none. Failure: none.
#pragma once

#include <string>
#include <vector>

namespace bondlab::diagnose {

enum class CurvePart { toe, slope, pre_peak, peak, post_peak, hold, unload, scatter };
constexpr int curve_part_count = 8;
std::string to_string(CurvePart part);

struct RowKey {
  std::string test;    // kind of test
  std::string series;  // test under one condition
  CurvePart part = CurvePart::slope;
  std::string quantity;  // "log stress", "strain at 0.2 of the peak"
};

}  // namespace bondlab::diagnose
