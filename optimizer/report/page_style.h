// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how the page looks: type, tables, figures, on screen (light and dark) and on paper.
// Method: one style sheet inside the page; fonts are the reader's own, so that nothing is fetched.
//   Colours come from palette.h as CSS variables.
// Units: none.
// Failure: none.
#pragma once

#include <string>

namespace bondlab {

std::string page_style();

}  // namespace bondlab
