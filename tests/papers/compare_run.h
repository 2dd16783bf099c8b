// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: run `bondlab compare` on a study of inputs/published as a user would, and read its table.
// Units: SI. Failure: the run's folder is left and named when a test fails. Limits: for tests only.
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "base/table_file.h"

namespace papers {

namespace fs = std::filesystem;

struct Row {
  double published = 0, ours = 0, sd = 0;  // published: not a number where nothing was
  int runs = 0;
  bool agrees = false;
};

class CompareRun : public ::testing::Test {
 protected:
  fs::path folder;
  void SetUp() override {
    folder = fs::temp_directory_path() / ("bondlab_published_" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder);
    else std::printf("the run is left in %s\n", folder.c_str());
  }

  int compare(const std::string &study, const std::string &words) {
    const std::string command = std::string("'") + BONDLAB_BIN + "' compare '" + BONDLAB_SOURCE_DIR + "/inputs/published/" + study +
                                "' " + words + " --out '" + folder.string() + "' > '" + (folder / "screen.txt").string() +
                                "' 2>&1 < /dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }

  std::string screen() const { return bondlab::read_text_file(folder / "screen.txt"); }

  // comparison.tsv by quantity, of one case
  std::map<std::string, Row> rows() const {
    const auto all = cases();
    EXPECT_EQ(all.size(), 1u);
    return all.begin()->second;
  }

  // [case][quantity]
  std::map<std::string, std::map<std::string, Row>> cases() const {
    std::map<std::string, std::map<std::string, Row>> result;
    std::istringstream in(bondlab::read_text_file(folder / "comparison.tsv"));
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line.rfind("case\tquantity\tunit\tpublished", 0), 0u);
    while (std::getline(in, line)) {
      std::istringstream fields(line);
      std::string name, quantity, unit, published, sd, ours, our_sd, runs, failed, difference, agrees;
      for (std::string *field : {&name, &quantity, &unit, &published, &sd, &ours, &our_sd, &runs, &failed, &difference, &agrees})
        std::getline(fields, *field, '\t');
      result[name][quantity] = {std::stod(published), std::stod(ours), std::stod(our_sd), std::stoi(runs), agrees == "yes"};
    }
    return result;
  }
};

}  // namespace papers
