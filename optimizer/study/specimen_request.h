// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a study's specimen as a request to the specimen generator.
// Method: the packing number is added to the seed, so that packing 0 is the study's own and 1, 2,
// ... are its replicas. Units: SI on both sides. Failure: none; the request is judged by
// check_request() when the study is read.
#pragma once

#include "specimen/specimen.h"
#include "study/study.h"

namespace bondlab {

SpecimenRequest specimen_request(const SpecimenEntry &entry, int packing);

}  // namespace bondlab
