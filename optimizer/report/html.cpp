// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/html.h"

#include <cmath>

#include "base/units.h"
#include "report/palette.h"
#include "report/svg.h"

namespace bondlab {

std::string html_text(const std::string &text) { return xml_escape(text); }

std::string html_number(double value, const std::string &shown) {
  if (!std::isfinite(value)) return html_text(shown);
  return "<data value=\"" + canonical_number(value) + "\">" + html_text(shown) + "</data>";
}

std::string html_tag(const std::string &text, const char *kind) {
  return std::string("<span class=\"tag ") + kind + "\">" + html_text(text) + "</span>";
}

std::string html_command(const std::string &command) {
  return command.empty() ? "" : "<pre><code>" + html_text(command) + "</code></pre>\n";
}

std::string html_paragraph(const std::string &text, const char *css_class) {
  if (text.empty()) return "";
  const std::string attribute = *css_class ? std::string(" class=\"") + css_class + "\"" : "";
  return "<p" + attribute + ">" + html_text(text) + "</p>\n";
}

std::string html_list(const std::vector<std::string> &texts) {
  if (texts.empty()) return "";
  std::string html = "<ul>\n";
  for (const std::string &text : texts) html += "<li>" + html_text(text) + "</li>\n";
  return html + "</ul>\n";
}

HtmlTable::HtmlTable(const std::string &caption, const std::vector<std::string> &headings)
    : caption_(caption) {
  for (const std::string &heading : headings) {
    const bool number = !heading.empty() && heading.front() == '>';
    numbers_.push_back(number);
    head_ += std::string("<th scope=\"col\"") + (number ? " class=\"n\"" : "") + ">" +
             html_text(heading.substr(number)) + "</th>";
  }
}

void HtmlTable::row(const std::vector<std::string> &html_cells, const char *css_class) {
  body_ += *css_class ? std::string("<tr class=\"") + css_class + "\">" : "<tr>";
  for (std::size_t i = 0; i < html_cells.size(); ++i) {
    const bool number = i < numbers_.size() && numbers_[i];
    const bool name = i == 0;
    body_ += std::string(name ? "<th scope=\"row\"" : "<td") + (number ? " class=\"n\"" : "") +
             ">" + html_cells[i] + (name ? "</th>" : "</td>");
  }
  body_ += "</tr>\n";
}

void HtmlTable::note(const std::string &text) {
  body_ += "<tr class=\"note\"><td></td><td colspan=\"" + std::to_string(numbers_.size() - 1) +
           "\">" + html_text(text) + "</td></tr>\n";
}

std::string HtmlTable::html() const {
  return "<div class=\"scroll\"><table>\n" +
         (caption_.empty() ? "" : "<caption>" + html_text(caption_) + "</caption>\n") +
         "<thead><tr>" + head_ + "</tr></thead>\n<tbody>\n" + body_ + "</tbody></table></div>\n";
}

std::string html_figure(const Figure &figure) {
  std::string html = figure.wide ? "<figure class=\"wide\">\n" : "<figure>\n";
  html += "<h3>" + html_text(figure.title) + "</h3>\n";
  html += figure.svg.empty() ? html_paragraph(figure.problem, "problem")
                             : with_css_variables(figure.svg);
  if (!figure.sentence.empty())
    html += "<figcaption>" + html_text(figure.sentence) + "</figcaption>\n";
  return html + "</figure>\n";
}

}  // namespace bondlab
