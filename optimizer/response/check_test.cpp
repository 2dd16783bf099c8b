// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/check.h"

#include <gtest/gtest.h>

namespace bondlab {
namespace {

Study study_with(const std::string &function) {
  Study study;
  TestEntry test;
  test.name = "ucs";
  test.definition.responses["E"] = {"E", "Pa", function, Place{"test.toml", 12, 8}};
  study.tests.push_back(test);
  return study;
}

TEST(ResponseFunctions, KnownOnesPass) {
  EXPECT_NO_THROW(check_response_functions(study_with("uniaxial.peak_stress")));
}

TEST(ResponseFunctions, MistypedOneIsNamedWithItsPlaceAndTheNearest) {
  try {
    check_response_functions(study_with("uniaxial.peak_stres"));
    FAIL() << "no error";
  } catch (const UserError &error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("test.toml:12:8"), std::string::npos) << text;
    EXPECT_NE(text.find("did you mean 'uniaxial.peak_stress'"), std::string::npos) << text;
    EXPECT_NE(text.find("brazilian.tensile_strength"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace bondlab
