// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/result_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/test_folder.h"
#include "base/user_error.h"
#include "report/example_for_tests.h"

namespace bondlab {
namespace {

using Json = nlohmann::ordered_json;

std::string error_of(const std::string &text) {
  try {
    from_json(text, "result.json");
  } catch (const UserError &error) {
    return error.what();
  }
  return "";
}

TEST(ResultJson, HasTheShapeOtherProgramsReadFirst) {
  TestFolder folder;
  const Json json = Json::parse(to_json(example::make(folder.path())));
  for (const Json *fit : {&json, &json.at("tradeoff")}) {
    for (const char *key : {"name", "unit", "measured", "sd", "simulated", "met"})
      for (const Json &target : fit->at("targets")) EXPECT_TRUE(target.contains(key)) << key;
    for (const char *key : {"name", "unit", "value", "sd", "at_bound", "identifiable"})
      for (const Json &parameter : fit->at("parameters"))
        EXPECT_TRUE(parameter.contains(key)) << key;
    EXPECT_TRUE(fit->at("runs").at("forward").is_number_integer());
    EXPECT_TRUE(fit->at("runs").at("wall_seconds").is_number());
    EXPECT_TRUE(fit->at("replay").is_string());
    EXPECT_TRUE(fit->at("packings").is_array());
  }
  EXPECT_EQ(json.at("targets").size(), 4u);
  EXPECT_EQ(json.at("targets")[0].at("unit"), "GPa");
  EXPECT_EQ(json.at("targets")[0].at("measured"), 41.5);
}

TEST(ResultJson, ReadsBackToTheSameBits) {
  TestFolder folder;
  ReportInput input = example::make(folder.path());
  input.fits[0].targets[0].simulated = 0.1 + 0.2;
  input.fits[0].parameters[0].value = 1.0 / 3;
  input.fits[0].parameters[1].sd = no_number;
  input.fits.push_back(input.fits[1]);
  input.fits[2].name = "third";
  input.measured_curves.push_back(
      {"ucs", "slab 1", "lab", {"strain_axial", "axial_stress"}, {{0, 1e-3}, {0, 44e6}}});
  const std::string text = to_json(input);
  const ReportInput again = from_json(text, "result.json");
  EXPECT_EQ(to_json(again), text);
  EXPECT_EQ(again.fits.size(), 3u);
  EXPECT_EQ(again.fits[0].targets[0].simulated, 0.1 + 0.2);
  EXPECT_EQ(again.fits[0].parameters[0].value, 1.0 / 3);
  EXPECT_TRUE(std::isnan(again.fits[0].parameters[1].sd));
  EXPECT_EQ(again.fits[0].best_runs[1].variables.at("diameter"), 0.05);
  EXPECT_EQ(again.points.size(), input.points.size());
  EXPECT_EQ(again.measured_curves[0].columns[1][1], 44e6);
}

TEST(ResultJson, ReadsResultsFromBeforeRunsHadACost) {
  ReportInput input;
  input.ledger.emplace_back();
  input.ledger[0].bond_step_ns = 31.5;
  Json json = Json::parse(to_json(input));
  EXPECT_EQ(from_json(json.dump(), "result.json").ledger[0].bond_step_ns, 31.5);
  json["ledger"][0].erase("ns_per_bond_and_step");
  EXPECT_TRUE(std::isnan(from_json(json.dump(), "result.json").ledger[0].bond_step_ns));
}

TEST(ResultJson, WritesNoNumberAsNull) {
  ReportInput input;
  input.fits.emplace_back();
  input.fits[0].targets.emplace_back();
  const Json json = Json::parse(to_json(input));
  EXPECT_TRUE(json.at("targets")[0].at("simulated").is_null());
}

TEST(ResultJson, TakesAStudyWithoutAFinishedFit) {
  const ReportInput again = from_json(to_json(ReportInput()), "result.json");
  EXPECT_TRUE(again.fits.empty());
}

TEST(ResultJson, SaysWhatIsWrongAndWhere) {
  TestFolder folder;
  const Json good = Json::parse(to_json(example::make(folder.path())));
  Json bad = good;
  bad["targets"][2].erase("measured");
  EXPECT_EQ(error_of(bad.dump()), "result.json: 'targets[2].measured' is missing");
  bad = good;
  bad["tradeoff"]["parameters"][0]["value"] = "28";
  EXPECT_EQ(error_of(bad.dump()),
            "result.json: 'tradeoff.parameters[0].value' is not a number or null");
  bad = good;
  bad["runs"]["forward"] = 1.5;
  EXPECT_EQ(error_of(bad.dump()), "result.json: 'runs.forward' is not an integer");
  bad = good;
  bad["points"] = 3;
  EXPECT_EQ(error_of(bad.dump()), "result.json: 'points' is not a list");
  bad = good;
  bad["format"] = "bondlab-result 9";
  EXPECT_NE(error_of(bad.dump()).find("not a result of this version"), std::string::npos);
  EXPECT_NE(error_of("{\"format\": ").find("is not JSON"), std::string::npos);
  EXPECT_NE(error_of("[]").find("not a result of this version"), std::string::npos);
  EXPECT_NE(error_of("").find("is not JSON"), std::string::npos);
}

TEST(ResultJson, ReplacesBrokenTextRatherThanFailing) {
  ReportInput input;
  input.study_title = "slab \xff";
  EXPECT_EQ(from_json(to_json(input), "result.json").study_title, "slab \uFFFD");
}

TEST(ResultJson, FileIsNamedWhenItIsMissing) {
  TestFolder folder;
  try {
    read_result(folder.path());
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(std::string(error.what()).find("has no result.json"), std::string::npos);
  }
  write_result(ReportInput(), folder.path());
  EXPECT_NO_THROW(read_result(folder.path()));
}

}  // namespace
}  // namespace bondlab
