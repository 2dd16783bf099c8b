// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/input_folders.h"

#include <algorithm>
#include <cstdlib>

namespace bondlab {

namespace fs = std::filesystem;

fs::path program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path();
}

std::vector<fs::path> input_folders() {
  std::vector<fs::path> candidates;
  if (const char *environment = std::getenv("BONDLAB_INPUTS")) candidates.emplace_back(environment);
  candidates.push_back(program_folder() / ".." / "share" / "bondlab" / "inputs");
#ifdef BONDLAB_DEFAULT_INPUTS
  candidates.emplace_back(BONDLAB_DEFAULT_INPUTS);
#endif
  std::vector<fs::path> folders;
  std::error_code error;
  for (const fs::path &folder : candidates)
    if (fs::is_directory(folder, error)) folders.push_back(fs::absolute(folder).lexically_normal());
  return folders;
}

fs::path find_test_folder(const std::string &name, const fs::path &study_folder) {
  std::error_code error;
  if (name.find('/') != std::string::npos) {
    const fs::path folder = study_folder / name;  // an absolute name stays as it is
    return fs::is_directory(folder, error) ? fs::absolute(folder).lexically_normal() : fs::path();
  }
  for (const fs::path &inputs : input_folders())
    if (fs::is_regular_file(inputs / name / "test.toml", error)) return inputs / name;
  return {};
}

std::vector<std::string> known_tests() {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::path &inputs : input_folders())
    for (const fs::directory_entry &entry : fs::directory_iterator(inputs, error))
      if (fs::is_regular_file(entry.path() / "test.toml", error))
        names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace bondlab
