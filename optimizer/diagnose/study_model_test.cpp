// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_model.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace bondlab::diagnose
