// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/data_file.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/sha256.h"
#include "base/table_file.h"
#include "base/test_folder.h"
#include "specimen/specimen_json.h"
#include "specimen/test_packings.h"

namespace bondlab {
namespace {

// Four discs in a square, touching; z-order needn't matter here.
Specimen four_discs() {
  Specimen specimen;
  specimen.request.shape = ContainerShape::rectangle;
  specimen.request.width = 0.004;
  specimen.request.height = 0.004;
  specimen.request.r_min = 1e-3;
  specimen.particles = {
      {-1e-3, 1e-3, 0, 1e-3}, {1e-3, 1e-3, 0, 1e-3}, {-1e-3, 3e-3, 0, 1e-3}, {1e-3, 3e-3, 0, 1e-3}};
  specimen.densities = {2600, 2600, 2500, 2600};
  specimen.statistics = measure_packing(specimen.request.container(), specimen.particles);
  return specimen;
}

std::string first_line(const std::string &text) { return text.substr(0, text.find('\n')); }

std::string replaced(std::string text, const std::string &what, const std::string &by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

std::string complaint(const std::string &text) {
  const TestFolder folder;
  const std::filesystem::path file = folder.write("spoilt.data", text);
  try {
    read_packing_file(file);
  } catch (const UserError &error) {
    std::string what = error.what();
    for (std::size_t at; (at = what.find(folder.path().string() + "/")) != std::string::npos;)
      what.erase(at, folder.path().string().size() + 1);
    return what;
  }
  return "";
}

void expect_part(const std::string &text, const std::string &part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" without \"" << part << "\"";
}

TEST(DataFile, HasTheFormTheEngineReads) {
  const std::string text = data_file_text(four_discs());
  EXPECT_EQ(text.substr(text.find('\n')),
            "\n\n4 atoms\n1 atom types\n1 bond types\n\n-0.004 0.004 xlo xhi\n-0.002 0.006 ylo "
            "yhi\n-0.001 0.001 zlo zhi\n\n"
            "Atoms\n\n1 1 0.002 2600 -0.001 0.001 0\n2 1 0.002 2600 0.001 0.001 0\n3 1 0.002 2500 "
            "-0.001 0.003 0\n"
            "4 1 0.002 2600 0.001 0.003 0\n");
  EXPECT_EQ(first_line(text).rfind(
                "# bondlab specimen 1 "
                "{\"shape\":\"rectangle\",\"width\":0.004,\"height\":0.004,\"seed\":1,",
                0),
            0u);
}

TEST(DataFile, FirstLineNeverRunsOverTheEnginesBuffer) {
  Specimen specimen = four_discs();
  EXPECT_LT(first_line(data_file_text(specimen)).size(), 255u);
  SpecimenRequest &request = specimen.request;
  request.seed = std::numeric_limits<std::uint64_t>::max();
  request.width = 0.00123456789012;
  request.height = 1.23456789012e-05;
  request.r_min = 0.00012345678901234567;
  specimen.statistics.r_min = 1.23456789e-5;
  specimen.statistics.r_max = 1.23456789e-5;
  specimen.statistics.porosity = 0.123456789;
  specimen.statistics.count = 1999999;
  const std::string line = first_line(data_file_text(specimen));
  EXPECT_LT(line.size(), 255u);
  const auto metadata = parse_metadata_line(line.substr(line.find('{')));
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->request.seed, request.seed);
  EXPECT_EQ(metadata->request.width, request.width);
  EXPECT_EQ(metadata->key, specimen_key(request));
}

TEST(DataFile, BoxOfACylinderIsTwiceTheBody) {
  Specimen specimen = four_discs();
  specimen.request = small_cylinder();
  const TestFolder folder;
  write_data_file(specimen, folder / "a.data");
  const PackingFile packing = read_packing_file(folder / "a.data");
  const double lo[] = {-0.01, -0.01, -0.01}, hi[] = {0.01, 0.01, 0.03};
  for (int k = 0; k < 3; ++k) {
    EXPECT_DOUBLE_EQ(packing.box_lo[k], lo[k]);
    EXPECT_DOUBLE_EQ(packing.box_hi[k], hi[k]);
  }
}

TEST(DataFile, ReadsBackTheSameBits) {
  const TestFolder folder;
  const Specimen written = make_specimen(small_disc());
  write_data_file(written, folder / "disc.data");
  const Specimen read = read_data_file(folder / "disc.data");
  EXPECT_EQ(read.request.shape, written.request.shape);
  EXPECT_EQ(read.request.diameter, written.request.diameter);
  EXPECT_EQ(read.request.seed, written.request.seed);
  ASSERT_EQ(read.particles.size(), written.particles.size());
  for (std::size_t i = 0; i < read.particles.size(); ++i) {
    const Particle &a = read.particles[i], &b = written.particles[i];
    ASSERT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z && a.r == b.r) << i;
  }
  EXPECT_EQ(read.densities, written.densities);
  EXPECT_EQ(read.statistics.coordination, written.statistics.coordination);
  EXPECT_EQ(read.statistics.porosity_inner, written.statistics.porosity_inner);
}

TEST(DataFile, RecordKnowsKeyAndHash) {
  const TestFolder folder;
  write_data_file(four_discs(), folder / "four.data");
  const auto record = parse_specimen_record(read_text_file(folder / "four.json"));
  ASSERT_TRUE(record);
  EXPECT_EQ(record->key, specimen_key(four_discs().request));
  EXPECT_EQ(record->data_hash, sha256(read_text_file(folder / "four.data")));
  EXPECT_FALSE(parse_specimen_record("{\"key\":"));
  EXPECT_FALSE(parse_specimen_record("[]"));
  EXPECT_FALSE(parse_specimen_record("{\"key\":1}"));
}

TEST(DataFile, WritesNothingWhenItCannot) {
  const TestFolder folder;
  EXPECT_THROW(write_data_file(four_discs(), folder / "absent" / "a.data"), UserError);
  std::filesystem::create_directory(folder / "taken.data");
  EXPECT_THROW(write_data_file(four_discs(), folder / "taken.data"), UserError);
  EXPECT_THROW(write_data_file(four_discs(), folder / "a.json"), UserError);
  for (const auto &entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename(), "taken.data");
}

TEST(DataFile, RowsInAnyOrderAreSortedById) {
  const TestFolder folder;
  std::string text = data_file_text(four_discs());
  text = replaced(text, "\n1 1 0.002", "\n9 1 0.002");
  text = replaced(text, "\n2 1 0.002", "\n1 1 0.002");
  text = replaced(text, "\n9 1 0.002", "\n2 1 0.002");
  const Specimen read = read_data_file(folder.write("a.data", text));
  EXPECT_EQ(read.particles[0].x, 1e-3);
  EXPECT_EQ(read.particles[1].x, -1e-3);
}

TEST(DataFile, ErrorsNameTheLineAndColumn) {
  const std::string text = data_file_text(four_discs());
  EXPECT_EQ(complaint(text), "");
  expect_part(complaint(replaced(text, "2500 -0.001", "2500 x0.001")),
              "spoilt.data:15:16: x is \"x0.001\" (allowed: a finite number)");
  expect_part(complaint(replaced(text, "2500 -0.001", "2500 nan")),
              "spoilt.data:15:16: x is \"nan\"");
  expect_part(complaint(replaced(text, "2500 -0.001", "2500 inf")),
              "spoilt.data:15:16: x is \"inf\"");
  expect_part(complaint(replaced(text, "3 1 0.002 2500", "3 1 -0.002 2500")),
              "spoilt.data:15:5: diameter is -0.002 m (allowed: > 0)");
  expect_part(complaint(replaced(text, "3 1 0.002 2500", "3 1 0.002 0")),
              "spoilt.data:15:11: density is 0 kg/m3");
  expect_part(complaint(replaced(text, "3 1 0.002 2500", "3.5 1 0.002 2500")),
              "spoilt.data:15:1: id is \"3.5\"");
  expect_part(complaint(replaced(text, "3 1 0.002 2500", "0 1 0.002 2500")),
              "spoilt.data:15:1: id is 0 (allowed: 1 and up)");
  expect_part(complaint(replaced(text, "3 1 0.002 2500", "2 1 0.002 2500")),
              "spoilt.data:15:1: id 2 stands already in line 14");
  expect_part(complaint(replaced(text, "3 1 0.002 2500", "3 1 0.002")),
              "spoilt.data:15:1: 6 columns (allowed: 7");
  expect_part(complaint(replaced(text, "4 atoms", "5 atoms")),
              "the header says 5 atoms, the file has 4");
  expect_part(complaint(replaced(text, "4 atoms\n", "")), "the line `N atoms` is missing");
  expect_part(complaint(replaced(text, "-0.002 0.006 ylo yhi\n", "")),
              "the box bounds ylo yhi are missing");
  expect_part(complaint(replaced(text, "-0.002 0.006 ylo", "0.006 0.006 ylo")),
              "spoilt.data:8:1: ylo is not below yhi");
  expect_part(complaint(replaced(text, "1 bond types", "1 angle types")),
              "spoilt.data:5:1: not a line of a specimen file");
  expect_part(complaint(text.substr(0, text.find("Atoms"))),
              "the file ends before its Atoms section");
  expect_part(complaint(replaced(text, "{\"shape\"", "{shape\"")),
              "spoilt.data:1: the specimen's description is damaged");
  expect_part(complaint(replaced(text, "\"rectangle\"", "\"cube\"")),
              "spoilt.data:1: the specimen's description is damaged");
}

TEST(DataFile, AllErrorsAtOnce) {
  std::string text = replaced(data_file_text(four_discs()), "2500 -0.001", "2500 x");
  text = replaced(text, "4 1 0.002", "4 1 zero");
  const std::string all = complaint(text);
  expect_part(all, "spoilt.data:15:");
  expect_part(all, "spoilt.data:16:");
}

TEST(DataFile, TruncatedFileIsAnError) {
  const std::string text = data_file_text(four_discs());
  EXPECT_NE(complaint(text.substr(0, text.size() - 30)), "");
  EXPECT_NE(complaint(""), "");
}

TEST(DataFile, IdsMustBeCompleteToBeReadAsASpecimen) {
  const TestFolder folder;
  const std::string text = replaced(data_file_text(four_discs()), "\n4 1 0.002", "\n7 1 0.002");
  EXPECT_THROW(read_data_file(folder.write("gap.data", text)), UserError);
  const std::string plain = "made elsewhere" + text.substr(text.find('\n'));
  EXPECT_THROW(read_data_file(folder.write("plain.data", plain)), UserError);
  EXPECT_EQ(read_packing_file(folder / "plain.data").rows.size(),
            4u);  // but its particles can be looked at
}

TEST(Xyzr, ReadsParticlesInSpaceFillingOrder) {
  const TestFolder folder;
  const auto file = folder.write("grains.xyzr",
                                 "# x y z r\n1e-3 3e-3 0 1e-3\n-1e-3 1e-3 0 1e-3\n\n1e-3 1e-3 0 "
                                 "1e-3  # corner\n-1e-3 3e-3 0 1e-3\n");
  SpecimenRequest request = four_discs().request;
  request.density = 2700;
  const Specimen specimen = read_xyzr(file, request);
  ASSERT_EQ(specimen.particles.size(), 4u);
  const std::vector<Particle> expected = four_discs().particles;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(specimen.particles[i].x, expected[i].x);
    EXPECT_EQ(specimen.particles[i].y, expected[i].y);
  }
  EXPECT_EQ(specimen.densities[3], 2700);
  EXPECT_EQ(specimen.request.r_min, 1e-3);
  EXPECT_EQ(specimen.statistics.count, 4u);
}

TEST(Xyzr, ErrorsNameTheLine) {
  const TestFolder folder;
  const auto complain = [&](const std::string &text) {
    try {
      read_xyzr(folder.write("a.xyzr", text), small_rectangle());
    } catch (const UserError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  expect_part(complain("0 0 0 1e-3\n0 0 0\n"), "a.xyzr:2:1: 3 columns (allowed: 4: x y z r)");
  expect_part(complain("0 0 0 -1e-3\n"), "a.xyzr:1:7: r is -0.001 m (allowed: > 0)");
  expect_part(complain("0 nan 0 1e-3\n"), "a.xyzr:1:3: y is \"nan\"");
  expect_part(complain("# nothing\n"), "no particles");
}

}  // namespace
}  // namespace bondlab
