// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_model.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "diagnose/straight_model_for_tests.h"

namespace bondlab::diagnose {
namespace {

namespace fs = std::filesystem;

const fs::path inputs = fs::path(BONDLAB_SOURCE_DIR) / "inputs";

// A trial takes another effect out of the catalogue for each case.
TEST(StudyModel, WhatIsForbiddenForOneCaseMayBeNamedInTheNext) {
  const Study study = read_study(inputs / "hidden" / "laboratory_weak.toml");
  StudyModel model(study, read_effects(inputs / "effects"),
                   [](const Study &) { return std::unique_ptr<ForwardModel>(); }, {});
  const auto sizes = [&](const std::string &name) {
    for (const auto &entry : model.catalogue())
      if (entry.name == name) return std::make_pair(entry.lowest, entry.largest);
    throw std::runtime_error("no effect " + name);
  };
  const auto tilt = sizes("tilt"), asymmetry = sizes("tension_modulus");
  ASSERT_GT(tilt.second, 0);
  ASSERT_LT(asymmetry.first, 0);
  const auto nothing = std::make_pair(0.0, 0.0);
  model.forbid([](const std::string &name) { return name == "tilt"; });
  EXPECT_EQ(sizes("tilt"), nothing);
  EXPECT_EQ(sizes("tension_modulus"), asymmetry);
  model.forbid([](const std::string &name) { return name == "tension_modulus"; });
  EXPECT_EQ(sizes("tilt"), tilt);
  EXPECT_EQ(sizes("tension_modulus"), nothing);
}

// Of ten packings one has no Brazilian test: its rows are kept. Of ten two: they are not.
class StudyModelStart : public StraightModelTest {
 protected:
  int rows(int packings_without) {
    const auto of_gap = [this, packings_without](const Study &) {
      auto out = std::make_unique<StraightModel>(model);
      out->lacks = [packings_without](const ForwardRequest &request) {
        return request.test == "brazilian" && request.packing < packings_without;
      };
      return std::unique_ptr<ForwardModel>(std::move(out));
    };
    EmulatorPlan plan{10, 6, 0.12};
    model.chaos = 0.02;
    StudyModel started(given, effects, of_gap, plan);
    started.start(series);
    return started.engine().rows();
  }
};

TEST_F(StudyModelStart, SaysByWhichStepsParametersAreChanged) {
  EmulatorPlan plan{10, 6};
  plan.pilot = 0.12;
  model.chaos = 0.02;
  const auto as_it_is = [this](const Study &) { return std::make_unique<StraightModel>(model); };
  StudyModel started(given, effects, as_it_is, plan);
  started.start(series);
  const double step = started.emulated().steps()[sigma_c];
  EXPECT_GT(step, 0.12);
  EXPECT_NE(started.steps_line().find(fmt::format("sigma_c {:.2f}", step)), std::string::npos);
  ModelPoint other = started.emulated().centre();
  other.z(sigma_c) += 0.1;
  started.move_to(other);
  EXPECT_EQ(started.emulated().steps()[sigma_c], step) << "no pilot at every move";
}

TEST_F(StudyModelStart, KeepsARowThatATenthOfThePackingsLacks) {
  const int all = rows(0);
  EXPECT_EQ(rows(1), all);
  EXPECT_LT(rows(2), all);
}

}  // namespace
}  // namespace bondlab::diagnose
