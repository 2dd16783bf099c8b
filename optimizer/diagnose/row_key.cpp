// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/row_key.h"

namespace bondlab::diagnose {

std::string to_string(CurvePart part) {
  static const std::string names[curve_part_count] = {"toe",       "slope", "pre-peak", "peak",
                                                      "post-peak", "hold",  "unload",   "scatter"};
  return names[static_cast<int>(part)];
}

}  // namespace bondlab::diagnose
