// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/diagnosis_files.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "diagnose/forward_prober.h"
#include "report/diagnosis_pictures.h"

namespace bondlab::diagnose {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::set<std::string> keys(const json &object) {
  std::set<std::string> out;
  for (const auto &item : object.items()) out.insert(item.key());
  return out;
}

class DiagnosisFiles : public ::testing::Test {
 protected:
  DiagnosisFiles() {
    d.effects = effects_of_study(study, read_effects(inputs / "effects"));
    d.catalogue = catalogue_of(study, d.effects);
    while (d.catalogue[named].name != "bond_gap") ++named;
    d.sizes.assign(d.effects.size(), 0.0);
    d.sizes[named] = 0.25;
    d.diagnosis.verdict = Verdict::one;
    NamedEffect effect;
    effect.effect = named;
    effect.size = 0.25, effect.low = 0.2, effect.high = 0.31;
    effect.p = 0.004, effect.margin = 17;
    d.diagnosis.effects = {effect};
    d.diagnosis.where = {{"ucs, slope", 6.5}};
    d.diagnosis.smallest_size.assign(d.effects.size(), 0.01);
    d.advice = {"measure <the> number of bonds & write it down"};
    d.gap = {5.5, 1.25, 4.5, 1.5, 4.25, 1.0};
    d.parameters_before = {25e9, 2.0, 40e6}, d.parameters_after = {26e9, 2.2, 41e6};
    d.sd_before = d.sd_after = {1e9, 0.1, 1e6};
  }
  fs::path inputs = fs::path(BONDLAB_SOURCE_DIR) / "inputs";
  Study study = read_study(inputs / "studies" / "granite.toml");
  StudyDiagnosis d;
  std::size_t named = 0;
};

TEST_F(DiagnosisFiles, TheJsonHasExactlyTheKeysOfTheWorkflow) {
  const json j = json::parse(diagnosis_json(study, d));
  EXPECT_EQ(keys(j),
            (std::set<std::string>{"verdict", "effects", "where", "advice", "gap", "parameters"}));
  EXPECT_EQ(keys(j["gap"]),
            (std::set<std::string>{"before", "after", "holdout_before", "holdout_after",
                                   "placebo_after", "noise_floor"}));
  ASSERT_EQ(j["effects"].size(), 1u);
  EXPECT_EQ(keys(j["effects"][0]),
            (std::set<std::string>{"name", "size", "interval", "p", "margin"}));
}

TEST_F(DiagnosisFiles, TheJsonHasTheFiguresOfTheDiagnosis) {
  const json j = json::parse(diagnosis_json(study, d));
  EXPECT_EQ(j["verdict"], to_string(Verdict::one));
  const json &e = j["effects"][0];
  EXPECT_EQ(e["name"], "bond_gap");
  EXPECT_EQ(e["size"], 0.25);
  EXPECT_EQ(e["interval"], json({0.2, 0.31}));
  EXPECT_EQ(e["p"], 0.004);
  EXPECT_EQ(e["margin"], 17);
  EXPECT_EQ(j["where"], json::parse(R"([{"name": "ucs, slope", "score": 6.5}])"));
  EXPECT_EQ(j["advice"], json(d.advice));
  EXPECT_EQ(j["gap"], json::parse(R"({"before": 5.5, "after": 1.25, "holdout_before": 4.5,
      "holdout_after": 1.5, "placebo_after": 4.25, "noise_floor": 1.0})"));
}

// The placebo is judged by what was held out, where there is something.
TEST_F(DiagnosisFiles, ThePlaceboStandsWithTheRowsThatItIsJudgedBy) {
  d.by_series = {{"ucs", false, 5.5, 1.25, 3}, {"brazilian", true, 4.5, 1.5, 2}};
  d.holdout = "brazilian";
  const auto line = [&](const std::string &start) {
    const auto text = diagnosis_text(study, d);
    const auto from = text.find("\n  " + start);
    return text.substr(from, text.find('\n', from + 1) - from);
  };
  EXPECT_NE(line("brazilian  ").find("held out; a placebo: 4.25"), std::string::npos);
  EXPECT_EQ(line("all that was fitted").find("placebo"), std::string::npos);
  d.by_series.pop_back();
  d.holdout.clear();
  EXPECT_NE(line("all that was fitted").find("floor 1; a placebo: 4.25"), std::string::npos)
      << line("all that was fitted");
}

TEST_F(DiagnosisFiles, SaysWhereAPlaceboWouldBeTheEffectItself) {
  const auto says = [&](const std::string &words) {
    return diagnosis_text(study, d).find(words) != std::string::npos;
  };
  d.cross.before = 30, d.cross.after = 10, d.cross.placebo = 40, d.cross.floor = 5;
  EXPECT_TRUE(says("held out in turn: 80 % of the way to the noise floor closed, by a placebo -40 %"));
  d.cross.placebo = none;
  EXPECT_TRUE(says("80 % of the way to the noise floor closed, by a placebo none: one row alone"));
  EXPECT_TRUE(json::parse(diagnosis_json(study, d)).at("held_out_in_turn").at("placebo").is_null());
}

TEST_F(DiagnosisFiles, SaysWhichParameterTheDataCannotIdentify) {
  const auto says = [&](const std::string &name) {
    return diagnosis_text(study, d).find("  " + name + ": these data can't identify it") !=
           std::string::npos;
  };
  const auto &p = study.parameters[1];
  EXPECT_FALSE(says(p.name));
  d.sd_after[1] = 0.26 * (p.upper - p.lower);
  EXPECT_TRUE(says(p.name));
  EXPECT_FALSE(says(study.parameters[0].name));
  d.sd_after[1] = 0.24 * (p.upper - p.lower);
  EXPECT_FALSE(says(p.name));
  d.sd_after[1] = none;
  EXPECT_TRUE(says(p.name));
}

TEST_F(DiagnosisFiles, WhatCouldNotBeHadIsNullAndKeepsItsKey) {
  d.gap.holdout_before = d.gap.holdout_after = none;
  d.diagnosis.effects[0].margin = std::numeric_limits<double>::infinity();
  const json j = json::parse(diagnosis_json(study, d));
  EXPECT_TRUE(j["gap"].at("holdout_before").is_null());
  EXPECT_TRUE(j["gap"].at("holdout_after").is_null());
  EXPECT_TRUE(j["effects"][0].at("margin").is_null());
  EXPECT_EQ(j["gap"]["before"], 5.5);
}

TEST_F(DiagnosisFiles, ANamedEffectComesWithTheStudyThatHasIt) {
  const TestFolder out;
  write_diagnosis(study, d, out.path());
  const Study changed = read_study(out / "model_with_effect.toml");
  EXPECT_NEAR(changed.test("ucs").variables.at("gap").number,
              1.25 * study.test("ucs").variables.at("gap").number, 1e-12);
  EXPECT_NEAR(*changed.parameters[0].start, 26e9, 1e3);
  EXPECT_NE(read_text_file(out / "model.diff").find("+ start = \"26 GPa\""), std::string::npos);
  EXPECT_EQ(read_text_file(out / "diagnosis.json"), diagnosis_json(study, d));
  EXPECT_NE(read_text_file(out / "diagnosis.txt").find("bond_gap"), std::string::npos);
}

TEST_F(DiagnosisFiles, WithNothingNamedThereIsNoModelWithAnEffect) {
  for (const auto verdict : {Verdict::nothing, Verdict::not_in_catalogue}) {
    d.diagnosis.verdict = verdict;
    d.diagnosis.effects.clear();
    const TestFolder out;
    write_diagnosis(study, d, out.path());
    EXPECT_TRUE(fs::exists(out / "diagnosis.json"));
    EXPECT_FALSE(fs::exists(out / "model_with_effect.toml"));
    EXPECT_EQ(json::parse(read_text_file(out / "diagnosis.json"))["effects"], json::array());
  }
}

TEST_F(DiagnosisFiles, ThePageEscapesWhatItIsGiven) {
  const auto page = diagnosis_page(study, d);
  EXPECT_EQ(page.find("<the>"), std::string::npos);
  EXPECT_NE(page.find("&lt;the&gt; number of bonds &amp; write"), std::string::npos);
}

TEST_F(DiagnosisFiles, WhereItShowsIsDrawnCellByCellBeforeAndAfter) {
  EXPECT_EQ(where_picture(d), "");
  d.rows = {{"uniaxial_compression", "ucs & more", CurvePart::peak, "log peak"},
            {"uniaxial_compression", "ucs & more", CurvePart::peak, "other"},
            {"brazilian", "brazilian", CurvePart::slope, "compliance"}};
  d.diagnosis.before.residual = Eigen::Vector3d(3, 5, -2);
  d.diagnosis.after.residual = Eigen::Vector3d(0.5, -0.5, 0);
  const auto svg = where_picture(d);
  EXPECT_NE(svg.find("+5.7"), std::string::npos) << "8 over the root of 2: " << svg;
  EXPECT_NE(svg.find("-2.0"), std::string::npos) << svg;
  EXPECT_NE(svg.find("+0.0"), std::string::npos) << svg;
  EXPECT_NE(svg.find("ucs &amp; more"), std::string::npos) << svg;
  EXPECT_LT(svg.find(">slope<"), svg.find(">peak<")) << "parts in the order of a curve";
  EXPECT_NE(diagnosis_page(study, d).find(svg), std::string::npos);
}

TEST_F(DiagnosisFiles, WhatWasTriedIsListedBestFirst) {
  const auto other = named == 0 ? 1u : 0u;
  d.diagnosis.tried = {{{other}, {1.0}, 12.5}, {{named}, {2.0}, 0}};
  const auto text = diagnosis_text(study, d);
  const auto list = text.find("explanations refitted");
  ASSERT_NE(list, std::string::npos);
  EXPECT_LT(text.find("0.0  bond_gap", list), text.find("12.5  " + d.catalogue[other].name, list));
}

}  // namespace
}  // namespace bondlab::diagnose
