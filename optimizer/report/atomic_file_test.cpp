// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/atomic_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "base/user_error.h"

namespace bondlab {
namespace {

namespace fs = std::filesystem;

long entries(const fs::path &folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(WholeFile, ReplacesTheOldTextAndLeavesNothingElse) {
  TestFolder folder;
  write_whole_file(folder / "a", "one");
  write_whole_file(folder / "a", std::string("two\0three", 9));
  EXPECT_EQ(read_text_file(folder / "a"), std::string("two\0three", 9));
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(WholeFile, NamesThePathItCantWrite) {
  TestFolder folder;
  try {
    write_whole_file(folder / "none" / "a", "x");
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(std::string(error.what()).find("none"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
  }
  fs::create_directories(folder / "taken" / "inner");
  EXPECT_THROW(write_whole_file(folder / "taken", "x"), UserError);
  EXPECT_EQ(entries(folder.path()), 1);  // no temporary file is left
  EXPECT_THROW(read_text_file(folder / "none"), UserError);
}

TEST(StagedDirectory, ShowsAllOrNothing) {
  TestFolder folder;
  folder.write("p/old", "old");
  {
    StagedDirectory staged(folder / "p");
    write_whole_file(staged.path() / "new", "new");
    EXPECT_TRUE(fs::exists(folder / "p" / "old"));
  }
  EXPECT_TRUE(fs::exists(folder / "p" / "old"));
  EXPECT_EQ(entries(folder.path()), 1);
  StagedDirectory staged(folder / "p");
  write_whole_file(staged.path() / "new", "new");
  staged.publish();
  EXPECT_FALSE(fs::exists(folder / "p" / "old"));
  EXPECT_TRUE(fs::exists(folder / "p" / "new"));
  EXPECT_EQ(entries(folder.path()), 1);
}

}  // namespace
}  // namespace bondlab
