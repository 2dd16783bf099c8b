// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: numbers as a reader wants them: few digits, a true minus sign, a dash for what could not be
//   had.
// Method: rounding to significant digits without exponent between 1e-4 and 1e7; a value with a
//   standard deviation is cut where the second digit of the deviation stands, so that no digit is
//   shown that means nothing.
// Units: the caller's.
// Failure: none; NaN and infinity become a dash.
// Limits: locale-independent by fmt.
#pragma once

#include <string>
#include <vector>

namespace bondlab {

std::string significant(double value,
                        int digits = 4);  // no trailing zeros: what was given as 41.5 shows as 41.5
std::string significant_full(double value, int digits = 4);  // with them: computed values line up
std::string fixed(double value, int decimals);
std::string plus_minus(double value, double sd);  // "23.41 ± 0.85"; without sd just the value
std::string signed_percent(double share);         // 0.0312 -> "+3.1 %"
std::string count_text(long count);               // 12952 -> "12 952" with narrow no-break spaces
std::string duration_text(double seconds);        // "0.4 s", "75 s", "12 min 30 s", "3 h 05 min"
std::string counted(long count, const std::string &one,
                    const std::string &many);                  // "1 run", "3 runs"
std::string list_text(const std::vector<std::string> &words);  // "E, nu and UCS"

}  // namespace bondlab
