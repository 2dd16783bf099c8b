// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/model_with_effect.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <sstream>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "diagnose/forward_prober.h"

namespace bondlab::diagnose {
namespace {

namespace fs = std::filesystem;

const fs::path inputs = fs::path(BONDLAB_SOURCE_DIR) / "inputs";

class ModelWithEffect : public ::testing::Test {
 protected:
  const EffectDefinition &effect(const std::string &name) const {
    for (const auto &e : effects)
      if (e.name == name) return e;
    throw std::runtime_error("no effect " + name);
  }
  Study written(const std::string &text) const {
    return read_study(folder.write("with_effect.toml", text));
  }
  // Tests are found from BondLab's own inputs, wherever the study file lies.
  TestFolder folder;
  Study study = read_study(inputs / "studies" / "granite.toml");
  std::vector<EffectDefinition> effects =
      effects_of_study(study, read_effects(inputs / "effects"));
  std::vector<double> values = {25.5e9, 2.1, 43e6};
};

std::vector<std::string> lines_of(const std::string &text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST_F(ModelWithEffect, IsAStudyThatReadsWithEveryEffectOfTheCatalogue) {
  ASSERT_GT(effects.size(), 8u);
  const auto catalogue = catalogue_of(study, effects);
  for (std::size_t k = 0; k < effects.size(); ++k) {
    SCOPED_TRACE(effects[k].name);
    try {
      const Study read =
          written(study_with_effects(study, {{effects[k], catalogue[k].switch_on}}, values));
      EXPECT_EQ(read.tests.size(), study.tests.size());
    } catch (const std::exception &error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST_F(ModelWithEffect, StartsFromTheRefittedParameters) {
  const Study read = written(study_with_effects(study, {}, values));
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_TRUE(read.parameters[i].start);
    EXPECT_NEAR(*read.parameters[i].start, values[i], 1e-7 * values[i]);
  }
}

TEST_F(ModelWithEffect, WorksOutAShareFromEachTestsOwnValueAndKeepsTheOthers) {
  const Study read = written(study_with_effects(study, {{effect("bond_gap"), 0.25}}, values));
  for (const std::string name : {"ucs", "brazilian"}) {
    const auto &now = read.test(name).variables, &then = study.test(name).variables;
    EXPECT_NEAR(now.at("gap").number, 1.25 * then.at("gap").number, 1e-8 * 1e-4);
    EXPECT_EQ(now.size(), then.size());
    for (const auto &[variable, value] : then)
      if (variable != "gap") {
        EXPECT_EQ(now.at(variable).text(), value.text()) << variable;
      }
  }
}

TEST_F(ModelWithEffect, ChangesNoLineButTheTestsVariablesAndTheStarts) {
  const auto text = study_with_effects(study, {{effect("bond_gap"), 0.25}}, values);
  const auto diff = lines_of(readable_diff(study.source_text, text));
  int removed = 0, added = 0;
  for (const auto &line : diff) {
    const bool variables = line.find("variables = {") != std::string::npos;
    const bool start = line.find("+ start = ") != std::string::npos;
    EXPECT_TRUE(variables || start) << line;
    ++(line[6] == '-' ? removed : added);
  }
  EXPECT_EQ(removed, 2);    // one line a test
  EXPECT_EQ(added, 2 + 3);  // and a start a parameter
}

TEST_F(ModelWithEffect, TakesFromAParameterTheVariableThatTheEffectSets) {
  const Study read =
      written(study_with_effects(study, {{effect("grain_contact_stiffness"), 0.2}}, values));
  EXPECT_EQ(read.parameter("E_c").sets, std::vector<std::string>{"E_b"});
  for (const auto &test : read.tests)
    EXPECT_NEAR(test.variables.at("E_c").number, 1.2 * values[0], 1e-7 * values[0]);
  // What the engine would get is what the diagnosis ran.
  EXPECT_NEAR(deck_variables(read, "ucs", values).at("E_b"), values[0], 1);
}

TEST_F(ModelWithEffect, LeavesAConversionErrorToAPersonAsAComment) {
  const auto text =
      study_with_effects(study, {{effect("compression_conversion"), 0.07}}, values);
  EXPECT_NE(text.find("# " + effect("compression_conversion").title), std::string::npos);
  const Study read = written(text);
  for (const auto &test : study.tests)
    for (const auto &[variable, value] : test.variables)
      EXPECT_EQ(read.test(test.name).variables.at(variable).text(), value.text()) << variable;
}

TEST(ReadableDiff, ListsExactlyTheChangedLines) {
  EXPECT_EQ(readable_diff("a\nb\nc\n", "a\nb\nc\n"), "");
  EXPECT_EQ(readable_diff("a\nb\nc\n", "a\nB\nc\nd\n"), "    2 - b\n      + B\n      + d\n");
  EXPECT_EQ(readable_diff("a\nb\n", "b\n"), "    1 - a\n");
}

TEST(ReadableDiff, ShowsOfALongTableOnlyWhatIsAboutTheChange) {
  std::string front = "variables = { first = 1";
  for (int k = 0; k < 12; ++k) front += fmt::format(", number_{} = {}", k, k);
  const auto diff = readable_diff(front + " }\n", front + ", stiffness = 7 }\n");
  EXPECT_EQ(diff,
            "    1 - variables = { ... number_10 = 10, number_11 = 11 }\n"
            "      + variables = { ... number_10 = 10, number_11 = 11, stiffness = 7 }\n");
}

TEST_F(ModelWithEffect, ReadsItsDataAndDecksFromAnotherFolder) {
  const auto file = folder.write(
      "study.toml",
      "[[tests]]\nname = \"own\"\ntest = \"decks/own\"\n\n[[tests]]\nname = \"ucs\"\n"
      "test = \"uniaxial_compression\"\n\n[data]\nfolder = \"data\"\n");
  const auto out = file.parent_path() / "results" / "one";
  const auto moved = moved_study(read_text_file(file), file, out);
  EXPECT_NE(moved.find("test = \"../../decks/own\"\n"), std::string::npos) << moved;
  EXPECT_NE(moved.find("test = \"uniaxial_compression\"\n"), std::string::npos) << moved;
  EXPECT_NE(moved.find("folder = \"../../data\"\n"), std::string::npos) << moved;
}

}  // namespace
}  // namespace bondlab::diagnose
