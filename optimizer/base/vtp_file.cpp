// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/vtp_file.h"

#include <cassert>
#include <charconv>
#include <cmath>
#include <string_view>

#include "base/table_file.h"
#include "base/units.h"
#include "base/user_error.h"

namespace bondlab {

namespace {

std::string escaped(const std::string &text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

void put_array(std::string &out, const VtpArray &array) {
  out += "<DataArray type=\"" + std::string(array.whole ? "Int32" : "Float64") + "\"";
  if (!array.name.empty()) out += " Name=\"" + escaped(array.name) + "\"";
  out += " NumberOfComponents=\"" + std::to_string(array.components) + "\" format=\"ascii\">";
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    assert(std::isfinite(array.values[i]));
    out += i % static_cast<std::size_t>(array.components) == 0 ? '\n' : ' ';
    out += array.whole ? std::to_string(static_cast<long>(array.values[i]))
                       : canonical_number(array.values[i]);
  }
  out += "\n</DataArray>\n";
}

void put_arrays(std::string &out, const char *element, const std::vector<VtpArray> &arrays) {
  out += std::string("<") + element + ">\n";
  for (const VtpArray &array : arrays) put_array(out, array);
  out += std::string("</") + element + ">\n";
}

// Connectivity and the end of each cell.
void put_cells(std::string &out, const char *element, const std::vector<double> &points_of_cells,
               int points_a_cell) {
  VtpArray connectivity{"connectivity", 1, true, points_of_cells}, offsets{"offsets", 1, true, {}};
  for (std::size_t end = 0; end < points_of_cells.size();)
    offsets.values.push_back(static_cast<double>(end += static_cast<std::size_t>(points_a_cell)));
  put_arrays(out, element, {connectivity, offsets});
}

// A cursor over the elements of an XML text; enough for the files this reads.
class Elements {
 public:
  Elements(const std::string &file, std::string_view text) : file_(file), text_(text) {}

  // Moves behind the next tag; false at the end. Comments and declarations are skipped.
  bool next() {
    for (;;) {
      const std::size_t open = text_.find('<', at_);
      if (open == std::string_view::npos) return false;
      if (text_.compare(open, 4, "<!--") == 0) {
        const std::size_t close = text_.find("-->", open);
        if (close == std::string_view::npos) return false;
        at_ = close + 3;
        continue;
      }
      const std::size_t close = text_.find('>', open);
      if (close == std::string_view::npos) fail("a tag that doesn't end");
      tag_ = text_.substr(open + 1, close - open - 1);
      at_ = close + 1;
      if (!tag_.empty() && tag_[0] != '?' && tag_[0] != '!') return true;
    }
  }
  bool is(std::string_view name) const {
    return tag_.substr(0, name.size()) == name &&
           (tag_.size() == name.size() ||
            std::string_view(" \t\r\n/").find(tag_[name.size()]) != std::string_view::npos);
  }
  std::string attribute(const std::string &name) const {
    for (std::size_t at = 0; (at = tag_.find(name + "=", at)) != std::string_view::npos; ++at) {
      if (std::string_view(" \t\r\n").find(tag_[at - 1]) == std::string_view::npos) continue;
      const std::size_t quote = at + name.size() + 1;
      if (quote >= tag_.size()) break;
      const std::size_t end = tag_.find(tag_[quote], quote + 1);
      if (end == std::string_view::npos) break;
      return std::string(tag_.substr(quote + 1, end - quote - 1));
    }
    return "";
  }
  std::string_view words_after() const { return text_.substr(at_, text_.find('<', at_) - at_); }
  [[noreturn]] void fail(const std::string &what) const {
    int line = 1;
    for (const char c : text_.substr(0, at_)) line += c == '\n';
    throw UserError(Place{file_, line, 0}, what);
  }

 private:
  const std::string file_;
  std::string_view text_, tag_;
  std::size_t at_ = 0;
};

VtpArray read_array(const Elements &elements) {
  VtpArray array;
  array.name = elements.attribute("Name");
  const std::string format = elements.attribute("format"),
                    components = elements.attribute("NumberOfComponents");
  if (format != "ascii")
    elements.fail("the array '" + array.name + "' is stored as '" + format +
                  "' (allowed: ascii; in ParaView: Save Data, Data Mode Ascii)");
  if (!components.empty()) array.components = std::atoi(components.c_str());
  const std::string_view words = elements.words_after();
  const char *at = words.data(), *const end = at + words.size();
  for (;;) {
    while (at != end && std::string_view(" \t\r\n").find(*at) != std::string_view::npos) ++at;
    if (at == end) break;
    double value = 0;
    const auto result = std::from_chars(at, end, value);
    if (result.ec != std::errc() || !std::isfinite(value))
      elements.fail("value " + std::to_string(array.values.size() + 1) + " of the array '" +
                    array.name + "' isn't a finite number");
    array.values.push_back(value);
    at = result.ptr;
  }
  return array;
}

}  // namespace

const VtpArray *VtpData::find(const std::string &name) const {
  for (const VtpArray &array : point_data)
    if (array.name == name) return &array;
  return nullptr;
}

std::string vtp_text(const VtpData &data) {
  const std::size_t points = data.size();
  const bool lines = !data.lines.empty();
  const auto count = [](const char *name, std::size_t value) {
    return std::string(" ") + name + "=\"" + std::to_string(value) + "\"";
  };
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece" +
      count("NumberOfPoints", points) + count("NumberOfVerts", lines ? 0 : points) +
      count("NumberOfLines", data.lines.size()) + count("NumberOfStrips", 0) +
      count("NumberOfPolys", 0) + ">\n";
  put_arrays(out, "PointData", data.point_data);
  put_arrays(out, "CellData", data.cell_data);
  put_arrays(out, "Points", {VtpArray{"", 3, false, data.points}});
  std::vector<double> vertices, ends;
  if (!lines)
    for (std::size_t i = 0; i < points; ++i) vertices.push_back(static_cast<double>(i));
  for (const auto &line : data.lines) ends.insert(ends.end(), {double(line[0]), double(line[1])});
  put_cells(out, "Verts", vertices, 1);
  put_cells(out, "Lines", ends, 2);
  return out + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

VtpData read_vtk_points(const std::filesystem::path &file) {
  const std::string text = read_text_file(file);
  Elements elements(file.string(), text);
  VtpData data;
  bool in_file = false, in_points = false, in_point_data = false;
  while (elements.next()) {
    if (elements.is("VTKFile")) {
      const std::string type = elements.attribute("type");
      if (type != "PolyData" && type != "UnstructuredGrid")
        elements.fail("the file holds '" + type + "' (allowed: PolyData, UnstructuredGrid)");
      in_file = true;
    } else if (elements.is("Piece") && !data.points.empty()) {
      elements.fail("a second piece (allowed: one)");
    } else if (elements.is("Points") || elements.is("/Points")) {
      in_points = elements.is("Points");
    } else if (elements.is("PointData") || elements.is("/PointData")) {
      in_point_data = elements.is("PointData");
    } else if (elements.is("DataArray") && (in_points || in_point_data)) {
      VtpArray array = read_array(elements);
      if (in_points)
        data.points = std::move(array.values);
      else
        data.point_data.push_back(std::move(array));
    }
  }
  if (!in_file) throw UserError(Place{file.string(), 1, 0}, "not a VTK XML file: no <VTKFile>");
  if (data.points.empty() || data.points.size() % 3 != 0)
    throw UserError(Place{file.string(), 0, 0},
                    std::to_string(data.points.size()) +
                        " coordinates of points (allowed: three a point, at least one point)");
  for (const VtpArray &array : data.point_data)
    if (array.values.size() != data.size() * static_cast<std::size_t>(array.components))
      throw UserError(Place{file.string(), 0, 0},
                      "the array '" + array.name + "' has " + std::to_string(array.values.size()) +
                          " values for " + std::to_string(data.size()) + " points");
  return data;
}

}  // namespace bondlab
