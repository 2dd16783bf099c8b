// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a PNG beside an SVG, at twice its size.
// Method: rsvg-convert (Debian: librsvg2-bin), started without a shell.
// Units: none. Failure: UserError when the program is missing or fails; its words are given.
#pragma once

#include <filesystem>
#include <string>

namespace bondlab {

// Returns the PNG's path.
std::filesystem::path png_from_svg(const std::filesystem::path &svg,
                                   const std::string &program = "rsvg-convert");

}  // namespace bondlab
