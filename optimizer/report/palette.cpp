// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/palette.h"

#include <cassert>
#include <cstring>

namespace bondlab {

const std::vector<Colour> &palette() {
  static const std::vector<Colour> colours = {
      {"paper", "#ffffff", "#14181e"},       {"panel", "#f6f7f9", "#1b2129"},
      {"ink", "#1b2430", "#e4e8ee"},         {"quiet", "#5c6878", "#9ba7b6"},
      {"rule", "#d5dae1", "#343d49"},        {"grid", "#e6e9ee", "#29313b"},
      {"good", "#1d6b41", "#5cc98f"},        {"good-fill", "#e5f3ea", "#173326"},
      {"bad", "#a3271d", "#ff8a7d"},         {"bad-fill", "#fbeae7", "#3b1f1d"},
      {"warn", "#8a5a00", "#f0bb62"},        {"warn-fill", "#fbf2df", "#3a2f18"},
      {"series-1", "#174f8f", "#6aaeff"},    {"series-2", "#c2610f", "#ffab5c"},
      {"series-3", "#3d8a5f", "#67cf9a"},    {"series-4", "#7a4fa3", "#c39af0"},
      {"series-5", "#8b95a3", "#7f8b9a"},    {"band", "#dfe9f5", "#20344c"},
      {"disc", "#ece7dd", "#2a3038"},        {"disc-edge", "#cdc5b6", "#465060"},
      {"disc-hurt", "#ddd2bd", "#3a4048"},   {"tension-early", "#efb0a4", "#7d4a42"},
      {"tension-mid", "#d9604f", "#d96a5a"}, {"tension-late", "#961a10", "#ffb3a8"},
      {"shear-early", "#a3c6ea", "#3b587c"}, {"shear-mid", "#3f82c6", "#4f93dc"},
      {"shear-late", "#0d3a70", "#b5d7ff"},
  };
  return colours;
}

const char *light(const char *role) {
  for (const Colour &colour : palette())
    if (std::strcmp(colour.role, role) == 0) return colour.light;
  assert(!"unknown colour role");
  return "#000000";
}

std::string palette_css() {
  std::string bright = ":root{color-scheme:light dark;", dark;
  for (const Colour &colour : palette()) {
    bright += std::string("--") + colour.role + ":" + colour.light + ";";
    dark += std::string("--") + colour.role + ":" + colour.dark + ";";
  }
  return bright + "}\n@media screen and (prefers-color-scheme:dark){:root{" + dark + "}}\n";
}

std::string with_css_variables(const std::string &svg) {
  std::string result;
  result.reserve(svg.size() + svg.size() / 8);
  bool in_tag = false;  // words of the user stand outside tags and may look like colours
  for (std::size_t i = 0; i < svg.size();) {
    const Colour *found = nullptr;
    if (svg[i] == '<') in_tag = true;
    if (svg[i] == '>') in_tag = false;
    if (in_tag && svg[i] == '#')
      for (const Colour &colour : palette())
        if (svg.compare(i, 7, colour.light) == 0) found = &colour;
    if (found) {
      result += std::string("var(--") + found->role + ")";
      i += 7;
    } else {
      result += svg[i++];
    }
  }
  return result;
}

}  // namespace bondlab
