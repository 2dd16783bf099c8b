// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/write_file.h"

#include <gtest/gtest.h>

#include "base/table_file.h"
#include "base/test_folder.h"

namespace bondlab {
namespace {

TEST(WriteFile, ReplacesAFileWholeAndLeavesNothingBeside) {
  const TestFolder folder;
  write_file(folder / "a", "first");
  write_file(folder / "a", "second");
  EXPECT_EQ(read_text_file(folder / "a"), "second");
  int entries = 0;
  for (const auto &entry : std::filesystem::directory_iterator(folder.path()))
    entries += entry.exists();
  EXPECT_EQ(entries, 1);
}

TEST(WriteFile, NamesTheFileAndTheReason) {
  const TestFolder folder;
  try {
    write_file(folder / "none" / "a", "text");
    FAIL();
  } catch (const UserError &error) {
    EXPECT_EQ(error.place().file, (folder / "none" / "a").string());
    EXPECT_EQ(error.text(), "the file can't be written: No such file or directory");
  }
}

TEST(WriteFile, AFullDiskLeavesNoHalfAFile) {
  const std::filesystem::path full = "/dev/full";  // every write to it ends with "no space left"
  if (!std::filesystem::exists(full)) GTEST_SKIP();
  const TestFolder folder;
  // The temporary name is known: a link in its place sends the text to the full device.
  std::filesystem::create_symlink(
      full, (folder / "a").string() + "." + std::to_string(getpid()) + ".part");
  try {
    write_file(folder / "a", std::string(100000, 'x'));
    FAIL();
  } catch (const UserError &error) {
    EXPECT_EQ(error.text(), "the file can't be written: No space left on device");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(MakeFolder, NamesTheFolderAndTheReason) {
  const TestFolder folder;
  folder.write("file", "");
  EXPECT_THROW(make_folder(folder / "file" / "below"), UserError);
  EXPECT_NO_THROW(make_folder(folder / "a" / "b"));
}

}  // namespace
}  // namespace bondlab
