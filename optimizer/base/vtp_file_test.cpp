// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/vtp_file.h"

#include <gtest/gtest.h>

#include <functional>

#include "base/test_folder.h"
#include "base/user_error.h"

namespace bondlab {
namespace {

VtpData three_points() {
  VtpData data;
  data.points = {0, 0, 0, 0.1, -2.5e-7, 3, 1.0 / 3, 1e300, -0.0};
  data.point_data = {{"radius_m", 1, false, {0.5, 1.0 / 3, 2}},
                     {"id", 1, true, {7, 8, -9}},
                     {"moved", 3, false, {1, 2, 3, 4, 5, 6, 7, 8, 9}}};
  return data;
}

TEST(VtpFile, ReadsBackTheSameBits) {
  const TestFolder folder;
  const VtpData data = three_points();
  const VtpData again = read_vtk_points(folder.write("points.vtp", vtp_text(data)));
  EXPECT_EQ(again.points, data.points);
  ASSERT_EQ(again.point_data.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(again.point_data[k].name, data.point_data[k].name);
    EXPECT_EQ(again.point_data[k].components, data.point_data[k].components);
    EXPECT_EQ(again.point_data[k].values, data.point_data[k].values);
  }
  EXPECT_NE(again.find("id"), nullptr);
  EXPECT_EQ(again.find("nothing"), nullptr);
}

// As ParaView and other programs write: other attribute order, comments, cells first, both kinds.
TEST(VtpFile, ReadsUnstructuredGridsOfOtherPrograms) {
  const TestFolder folder;
  const auto file = folder.write(
      "grid.vtu",
      "<?xml version='1.0'?>\n<!-- <Points> of another program -->\n"
      "<VTKFile version='0.1' type='UnstructuredGrid'>\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints='2' NumberOfCells='0'>\n<Cells><DataArray Name='connectivity' "
      "format='binary'>AAAA</DataArray></Cells>\n"
      "<PointData Scalars='radius'><DataArray format='ascii' type='Float32' Name='radius'>\n0.5 "
      "0.25</DataArray></PointData>\n<Points><DataArray type='Float32' NumberOfComponents='3' "
      "format='ascii'>\n0 1 2 3 4 5\n</DataArray></Points>\n</Piece>\n</UnstructuredGrid>\n"
      "</VTKFile>\n");
  const VtpData data = read_vtk_points(file);
  EXPECT_EQ(data.points, (std::vector<double>{0, 1, 2, 3, 4, 5}));
  ASSERT_NE(data.find("radius"), nullptr);
  EXPECT_EQ(data.find("radius")->values, (std::vector<double>{0.5, 0.25}));
}

std::string complaint(const std::function<void(std::string &)> &spoil) {
  const TestFolder folder;
  std::string text = vtp_text(three_points());
  spoil(text);
  try {
    read_vtk_points(folder.write("bad.vtp", text));
  } catch (const UserError &error) {
    return error.what();
  }
  return "";
}

void replace(std::string &text, const std::string &old, const std::string &fresh) {
  ASSERT_NE(text.find(old), std::string::npos);
  text.replace(text.find(old), old.size(), fresh);
}

TEST(VtpFile, SaysWhatItCantRead) {
  const auto expect = [](const std::string &text, const std::string &part) {
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" without " << part;
  };
  expect(complaint([](std::string &t) { replace(t, "\"ascii\"", "\"appended\""); }),
         "is stored as 'appended' (allowed: ascii");
  expect(complaint([](std::string &t) { replace(t, "0.5\n", "half\n"); }),
         "value 1 of the array 'radius_m' isn't a finite number");
  expect(complaint([](std::string &t) { replace(t, "0.5\n", ""); }), "has 2 values for 3 points");
  expect(complaint([](std::string &t) { replace(t, "PolyData\"", "ImageData\""); }),
         "the file holds 'ImageData'");
  expect(complaint([](std::string &t) { t = "x y z r\n"; }), "not a VTK XML file");
  expect(complaint([](std::string &t) { t.resize(t.size() / 6); }), "bad.vtp");
}

}  // namespace
}  // namespace bondlab
