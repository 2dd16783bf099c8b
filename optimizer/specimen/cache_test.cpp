// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/cache.h"

#include <gtest/gtest.h>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "base/user_error.h"
#include "specimen/test_packings.h"

namespace bondlab {
namespace {

class SpecimenCache : public ::testing::Test {
 protected:
  // How often a packing was made.
  std::filesystem::path ensure(const SpecimenRequest &request = small_disc()) {
    return ensure_specimen(request, folder_ / "specimens",
                           [this](const SpecimenProgress &progress) {
                             if (progress.fraction == 1) ++made_;
                           });
  }
  std::filesystem::path record(std::filesystem::path data) {
    return data.replace_extension(".json");
  }
  void spoil(const std::filesystem::path &file, const std::string &text) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
  }

  TestFolder folder_;
  int made_ = 0;
};

TEST_F(SpecimenCache, MakesOnceAndThenReuses) {
  const std::filesystem::path first = ensure();
  EXPECT_EQ(first, folder_ / "specimens" / ("disc-" + specimen_key(small_disc()) + ".data"));
  const std::string text = read_text_file(first);
  EXPECT_EQ(ensure(), first);
  EXPECT_EQ(made_, 1);
  EXPECT_EQ(read_text_file(first), text);
  SpecimenRequest other = small_disc();
  other.seed = 2;
  EXPECT_NE(ensure(other), first);
  EXPECT_EQ(made_, 2);
}

TEST_F(SpecimenCache, RebuildsACorruptedFile) {
  const std::filesystem::path file = ensure();
  const std::string good = read_text_file(file);
  std::string bad = good;
  bad[bad.size() / 2] ^= 1;
  spoil(file, bad);
  ensure();
  EXPECT_EQ(made_, 2);
  EXPECT_TRUE(read_text_file(file) == good);
}

TEST_F(SpecimenCache, RebuildsATruncatedOrMissingFile) {
  const std::filesystem::path file = ensure();
  const std::string good = read_text_file(file);
  spoil(file, good.substr(0, good.size() - 40));
  ensure();
  EXPECT_EQ(made_, 2);
  std::filesystem::remove(file);
  ensure();
  EXPECT_EQ(made_, 3);
  EXPECT_TRUE(read_text_file(file) == good);
}

TEST_F(SpecimenCache, RebuildsWithoutAGoodRecord) {
  const std::filesystem::path file = ensure();
  const std::string good = read_text_file(record(file));
  std::filesystem::remove(record(file));
  ensure();
  EXPECT_EQ(made_, 2);
  spoil(record(file), "{\"key\": ");
  ensure();
  EXPECT_EQ(made_, 3);
  std::string other_key = good;
  other_key.replace(other_key.find(specimen_key(small_disc())), 4, "0000");
  spoil(record(file), other_key);
  ensure();
  EXPECT_EQ(made_, 4);
  EXPECT_TRUE(read_text_file(record(file)) == good);
}

TEST_F(SpecimenCache, LeavesNothingButTheFileAndItsRecord) {
  ensure();
  int files = 0;
  for (const auto &entry : std::filesystem::directory_iterator(folder_ / "specimens")) {
    (void)entry;
    ++files;
  }
  EXPECT_EQ(files, 2);
}

TEST_F(SpecimenCache, BadRequestOrDirectoryIsAnError) {
  SpecimenRequest bad = small_disc();
  bad.diameter = -1;
  EXPECT_THROW(ensure(bad), UserError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "specimens"));
  folder_.write("specimens", "a file where the directory should be");
  EXPECT_THROW(ensure(), UserError);
}

}  // namespace
}  // namespace bondlab
