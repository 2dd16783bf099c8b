// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/further_tests.h"

#include <gtest/gtest.h>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "diagnose/score.h"
#include "diagnose/straight_model_for_tests.h"

namespace bondlab::diagnose {
namespace {

namespace fs = std::filesystem;

// A rock whose strength is measured in compression and in a Brazilian test, and might be in
// tension. Errors of conversion in the one and in the other then look alike, the strength being
// free.
class FurtherTests : public ::testing::Test {
 protected:
  static std::string study_text() {
    return read_text_file(fs::path(BONDLAB_SOURCE_DIR) / "inputs/studies/granite.toml") +
           "\n[[tests]]\nname = \"tension\"\ntest = \"direct_tension\"\nspecimen = "
           "\"compression\"\n"
           "variables = { dim = 2 }\n";
  }
  std::size_t index(const std::string &name) const {
    for (std::size_t k = 0; k < model.effects().size(); ++k)
      if (model.effects()[k].name == name) return k;
    throw std::runtime_error("no effect " + name);
  }
  Linearisation present() {
    Evidence evidence = evidence_of(study, measured(), model.emulated().centre_rows());
    for (auto &series : evidence.series) series.planned = 4;
    return linearise(model.emulated(), Whitening(without_data(evidence)),
                     model.emulated().centre());
  }
  std::vector<MeasuredSeries> measured() const {
    std::vector<MeasuredSeries> out;
    for (const std::string test : {"ucs", "brazilian"}) {
      MeasuredSeries s;
      s.probed = {test, test, {{CurvePart::peak, "log peak"}}};
      s.replicates.resize(0, 1);
      out.push_back(s);
    }
    return out;
  }
  void SetUp() override {
    model.start(probed(measured()));
    model.add_effects();
  }
  TestFolder folder;
  Study study = read_study(folder.write("study.toml", study_text()));
  std::vector<EffectDefinition> effects =
      read_effects(fs::path(BONDLAB_SOURCE_DIR) / "inputs" / "effects");
  StudyModel model{study, effects,
                   [](const Study &) {
                     return std::unique_ptr<ForwardModel>(std::make_unique<StraightModel>());
                   },
                   EmulatorPlan{8, 6, 0.12}};
};

TEST_F(FurtherTests, AreThoseOfTheStudyWithoutASeries) {
  EXPECT_EQ(tests_not_measured(study, measured()), std::vector<std::string>{"tension"});
}

TEST_F(FurtherTests, TheOneThatSeparatesTheRivalsIsFound) {
  const std::vector<std::size_t> rivals = {index("compression_conversion"),
                                           index("brazilian_conversion")};
  const std::vector<double> sizes = {4, 4};
  const auto now = present();
  const auto alone = advise(now, {true, true}, {{"none", {}}}, rivals, sizes);
  EXPECT_LT(alone.front().separation, 1e-6) << "nothing to separate: this test would show nothing";
  const auto advice = further_tests(model, {"tension"}, 4, now, rivals, sizes);
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_EQ(advice.front().test, "tension");
  EXPECT_GT(advice.front().separation, 2 * margin_needed);
  EXPECT_TRUE(advice.front().enough);
}

TEST_F(FurtherTests, OneThatShowsNothingOfThemIsNotEnough) {
  // Friction after the break is in no row of these straight curves.
  const std::vector<std::size_t> rivals = {index("residual_friction"), index("bond_gap")};
  const auto advice = further_tests(model, {"tension"}, 4, present(), rivals, {1, 1});
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_FALSE(advice.front().enough);
}

}  // namespace
}  // namespace bondlab::diagnose
