// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/specimen_request.h"

namespace bondlab {

SpecimenRequest specimen_request(const SpecimenEntry &entry, int packing) {
  SpecimenRequest request;
  request.shape = shape_from_name(to_string(entry.shape));
  request.width = entry.width;
  request.height = entry.height;
  request.diameter = entry.diameter;
  request.r_min = entry.r_min;
  request.r_ratio = entry.r_ratio;
  request.sizes = entry.sizes;
  request.seed = entry.seed + static_cast<std::uint64_t>(packing);
  request.density = entry.density;
  return request;
}

}  // namespace bondlab
