// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: find, before anything is run, responses of a study's tests that name a function this program
//   doesn't have.
// Method: the reader of test.toml can't know the functions, which are a room above it; this closes
//   the gap.
// Units: none. Failure: UserErrors with the place in test.toml and the functions there are.
#pragma once

#include "study/study.h"

namespace bondlab {

void check_response_functions(const Study &study);

}  // namespace bondlab
