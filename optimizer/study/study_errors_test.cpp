// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every planted error of testdata/errors gives exactly the messages that stand beside it, with
// file, line and column.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "study/study.h"

namespace bondlab {
namespace {

namespace fs = std::filesystem;

const fs::path kTestdata = fs::path(__FILE__).parent_path() / "testdata";

struct PlantedError {
  std::string title, file = "good.toml";
  std::vector<std::pair<std::string, std::vector<std::string>>>
      edits;  // line taken out ("" appends), lines put in
  std::vector<std::string> messages;
};

void PrintTo(const PlantedError &planted, std::ostream *out) { *out << planted.title; }

std::vector<PlantedError> planted_errors() {
  std::vector<PlantedError> cases;
  for (const fs::directory_entry &entry : fs::directory_iterator(kTestdata / "errors")) {
    if (entry.path().extension() != ".txt") continue;
    std::istringstream lines(read_text_file(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      if (line.size() < 2 || line[0] == '#') continue;
      const std::string rest = line.substr(2);
      if (line[0] == '=') {
        cases.emplace_back();
        cases.back().title = entry.path().stem().string() + ": " + rest;
      } else if (line[0] == '@') {
        cases.back().file = rest;
      } else if (line[0] == '-') {
        cases.back().edits.push_back({rest, {}});
      } else if (line[0] == '+') {
        if (cases.back().edits.empty()) cases.back().edits.push_back({"", {}});
        cases.back().edits.back().second.push_back(rest);
      } else if (line[0] == '!') {
        cases.back().messages.push_back(rest);
      }
    }
  }
  std::sort(cases.begin(), cases.end(),
            [](const PlantedError &a, const PlantedError &b) { return a.title < b.title; });
  return cases;
}

class PlantedErrors : public testing::TestWithParam<PlantedError> {
 protected:
  void SetUp() override {
    fs::copy(kTestdata, folder_.path(), fs::copy_options::recursive);
    setenv("BONDLAB_INPUTS", folder_.path().c_str(), 1);
  }

  void edit(const PlantedError &planted) {
    std::istringstream lines(read_text_file(folder_ / planted.file));
    std::vector<bool> applied(planted.edits.size(), false);
    std::ostringstream edited;
    for (std::string line; std::getline(lines, line);) {
      std::size_t hit = planted.edits.size();
      for (std::size_t i = 0; i < planted.edits.size() && hit == planted.edits.size(); ++i)
        if (!applied[i] && !planted.edits[i].first.empty() && line == planted.edits[i].first)
          hit = i;
      if (hit == planted.edits.size()) {
        edited << line << '\n';
        continue;
      }
      applied[hit] = true;
      for (const std::string &put_in : planted.edits[hit].second) edited << put_in << '\n';
    }
    for (std::size_t i = 0; i < planted.edits.size(); ++i) {
      if (planted.edits[i].first.empty())
        for (const std::string &put_in : planted.edits[i].second) edited << put_in << '\n';
      else
        EXPECT_TRUE(applied[i]) << "no line '" << planted.edits[i].first << "' in " << planted.file;
    }
    std::ofstream(folder_ / planted.file) << edited.str();
  }

  std::string without_folder(std::string text) const {
    for (std::size_t at; (at = text.find(folder_.path().string() + "/")) != std::string::npos;)
      text.erase(at, folder_.path().string().size() + 1);
    return text;
  }

  TestFolder folder_;
};

TEST_P(PlantedErrors, IsReportedWithItsPlaceAndWhatIsAllowed) {
  const PlantedError &planted = GetParam();
  ASSERT_FALSE(planted.messages.empty());
  edit(planted);
  std::string messages;
  try {
    read_study(folder_ / "good.toml");
  } catch (const UserError &error) {
    messages = without_folder(error.what());
  }
  const std::string expected = join(planted.messages, "\n");
  if (expected.back() == '*')  // the rest of the sentence belongs to another room
    EXPECT_EQ(messages.substr(0, expected.size() - 1), expected.substr(0, expected.size() - 1))
        << planted.title << "\n"
        << messages;
  else
    EXPECT_EQ(messages, expected) << planted.title;
}

INSTANTIATE_TEST_SUITE_P(Planted, PlantedErrors, testing::ValuesIn(planted_errors()),
                         [](const auto &info) {
                           std::string name;
                           for (const char c : info.param.title)
                             name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace bondlab
