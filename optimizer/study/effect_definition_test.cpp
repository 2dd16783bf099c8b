// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/effect_definition.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "study/test_definition.h"

namespace bondlab {
namespace {

namespace fs = std::filesystem;

class Effects : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("bondlab_effects_" + std::to_string(::getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string &name, const std::string &text) {
    std::ofstream(folder_ / (name + ".toml")) << text;
  }
  std::string complaint() const {
    try {
      read_effects(folder_);
    } catch (const std::exception &error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

const char *const good = R"(schema = 1
name = "own"
title = "A user's own"
kind = "machine"
expected = ["uniaxial_compression: peak up"]
separating_test = "another length"

[size]
name = "platen_mu"
unit = "1"
switch_on = 0.05
lowest = 0
largest = 1

[[sets]]
variable = "platen_mu"
rule = "add"
)";

std::string changed(const std::string &from, const std::string &to) {
  std::string text = good;
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST_F(Effects, UserAddsOneByOneFile) {
  write("own", good);
  const auto effects = read_effects(folder_);
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0].name, "own");
  EXPECT_EQ(effects[0].kind, "machine");
  EXPECT_DOUBLE_EQ(effects[0].switch_on, 0.05);
  ASSERT_EQ(effects[0].sets.size(), 1u);
  bool touched = false;
  EXPECT_DOUBLE_EQ(with_effect(effects[0], 0.2, {{"platen_mu", 0.3}}, touched).at("platen_mu"),
                   0.5);
  EXPECT_TRUE(touched);
  EXPECT_TRUE(with_effect(effects[0], 0.2, {{"mu", 0.3}}, touched) ==
              (std::map<std::string, double>{{"mu", 0.3}}));
  EXPECT_FALSE(touched);
  with_effect(effects[0], 0, {{"platen_mu", 0.3}}, touched);
  EXPECT_FALSE(touched);
}

TEST_F(Effects, EveryRuleDoesWhatItSays) {
  const std::map<std::string, double> without = {{"platen_mu", 0.4}};
  const std::vector<std::pair<std::string, double>> rules = {
      {"set", 0.25}, {"inverse", 4}, {"add", 0.65}, {"scale", 0.5}, {"scale_inverse", 0.32}};
  for (const auto &[rule, expected] : rules) {
    write("own", changed("rule = \"add\"", "rule = \"" + rule + "\""));
    bool touched = false;
    EXPECT_NEAR(with_effect(read_effects(folder_)[0], 0.25, without, touched).at("platen_mu"),
                expected, 1e-12)
        << rule;
  }
}

TEST_F(Effects, ANumberThatGoesWithTheEffectIsSetWhateverTheSizeAndOnlyWithIt) {
  write("own", changed("rule = \"add\"", "rule = \"fixed\"\nunit = \"MPa\"\nvalue = \"3 MPa\""));
  const auto effect = read_effects(folder_)[0];
  bool touched = false;
  for (const double size : {0.1, 0.7})
    EXPECT_DOUBLE_EQ(with_effect(effect, size, {{"platen_mu", 1}}, touched).at("platen_mu"), 3e6);
  EXPECT_DOUBLE_EQ(with_effect(effect, 0, {{"platen_mu", 1}}, touched).at("platen_mu"), 1);
  write("own", changed("rule = \"add\"", "rule = \"fixed\""));
  EXPECT_NE(complaint().find("value"), std::string::npos) << complaint();
}

TEST_F(Effects, AVariableAboveZeroKeepsAnEffectAwayFromItsTest) {
  write("own", changed("rule = \"add\"", "rule = \"add\"\nunless = \"pressure\""));
  const auto effect = read_effects(folder_)[0];
  const auto at = [&](double pressure) {
    bool touched = false;
    const auto out = with_effect(effect, 0.2, {{"platen_mu", 0.3}, {"pressure", pressure}}, touched);
    EXPECT_EQ(touched, pressure == 0);
    return out.at("platen_mu");
  };
  EXPECT_DOUBLE_EQ(at(0), 0.5);
  EXPECT_DOUBLE_EQ(at(1e6), 0.3);
}

TEST_F(Effects, AnErrorOfMeasuringNeedsNoDeckVariable) {
  write("own", changed("[[sets]]\nvariable = \"platen_mu\"\nrule = \"add\"\n",
                       "[[measures]]\ncolumns = \"loads\"\ntest = \"brazilian\"\nrule = \"drift\"\n"));
  const auto effects = read_effects(folder_);
  ASSERT_EQ(effects[0].measures.size(), 1u);
  EXPECT_EQ(effects[0].measures[0].columns, "loads");
  EXPECT_EQ(effects[0].measures[0].test, "brazilian");
  EXPECT_EQ(effects[0].measures[0].rule, MeasuringRule::drift);
  write("own", changed("[[sets]]\nvariable = \"platen_mu\"\nrule = \"add\"\n",
                       "[[measures]]\ncolumns = \"loads\"\nrule = \"wander\"\n"));
  EXPECT_NE(complaint().find("saturate"), std::string::npos) << complaint();
}

TEST_F(Effects, ErrorsNameFileLineAndWhatIsAllowed) {
  const std::vector<std::array<std::string, 3>> cases = {
      {"kind = \"machine\"", "kind = \"magic\"", "own.toml:4"},
      {"switch_on = 0.05", "switch_on = 0", "own.toml:11"},
      {"lowest = 0", "lowest = 0.1", "own.toml:12"},
      {"largest = 1", "largest = 0.01", "own.toml:13"},
      {"rule = \"add\"", "rule = \"ad\"", "own.toml:17"},
      {"name = \"own\"", "name = \"other\"", "own.toml:2"},
      {"title = ", "tilte = ", "own.toml:3"},
      {"separating_test = \"another length\"",
       "separating_test = \"another length\"\nconfused_with = [\"nobody\"]", "nobody"}};
  for (const auto &[from, to, where] : cases) {
    write("own", changed(from, to));
    EXPECT_NE(complaint().find(where), std::string::npos) << to << "\n" << complaint();
  }
  write("own", changed("[[sets]]\nvariable = \"platen_mu\"\nrule = \"add\"\n", ""));
  EXPECT_NE(complaint().find("changes nothing"), std::string::npos) << complaint();
}

// The files that come with BondLab: readable, and every variable they set is one of a deck's.
TEST(ShippedEffects, SetVariablesThatDecksHave) {
  const fs::path inputs = fs::path(BONDLAB_SOURCE_DIR) / "inputs";
  ErrorCollector errors;
  std::vector<TestDefinition> tests;
  for (const auto &entry : fs::directory_iterator(inputs))
    if (fs::exists(entry.path() / "test.toml"))
      tests.push_back(read_test_definition(entry.path(), errors));
  auto effects = read_effects(inputs / "effects");
  EXPECT_GE(effects.size(), 18u);
  const auto outside = read_effects(inputs / "hidden" / "outside");
  EXPECT_GE(outside.size(), 5u);
  for (const auto &effect : outside) {
    for (const auto &inside : effects) EXPECT_NE(effect.name, inside.name);
    for (const auto &error : effect.measures)
      EXPECT_TRUE(error.test.empty() || std::any_of(tests.begin(), tests.end(),
                                                    [&](const auto &t) { return t.name == error.test; }))
          << effect.name << ": " << error.test;
  }
  effects.insert(effects.end(), outside.begin(), outside.end());
  for (const auto &effect : effects) {
    for (const auto &setting : effect.sets) {
      const bool known = std::any_of(tests.begin(), tests.end(), [&](const TestDefinition &t) {
        return t.variables.count(setting.variable) > 0;
      });
      EXPECT_TRUE(known) << effect.name << ": " << setting.variable;
    }
    if (!effect.scales_test.empty()) {
      const bool known = std::any_of(tests.begin(), tests.end(), [&](const TestDefinition &t) {
        return t.name == effect.scales_test;
      });
      EXPECT_TRUE(known) << effect.name << ": " << effect.scales_test;
    }
  }
}

}  // namespace
}  // namespace bondlab
