// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <sstream>

#include "base/table_file.h"
#include "base/user_error.h"
#include "report/xml_for_tests.h"
#include "view/drawing.h"
#include "view/paraview.h"
#include "view/pictures.h"
#include "view/png.h"
#include "view/run_for_tests.h"

namespace bondlab {
namespace {

RunView lattice_run() {
  const TestFolder folder;
  write_lattice_run(folder);
  folder.write("bonds_400.txt", lattice_forces());
  return read_run(folder.path());
}

// A body of 3D particles on a cubic lattice, n[0] x n[1] x n[2].
RunView block(int nx, int ny, int nz) {
  RunView run;
  run.dimension = 3;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        ViewParticle p;
        p.id = static_cast<int>(run.particles.size()) + 1;
        p.r = 1e-3;
        p.start = p.end = {2e-3 * i, 2e-3 * j, 2e-3 * k};
        run.particles.push_back(p);
      }
  run.has_start = true;
  run.gap = 1e-5;
  find_bonds(run, {});
  find_fragments(run);
  return run;
}

xml::Document parsed(const std::string &text) {
  const std::size_t body = text.rfind("<?xml", 0) == 0 ? text.find('\n') + 1 : 0;
  const std::string rest = text.substr(body);
  const xml::Document document = xml::parse(rest);
  EXPECT_EQ(document.error, "");
  return document;
}

TEST(View, CracksLieAcrossTheirBondsInTheColourOfTheirMode) {
  const RunView run = lattice_run();
  const Drawing drawing = cracks_by_mode(run, Projection(run, Look3d::slice));
  ASSERT_EQ(drawing.lines.size(), 7u);
  std::set<std::string> colours;
  for (const DrawnLine &line : drawing.lines) colours.insert(line.colour);
  EXPECT_EQ(colours.size(), 2u);
  // The first column's bonds lie along x: their cracks are upright, 2 mm long, and lie between the
  // two particles, which are 2.4 mm apart now.
  const DrawnLine &first = drawing.lines.front();
  EXPECT_NEAR(first.x1, first.x2, 1e-12);
  EXPECT_NEAR(std::fabs(first.y1 - first.y2), 2e-3, 1e-12);
  EXPECT_NEAR(first.x1, 0.0092, 1e-9);
}

TEST(View, ColoursOfTimeRunFromTheFirstCrackToTheLast) {
  const RunView run = lattice_run();
  const Drawing drawing = cracks_by_time(run, Projection(run, Look3d::slice));
  std::set<std::string> colours;
  for (const DrawnLine &line : drawing.lines) colours.insert(line.colour);
  EXPECT_EQ(colours.size(), 7u);
  EXPECT_EQ(colours.count(scale_colour(0)), 1u);
  EXPECT_EQ(colours.count(scale_colour(1)), 1u);
  ASSERT_FALSE(drawing.bar.ticks.empty());
  EXPECT_EQ(drawing.bar.ticks.front(), "1 ms");
  EXPECT_EQ(drawing.bar.ticks.back(), "10 ms");
}

TEST(View, ForceChainsAreAsWideAsTheForceAndTellItsSign) {
  const RunView run = lattice_run();
  const Drawing drawing = force_chains(run, Projection(run, Look3d::slice));
  ASSERT_EQ(drawing.lines.size(), 2u);
  EXPECT_GT(drawing.lines[0].width, drawing.lines[1].width);
  EXPECT_NE(drawing.lines[0].colour, drawing.lines[1].colour);
  EXPECT_EQ(drawing.lines[0].colour, drawing.keys[0].colour);
  EXPECT_EQ(drawing.keys[0].words, "compression");
}

TEST(View, FragmentsHaveColoursOfTheirOwn) {
  const RunView run = lattice_run();
  const Drawing drawing = fragments_picture(run, Projection(run, Look3d::slice));
  std::set<std::string> colours;
  for (const DrawnDisc &disc : drawing.discs) colours.insert(disc.colour);
  EXPECT_EQ(colours.size(), 3u);
}

TEST(View, SliceIsWhatAPlaneCutsOut) {
  const RunView run = block(5, 5, 8);
  const Projection slice(run, Look3d::slice);
  EXPECT_EQ(slice.words(), "x\u2013z slice through the middle");
  EXPECT_NEAR(slice.radius({0, 4e-3, 0}, 1e-3), 1e-3, 1e-12);     // its middle is in the plane
  EXPECT_NEAR(slice.radius({0, 4.6e-3, 0}, 1e-3), 0.8e-3, 1e-9);  // cut 0.6 from the middle
  EXPECT_EQ(slice.radius({0, 6e-3, 0}, 1e-3), 0);
  EXPECT_EQ(specimen_picture(run, slice).discs.size(), 40u);
  const Projection whole(run, Look3d::whole);
  EXPECT_EQ(specimen_picture(run, whole).discs.size(), 200u);
  EXPECT_TRUE(specimen_picture(run, whole).shaded);
}

TEST(View, PlaneFollowsTheBody) {
  const auto plane = [](const RunView &run, const char *given = "") {
    const Projection projection(run, Look3d::slice, given);
    return projection.horizontal() + projection.vertical();
  };
  EXPECT_EQ(plane(block(5, 5, 8)), "xz");   // a column stands
  EXPECT_EQ(plane(block(8, 8, 3)), "xy");   // a disc faces the reader
  EXPECT_EQ(plane(block(3, 3, 12)), "zy");  // a beam lies
  EXPECT_EQ(plane(block(3, 3, 12), "xz"), "xz");
  EXPECT_EQ(plane(lattice_run()), "xy");
  EXPECT_THROW(plane(block(3, 3, 3), "xx"), UserError);
  EXPECT_THROW(plane(block(3, 3, 3), "up"), UserError);
}

// A turned orthographic picture keeps right angles right: three axes, unit long, no mirror image.
TEST(View, LookFromASideIsARotation) {
  const RunView run = block(3, 3, 5);
  const Projection whole(run, Look3d::whole);
  const Vector3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double m[3][3];
  for (int k = 0; k < 3; ++k) {
    const Projection::Place at = whole.at(unit[k]);
    m[0][k] = at.x, m[1][k] = at.y, m[2][k] = at.depth;
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2], i == j, 1e-12);
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  EXPECT_NEAR(determinant, 1, 1e-12);
  EXPECT_GT(m[1][2], 0.9);  // z stays up
}

struct Box {
  double x0, x1, y0, y1;
  std::string words;
};

// Boxes of all words of a picture, of 12 pixel text unless they say otherwise.
std::vector<Box> boxes_of(const xml::Document &document) {
  std::vector<Box> boxes;
  for (const xml::Element &element : document.elements) {
    if (element.name != "text") continue;
    const auto size = element.attributes.find("font-size");
    const double height = size == element.attributes.end() ? 12 : std::stod(size->second);
    double characters = 0;
    for (const char c : element.text) characters += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    const double x = std::stod(element.attributes.at("x")),
                 y = std::stod(element.attributes.at("y"));
    boxes.push_back(
        {x, x + 0.5 * height * characters, y - 0.8 * height, y + 0.2 * height, element.text});
  }
  return boxes;
}

TEST(View, WordsMeetNeitherEachOtherNorTheEdgeWhateverTheShape) {
  for (const RunView &run : {block(3, 3, 40), block(40, 40, 3), block(5, 5, 5), block(3, 3, 9)})
    for (const Look3d look : {Look3d::slice, Look3d::whole}) {
      const Projection projection(run, look);
      for (const Drawing &drawing :
           {specimen_picture(run, projection), displacements(run, projection),
            fragments_picture(run, projection)}) {
        const xml::Document document = parsed(draw(drawing));
        const double width = std::stod(document.elements[0].attributes.at("width")),
                     height = std::stod(document.elements[0].attributes.at("height"));
        const std::vector<Box> boxes = boxes_of(document);
        EXPECT_GE(boxes.size(), 3u);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
          const Box &a = boxes[i];
          EXPECT_TRUE(a.x0 >= 0 && a.x1 <= width && a.y0 >= 0 && a.y1 <= height)
              << drawing.title << ": " << a.words;
          for (std::size_t j = 0; j < i; ++j) {
            const Box &b = boxes[j];
            EXPECT_FALSE(a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1)
                << drawing.title << ": \"" << a.words << "\" over \"" << b.words << "\"";
          }
        }
      }
    }
}

TEST(View, ParticlesThatHaveFlownOffDontShrinkThePicture) {
  RunView run = block(10, 3, 10);
  const Drawing near = specimen_picture(run, Projection(run, Look3d::slice, "xz"));
  run.particles[0].start = {5, 2e-3, 5};
  const Drawing far = specimen_picture(run, Projection(run, Look3d::slice, "xz"));
  const auto scale = [](const Drawing &drawing) {
    double largest = 0;
    const xml::Document document = parsed(draw(drawing));
    for (const xml::Element &element : document.elements)
      if (element.name == "circle")
        largest = std::max(largest, std::stod(element.attributes.at("r")));
    return largest;
  };
  EXPECT_NEAR(scale(near), scale(far), 0.2 * scale(near));
  EXPECT_NE(draw(far).find("1\u00a0particle farther away than shown."), std::string::npos);
}

std::vector<double> numbers(const std::string &text) {
  std::istringstream in(text);
  std::vector<double> values;
  for (double value; in >> value;) values.push_back(value);
  return values;
}

// Read by a parser of its own: elements, counts and connectivity as VTK's PolyData wants them.
TEST(View, ParaviewFilesHaveTheStructureOfPolyData) {
  const RunView run = lattice_run();
  const xml::Document points = parsed(vtp_text(particle_data(run)));
  const xml::Document lines = parsed(vtp_text(bond_data(run)));
  for (const xml::Document *document : {&points, &lines}) {
    EXPECT_EQ(document->elements[0].name, "VTKFile");
    EXPECT_EQ(document->elements[0].attributes.at("type"), "PolyData");
    EXPECT_EQ(document->elements[1].name, "PolyData");
    EXPECT_EQ(document->elements[2].name, "Piece");
    EXPECT_EQ(document->elements[2].attributes.at("NumberOfPoints"), "36");
  }
  EXPECT_EQ(points.elements[2].attributes.at("NumberOfVerts"), "36");
  EXPECT_EQ(lines.elements[2].attributes.at("NumberOfVerts"), "0");
  EXPECT_EQ(lines.elements[2].attributes.at("NumberOfLines"), "60");
  const auto array = [](const xml::Document &document, const std::string &name, std::size_t after) {
    for (std::size_t k = after; k < document.elements.size(); ++k) {
      const auto found = document.elements[k].attributes.find("Name");
      if (found != document.elements[k].attributes.end() && found->second == name)
        return numbers(document.elements[k].text);
    }
    return std::vector<double>();
  };
  EXPECT_EQ(array(points, "radius_m", 0), std::vector<double>(36, 0.001));
  EXPECT_EQ(array(points, "displacement_m", 0).size(), 108u);
  EXPECT_EQ(array(points, "fragment", 0)[35], 2);
  std::size_t in_lines = 0;
  for (std::size_t k = 0; k < lines.elements.size(); ++k)
    if (lines.elements[k].name == "Lines") in_lines = k;
  const std::vector<double> ends = array(lines, "connectivity", in_lines),
                            offsets = array(lines, "offsets", in_lines),
                            mode = array(lines, "mode_0_none_1_tension_2_shear", 0),
                            time = array(lines, "break_time_s", 0),
                            force = array(lines, "normal_force_N", 0);
  ASSERT_EQ(ends.size(), 120u);
  ASSERT_EQ(offsets.size(), 60u);
  for (std::size_t k = 0; k < 60; ++k) {
    EXPECT_EQ(offsets[k], 2 * (k + 1));
    EXPECT_LT(ends[2 * k], ends[2 * k + 1]);
    EXPECT_LT(ends[2 * k + 1], 36);
    EXPECT_EQ(time[k] == -1, mode[k] == 0);
  }
  EXPECT_EQ(std::count(mode.begin(), mode.end(), 1), 6);
  EXPECT_EQ(std::count(mode.begin(), mode.end(), 2), 1);
  EXPECT_EQ(std::count(force.begin(), force.end(), -100), 1);
}

TEST(View, WritesAllPicturesTheRunHasDataFor) {
  const TestFolder folder;
  write_lattice_run(folder);
  const ViewWritten written = write_view(read_run(folder.path()), folder / "view");
  std::set<std::string> names;
  for (const auto &file : written.files) {
    names.insert(file.filename().string());
    EXPECT_TRUE(std::filesystem::is_regular_file(file));
    if (file.extension() == ".svg") parsed(read_text_file(file));
  }
  EXPECT_EQ(names, (std::set<std::string>{"specimen.svg", "cracks_by_mode.svg",
                                          "cracks_by_time.svg", "displacement.svg", "fragments.svg",
                                          "particles.vtp", "bonds.vtp"}));
  std::string all;
  for (const std::string &sentence : written.missing) all += sentence;
  EXPECT_NE(all.find("No force chains"), std::string::npos);
}

TEST(View, PngNeedsItsProgram) {
  const TestFolder folder;
  const auto svg = folder.write("a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
  try {
    png_from_svg(svg, "no-such-program");
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(std::string(error.what()).find("librsvg2-bin"), std::string::npos);
  }
}

}  // namespace
}  // namespace bondlab
