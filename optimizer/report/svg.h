// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: write SVG that is small, well-formed and the same for the same input.
// Method: a thin writer of elements; coordinates are in pixels of the picture, rounded to two
//   decimals without trailing zeros, because thousands of discs go into one page. xml_escape()
//   serves HTML text and attributes as well: it replaces the five characters with a meaning and
//   drops what XML 1.0 forbids (control characters, broken UTF-8).
// Units: pixels.
// Failure: none.
// Limits: what the report needs, not all of SVG.
#pragma once

#include <string>

namespace bondlab {

std::string xml_escape(const std::string &text);

// Shortest of at most `decimals` decimals: "12.5", "-.07" is written "-0.07".
std::string compact(double value, int decimals = 2);

class SvgWriter {
 public:
  // `title` and `sentence` become <title> and <desc>, which screen readers speak.
  SvgWriter(double width, double height, const std::string &title, const std::string &sentence);

  void open_group(const std::string &attributes);
  void close_group();
  void circle(double x, double y, double r, const std::string &attributes = "");
  void line(double x1, double y1, double x2, double y2, const std::string &attributes);
  void rectangle(double x, double y, double width, double height, const std::string &attributes);
  void path(const std::string &d, const std::string &attributes);
  void text(double x, double y, const std::string &text, const std::string &attributes);
  void raw(const std::string &markup);  // as it stands

  std::string finish();  // the whole picture, with XML declaration-free root element

 private:
  std::string out_;
};

}  // namespace bondlab
