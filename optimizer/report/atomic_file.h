// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: files of a result appear whole or not at all.
// Method: text goes to a temporary file in the same directory, is flushed to the disk and renamed
//   over the old file (POSIX rename is atomic). A directory of files is made beside the old one and
//   takes its name at the end.
// Units: none.
// Failure: UserError with the path and the system's reason; the temporary file is removed.
#pragma once

#include <filesystem>
#include <string>

namespace bondlab {

void write_whole_file(const std::filesystem::path &path, const std::string &text);

// A directory that is made in secret and shown at once. Destroyed without publish(), it leaves
// nothing behind.
class StagedDirectory {
 public:
  explicit StagedDirectory(const std::filesystem::path &final_path);
  ~StagedDirectory();
  StagedDirectory(const StagedDirectory &) = delete;
  StagedDirectory &operator=(const StagedDirectory &) = delete;

  const std::filesystem::path &path() const { return staging_; }
  void publish();  // replaces what stood at final_path

 private:
  std::filesystem::path final_, staging_;
};

}  // namespace bondlab
