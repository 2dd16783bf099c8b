// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: lay out one picture of a body as SVG: discs, lines and arrows to scale, a title above, a
//   colour bar or keys to the right, a scale bar and sentences below.
// Method: everything beside the body has a fixed place and fixed widths, and sentences are broken
//   into lines by counted characters, so that no text meets another whatever the body's shape. The
//   window is the body; what has flown farther is left out and counted.
// Units: m for the body's places, pixels for the rest.
// Failure: none; without discs there is no picture (empty string).
// Limits: sentences wider than the picture are broken between words only.
#pragma once

#include <string>
#include <vector>

namespace bondlab {

struct DrawnDisc {
  double x, y, r;      // m
  std::string colour;  // "#rrggbb"
  double depth = 0;    // larger is nearer to the reader
};

struct DrawnLine {
  double x1, y1, x2, y2;  // m
  std::string colour;
  double width = 1;  // pixels
  double depth = 0;  // lines of larger depth are drawn later
};

struct DrawnArrow {
  double x, y;    // m, its tail
  double dx, dy;  // pixels, to the right and up
};

struct ColourKey {
  std::string colour, words;
  bool line = false;  // a line, not a disc
  double width = 3;
};

struct ColourBar {
  std::string words;               // what it shows and its unit
  std::vector<std::string> ticks;  // evenly spaced from the bottom to the top; empty: no bar
};

struct Drawing {
  std::string title;
  std::vector<std::string> sentences;  // below the picture
  std::string plane;                   // "x-y plane", beside the scale bar
  bool shaded = false;                 // spheres seen from outside
  double outline = 1;                  // strength of the discs' edges
  std::vector<DrawnDisc> discs;
  std::vector<DrawnLine> lines;
  std::vector<DrawnArrow> arrows;
  ColourBar bar;
  std::vector<ColourKey> keys;
};

// Position 0 .. 1 on the scale of sizes (dark to light), as "#rrggbb".
std::string scale_colour(double position);

std::string draw(const Drawing &drawing);

}  // namespace bondlab
