// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/svg.h"

#include <fmt/format.h>

#include <cmath>

#include "report/palette.h"

namespace bondlab {
namespace {

// Length of the valid UTF-8 sequence at `i` that XML 1.0 allows; 0 when there is none.
std::size_t xml_character(const std::string &text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || i + length > text.size()) return 0;
  unsigned long code = first & (0xffu >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i + k) & 0x3fu);
  }
  const unsigned long least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool control = code < 0xa0 || code == 0xfffe || code == 0xffff;
  return code < least[length] || code > 0x10ffff || surrogate || control ? 0 : length;
}

}  // namespace

std::string xml_escape(const std::string &text) {
  std::string result;
  result.reserve(text.size() + 8);
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = xml_character(text, i);
    if (length == 0) {
      result += "\ufffd";
      ++i;
      continue;
    }
    switch (text[i]) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result.append(text, i, length);
    }
    i += length;
  }
  return result;
}

std::string compact(double value, int decimals) {
  if (!std::isfinite(value)) return "0";
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

SvgWriter::SvgWriter(double width, double height, const std::string &title,
                     const std::string &sentence) {
  out_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<title>{2}</title>\n<desc>{3}</desc>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"{4}\"/>\n",
      compact(width), compact(height), xml_escape(title), xml_escape(sentence), light("paper"));
}

void SvgWriter::open_group(const std::string &attributes) { out_ += "<g " + attributes + ">\n"; }
void SvgWriter::close_group() { out_ += "</g>\n"; }

void SvgWriter::circle(double x, double y, double r, const std::string &attributes) {
  out_ += "<circle cx=\"" + compact(x) + "\" cy=\"" + compact(y) + "\" r=\"" + compact(r) + "\"" +
          (attributes.empty() ? "" : " " + attributes) + "/>\n";
}

void SvgWriter::line(double x1, double y1, double x2, double y2, const std::string &attributes) {
  out_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", compact(x1),
                      compact(y1), compact(x2), compact(y2), attributes);
}

void SvgWriter::rectangle(double x, double y, double width, double height,
                          const std::string &attributes) {
  out_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", compact(x),
                      compact(y), compact(width), compact(height), attributes);
}

void SvgWriter::path(const std::string &d, const std::string &attributes) {
  out_ += "<path d=\"" + d + "\" " + attributes + "/>\n";
}

void SvgWriter::text(double x, double y, const std::string &text, const std::string &attributes) {
  out_ += fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", compact(x), compact(y), attributes,
                      xml_escape(text));
}

void SvgWriter::raw(const std::string &markup) { out_ += markup; }

std::string SvgWriter::finish() { return out_ + "</svg>\n"; }

}  // namespace bondlab
