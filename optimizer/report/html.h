// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the few HTML pieces the report is made of: tables of numbers, tags, commands, figures.
// Method: functions that take plain text escape it themselves; arguments named `html` are taken as
//   they are. A number in a table is a <data> element: the reader sees it rounded, a program reads
//   all its digits.
// Units: the caller's.
// Failure: none.
#pragma once

#include <string>
#include <vector>

namespace bondlab {

std::string html_text(const std::string &text);                   // escaped
std::string html_number(double value, const std::string &shown);  // <data value="...">shown</data>
std::string html_tag(const std::string &text,
                     const char *kind);                // small label; kind: good, bad, plain
std::string html_command(const std::string &command);  // one command in a box; "" for none
std::string html_paragraph(const std::string &text, const char *css_class = "");
std::string html_list(const std::vector<std::string> &texts);

class HtmlTable {
 public:
  // A heading that begins with '>' is a column of numbers, aligned right.
  HtmlTable(const std::string &caption, const std::vector<std::string> &headings);
  void row(const std::vector<std::string> &html_cells, const char *css_class = "");
  void note(const std::string
                &text);  // a line of words below the row before, under all but its first cell
  std::string html() const;

 private:
  std::vector<bool> numbers_;
  std::string caption_, head_, body_;
};

struct Figure {
  std::string name;  // file name without suffix; empty: no picture, `problem` says why
  std::string title, sentence;
  std::string svg;  // light colours
  std::string problem;
  bool wide = false;
};
std::string html_figure(const Figure &figure);

}  // namespace bondlab
