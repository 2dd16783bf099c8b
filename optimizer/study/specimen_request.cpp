// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/specimen_request.h"

namespace bondlab {

SpecimenRequest specimen_request(const SpecimenEntry &entry, int packing) {
  SpecimenRequest request;
  request.shape = entry.shape;
  request.set_dimensions(entry.size);
  request.r_min = entry.r_min;
  request.r_ratio = entry.r_ratio;
  request.sizes = entry.sizes;
  request.r_median = entry.r_median;
  request.r_spread = entry.r_spread;
  request.classes = entry.classes;
  request.d10 = entry.d10;
  request.d50 = entry.d50;
  request.d90 = entry.d90;
  request.method = entry.method;
  request.tries = entry.tries;
  request.seed = entry.seed + static_cast<std::uint64_t>(packing);
  request.density = entry.density;
  return request;
}

}  // namespace bondlab
