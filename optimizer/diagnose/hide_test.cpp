// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/hide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "refine/emulator_for_tests.h"
#include "study/parameter_space.h"

namespace bondlab::diagnose {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Hide : public ::testing::Test {
 protected:
  Hide() {
    options.effects = {"compression_conversion"};
    options.sizes = {0.5};
    options.replicates = 3;
    options.spread = 0;
    factory = [this](const Study &) {
      auto model = std::make_unique<bondlab::testing::GraniteEmulator>();
      if (failing)
        model->fail = [](const ForwardRequest &) { return FailureCause::engine_crash; };
      return model;
    };
  }
  void hide(const TestFolder &out) { hide_effect(study, effects, factory, options, out.path()); }

  fs::path inputs = fs::path(BONDLAB_SOURCE_DIR) / "inputs";
  Study study = read_study(inputs / "studies" / "granite.toml");
  std::vector<EffectDefinition> effects = read_effects(inputs / "effects");
  HideOptions options;
  ModelFactory factory;
  bool failing = false;
};

std::map<std::string, std::string> files_in(const TestFolder &folder) {
  std::map<std::string, std::string> out;
  for (const auto &entry : fs::directory_iterator(folder.path()))
    out[entry.path().filename().string()] = read_text_file(entry.path());
  return out;
}

double peak(const MeasuredCurve &curve, const std::string &column) {
  const auto &v = curve.column(column);
  return *std::max_element(v.begin(), v.end());
}

TEST_F(Hide, MakesADataFolderWithEveryReplicateOfEveryTest) {
  const TestFolder out;
  hide(out);
  const DataFolder data = read_data_folder(out.path());
  ASSERT_EQ(data.measurements.size(), study.tests.size());
  for (std::size_t t = 0; t < data.measurements.size(); ++t) {
    const auto &m = data.measurements[t];
    EXPECT_EQ(m.test, study.tests[t].name);
    ASSERT_EQ(m.replicates.size(), 3u);
    for (const auto &replicate : m.replicates) EXPECT_EQ(replicate.column(m.y).size(), 101u);
    EXPECT_NE(m.replicates[0].column(m.y), m.replicates[1].column(m.y));
  }
}

TEST_F(Hide, SealsTheTruthBesideTheDataAndNotInThem) {
  const TestFolder out;
  options.spread = 0.3;
  hide(out);
  const auto files = files_in(out);
  const json sealed = json::parse(files.at("sealed_truth.json"));
  ASSERT_EQ(sealed["effects"].size(), 1u);
  EXPECT_EQ(sealed["effects"][0]["name"], options.effects[0]);
  EXPECT_EQ(sealed["effects"][0]["size"], options.sizes[0]);
  EXPECT_EQ(sealed["seed"], options.seed);
  const auto start = ParameterSpace(study.parameters).start().x;
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    const auto &p = study.parameters[i];
    const double value = sealed["parameters"].at(p.name);
    EXPECT_GT(value, p.lower);
    EXPECT_LT(value, p.upper);
    EXPECT_NE(value, start[i]);
  }
  for (const auto &[name, text] : files)
    if (name != "sealed_truth.json") {
      EXPECT_EQ(text.find(options.effects[0]), std::string::npos) << name;
    }
}

TEST_F(Hide, TheEffectIsInTheDataOfItsTestOnly) {
  const TestFolder with, without;
  hide(with);
  options.effects.clear(), options.sizes.clear();
  hide(without);
  const auto a = read_data_folder(with.path()), b = read_data_folder(without.path());
  for (std::size_t r = 0; r < 3; ++r)
    EXPECT_NEAR(peak(a.measurements[0].replicates[r], "axial_stress"),
                1.5 * peak(b.measurements[0].replicates[r], "axial_stress"), 1);
  EXPECT_NEAR(peak(a.measurements[1].replicates[0], "force_top"),
              peak(b.measurements[1].replicates[0], "force_top"), 1e-9);
  const json sealed = json::parse(files_in(without).at("sealed_truth.json"));
  EXPECT_TRUE(sealed["effects"].empty());
}

TEST_F(Hide, TheSameSeedGivesTheSameBytes) {
  const TestFolder first, second;
  options.spread = 0.3;
  hide(first);
  hide(second);
  EXPECT_EQ(files_in(first), files_in(second));
}

TEST_F(Hide, AnotherSeedGivesOtherNoiseOfASizeThatSensorsHave) {
  const TestFolder first, second;
  hide(first);
  options.seed = 2;
  hide(second);  // the emulator has no packings and the spread is none: only noise differs
  const auto a = read_data_folder(first.path()), b = read_data_folder(second.path());
  const double pa = peak(a.measurements[0].replicates[0], "axial_stress"),
               pb = peak(b.measurements[0].replicates[0], "axial_stress");
  EXPECT_NE(pa, pb);
  EXPECT_NEAR(pa, pb, 0.02 * pa);
}

TEST_F(Hide, AnEffectThatNoTestShowsIsRefusedWithTheNamesThatAre) {
  const TestFolder out;
  options.effects = {"gravity_of_the_moon"};
  try {
    hide(out);
    FAIL() << "not refused";
  } catch (const UserError &error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("gravity_of_the_moon"), std::string::npos);
    EXPECT_NE(what.find("bond_gap"), std::string::npos);
  }
}

TEST_F(Hide, TwoEffectsAreBothInTheData) {
  const TestFolder with, without;
  options.effects = {"compression_conversion", "brazilian_conversion"};
  options.sizes = {0.5, -0.2};
  hide(with);
  options.effects.clear(), options.sizes.clear();
  hide(without);
  const auto a = read_data_folder(with.path()), b = read_data_folder(without.path());
  EXPECT_NEAR(peak(a.measurements[0].replicates[0], "axial_stress"),
              1.5 * peak(b.measurements[0].replicates[0], "axial_stress"), 1);
  EXPECT_NEAR(peak(a.measurements[1].replicates[0], "force_top"),
              0.8 * peak(b.measurements[1].replicates[0], "force_top"), 1);
  EXPECT_EQ(json::parse(files_in(with).at("sealed_truth.json"))["effects"].size(), 2u);
}

TEST_F(Hide, ASizeForEachEffectIsAskedFor) {
  const TestFolder out;
  options.sizes.push_back(0.1);
  EXPECT_THROW(hide(out), UserError);
}

TEST_F(Hide, AnErrorOfMeasuringOutsideTheCatalogueIsInTheDataOfItsTestOnly) {
  const TestFolder with, without;
  for (auto &effect : read_effects(inputs / "hidden" / "outside")) effects.push_back(effect);
  options.effects = {"load_cell_end"};
  options.sizes = {0.2};
  hide(with);
  options.effects.clear(), options.sizes.clear();
  hide(without);
  const auto a = read_data_folder(with.path()), b = read_data_folder(without.path());
  EXPECT_NEAR(peak(a.measurements[0].replicates[0], "axial_stress"),
              0.8 * peak(b.measurements[0].replicates[0], "axial_stress"),
              0.01 * peak(b.measurements[0].replicates[0], "axial_stress"));
  EXPECT_EQ(files_in(with).at("brazilian_1.csv"), files_in(without).at("brazilian_1.csv"));
}

TEST_F(Hide, ConditionsAreThoseThatTheStudyAsksForWhateverIsHidden) {
  const TestFolder with, without;
  options.effects = {"virtual_rate"};
  options.sizes = {2};
  hide(with);
  options.effects.clear(), options.sizes.clear();
  hide(without);
  const auto a = read_data_folder(with.path()), b = read_data_folder(without.path());
  for (std::size_t t = 0; t < a.measurements.size(); ++t)
    EXPECT_EQ(a.measurements[t].conditions, b.measurements[t].conditions);
  EXPECT_GT(a.measurements[0].conditions.at("strain_rate"), 0);
  EXPECT_GT(a.measurements[0].conditions.at("size"), 0);
}

TEST_F(Hide, ARunThatFailsIsAnErrorAndNotAGapInTheData) {
  const TestFolder out;
  failing = true;
  EXPECT_THROW(hide(out), UserError);
  EXPECT_FALSE(fs::exists(out / "manifest.toml"));
}

}  // namespace
}  // namespace bondlab::diagnose
