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
  request.seed = entry.seed + static_cast<std::uint64_t>(packing);
  request.density = entry.density;
  return request;
}

}  // namespace bondlab
