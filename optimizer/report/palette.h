// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: every colour of the report, once, with its light and its dark value.
// Method: pictures are drawn in the light values, as files of their own must be; when a picture is
//   put into the page each light value is replaced by the CSS variable of its role, so that the
//   page follows the reader's light or dark setting. The light values are all different, so that
//   the replacement is unique. Series colours differ in lightness, not in hue alone, so that they
//   can be told apart by colour-blind readers and on grey prints.
// Units: none.
// Failure: none.
#pragma once

#include <string>
#include <vector>

namespace bondlab {

struct Colour {
  const char *role;   // CSS variable without the dashes: "ink"
  const char *light;  // "#rrggbb", lower case
  const char *dark;
};

const std::vector<Colour> &palette();

// Light value of a role; an unknown role is our own mistake (assertion).
const char *light(const char *role);

// ":root{--ink:#...}" for both settings; printing is always light.
std::string palette_css();

// Light values -> var(--role), for a picture that goes into the page.
std::string with_css_variables(const std::string &svg);

}  // namespace bondlab
