// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the studies of inputs/real, from the command line: `bondlab check` finds nothing wrong with any, and
// their own effects are read beside those of inputs/effects. Their runs take a quarter of an hour each and
// are not made here. Units: none. Failure: what the program printed is shown.
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/test_folder.h"

namespace {

namespace fs = std::filesystem;

const fs::path kInputs = fs::path(BONDLAB_SOURCE_DIR) / "inputs";

struct Said {
  int status = -1;
  std::string text;
};

Said bondlab(const std::string &arguments) {
  const bondlab::TestFolder folder;
  const fs::path screen = folder / "screen.txt";
  const std::string command = std::string("'") + BONDLAB_BIN + "' " + arguments + " > '" +
                              screen.string() + "' 2>&1 < /dev/null";
  const int status = std::system(command.c_str());
  std::ifstream in(screen);
  std::ostringstream text;
  text << in.rdbuf();
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text.str()};
}

TEST(RealStudies, HaveNothingWrong) {
  int studies = 0;
  for (const auto &entry : fs::directory_iterator(kInputs / "real")) {
    if (entry.path().extension() != ".toml") continue;
    ++studies;
    const Said said = bondlab("check '" + entry.path().string() + "'");
    EXPECT_EQ(said.status, 0) << entry.path() << "\n" << said.text;
    EXPECT_NE(said.text.find("nothing wrong"), std::string::npos) << said.text;
  }
  EXPECT_GE(studies, 5);
}

TEST(RealStudies, TheirEffectsAreReadBesideTheCatalogue) {
  const bondlab::TestFolder folder;
  const Said said = bondlab("diagnose '" + (kInputs / "real/pmma.toml").string() + "' --effects '" +
                            (kInputs / "effects").string() + "' --effects '" +
                            (kInputs / "real/effects").string() + "' --only inertia,none_such --out '" +
                            (folder / "out").string() + "'");
  EXPECT_EQ(said.status, 1) << said.text;
  EXPECT_NE(said.text.find("no effect 'none_such'"), std::string::npos) << said.text;
  EXPECT_NE(said.text.find("creep_activation"), std::string::npos) << said.text;
  EXPECT_NE(said.text.find("platen_friction"), std::string::npos) << said.text;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
