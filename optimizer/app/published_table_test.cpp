// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/published_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/table_file.h"
#include "base/test_folder.h"

namespace bondlab {
namespace {

// The sample study with two materials of three sizes each; a quantity follows c_group width^2.5.
Study sizes_study(const TestFolder &folder) {
  namespace fs = std::filesystem;
  fs::copy(fs::path(__FILE__).parent_path().parent_path() / "study" / "testdata", folder / "study",
           fs::copy_options::recursive);
  std::string text = read_text_file(folder / "study" / "good.toml");
  text +=
      "\n[compare]\npackings = 1\nrelative = \"yes\"\n"
      "[[quantities]]\nname = \"UCS\"\ntest = \"ucs\"\nresponse = \"UCS\"\nunit = \"MPa\"\n"
      "tolerance = \"10 %\"\nexponents = { width = 2.6 }\n";
  for (const char *group : {"soft", "hard"})
    for (const char *width : {"40", "50", "60"})
      text += std::string("[[cases]]\nname = \"") + group + width + "\"\ngroup = \"" + group +
              "\"\nset = { E_c = \"30 GPa\", sigma_c = \"100 MPa\" }\nspecimen = { width = \"" + width +
              " mm\" }\n" + (group == std::string("soft") ? "expect = { UCS = \"100 MPa\" }\n" : "");
  setenv("BONDLAB_INPUTS", (folder / "study").c_str(), 1);
  std::ofstream(folder / "study" / "sizes.toml") << text;
  return read_study(folder / "study" / "sizes.toml");
}

TEST(PublishedTable, a_case_has_specimens_and_tests_of_its_own) {
  const TestFolder folder;
  const Study study = sizes_study(folder);
  ASSERT_EQ(study.cases.size(), 6u);
  const TestEntry &own = study.test(study.cases[2].test("ucs"));
  EXPECT_EQ(own.name, "ucs@soft60");
  EXPECT_EQ(study.specimen(own.specimen).size.width, 0.06);
  EXPECT_EQ(study.specimen(own.specimen).size.height, study.specimen("slab").size.height);
  EXPECT_EQ(study.specimen("slab").size.width, 0.05) << "the study's own stays";
}

TEST(PublishedTable, exponents_have_a_constant_for_each_group) {
  const TestFolder folder;
  const Study study = sizes_study(folder);
  PublishedFigures figures(6);
  for (std::size_t k = 0; k < 6; ++k)
    figures[k]["UCS"].add((k < 3 ? 1e6 : 7e6) * std::pow(study.cases[k].sizes.at("width") / 0.05, 2.5));
  // without the last: in a balanced table one constant for all would give the same exponent
  const PublishedTables tables = published_tables(study, {0, 1, 2, 3, 4}, figures);
  EXPECT_NE(tables.page.find("Exponent of width: published 2.600, ours 2.500."), std::string::npos)
      << tables.page;
}

TEST(PublishedTable, what_was_not_published_stands_alone_and_is_not_judged) {
  const TestFolder folder;
  const Study study = sizes_study(folder);
  PublishedFigures figures(6);
  for (std::size_t k : {0, 3, 4}) figures[k]["UCS"].add(k == 4 ? 150e6 : 100e6);
  figures[0]["UCS"].add(104e6);
  const PublishedTables tables = published_tables(study, {0, 3, 4}, figures);
  EXPECT_NE(tables.page.find("| soft40 | 100 | 102 +- 2.828 (2) | +2.0 % | agrees | 1.000 |"), std::string::npos)
      << tables.page;
  EXPECT_NE(tables.page.find("| hard50 |  | 150 (1) |  |  | 1.500 |"), std::string::npos) << tables.page;
  EXPECT_NE(tables.page.find("1 of 1 agree."), std::string::npos);
  EXPECT_NE(tables.tsv.find("hard50\tUCS\tPa\tnan\t0\t150000000\t0\t1\t0\tnan\tunknown"), std::string::npos)
      << tables.tsv;
}

}  // namespace
}  // namespace bondlab
