// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "base/units.h"
#include "study/input_folders.h"
#include "study/specimen_request.h"

namespace bondlab {
namespace {

namespace fs = std::filesystem;

const fs::path kTestdata = fs::path(__FILE__).parent_path() / "testdata";

Study good_study() {
  setenv("BONDLAB_INPUTS", kTestdata.c_str(), 1);
  return read_study(kTestdata / "good.toml");
}

TEST(ReadStudy, KeepsEverythingInSi) {
  const Study study = good_study();
  EXPECT_EQ(study.name, "slab");
  const SpecimenEntry &specimen = study.specimen("slab");
  EXPECT_EQ(specimen.shape, SpecimenShape::rectangle);
  EXPECT_EQ(specimen.size.width, 0.05);
  EXPECT_EQ(specimen.size.height, 0.1);
  EXPECT_EQ(specimen.thickness, 1);
  EXPECT_EQ(specimen.r_min, 0.00066);
  EXPECT_EQ(specimen.dimensions(), 2);
  const TestEntry &test = study.test("ucs");
  EXPECT_EQ(test.wall_limit, 120);
  EXPECT_EQ(test.ranks, 1);
  EXPECT_EQ(test.variables.at("density").text(), "2622");
  EXPECT_EQ(test.variables.at("dim").text(), "2");
  EXPECT_EQ(test.definition.deck, kTestdata / "compression" / "in.compression");
  EXPECT_EQ(test.definition.responses.at("UCS").function, "uniaxial.peak_stress");
  EXPECT_EQ(test.definition.deck_defaults.at("specimen"), "slab.specimen");
  const Parameter &parameter = study.parameter("E_c");
  EXPECT_EQ(parameter.lower, 15e9);
  EXPECT_EQ(parameter.upper, 45e9);
  EXPECT_EQ(parameter.scale, Scale::logarithmic);
  EXPECT_EQ(parameter.sets, (std::vector<std::string>{"E_c", "E_b"}));
  EXPECT_EQ(study.parameter("sigma_c").sets, (std::vector<std::string>{"sigma_c"}))
      << "a parameter sets its namesake";
  EXPECT_EQ(study.target("E").value, 41.5e9);
  EXPECT_EQ(study.target("E").unit, "GPa");
  EXPECT_DOUBLE_EQ(study.target("E").sd, 0.03 * 41.5e9) << "a share of the value";
  EXPECT_EQ(study.target("UCS").sd, 7e6);
  EXPECT_EQ(study.fit("main").targets, (std::vector<std::string>{"E", "UCS"}));
  EXPECT_EQ(study.options.lhs_points, 6);
  EXPECT_EQ(study.options.max_iterations, FitOptions().max_iterations);
  EXPECT_EQ(study.assumptions.at(0).source, "assumed");
  EXPECT_NE(study.source_text.find("A slab under compression"), std::string::npos);
}

TEST(ReadStudy, ReadsTheDataFolderWithReplicatesAndTheirScatter) {
  const Study study = good_study();
  ASSERT_TRUE(study.data.has_value());
  const Measurement &series = study.data->measurements.at(0);
  EXPECT_EQ(series.replicates.size(), 2u);
  EXPECT_EQ(series.replicates[0].replicate, "slab 1");
  EXPECT_EQ(series.replicates[1].replicate, "slab_2") << "the file's name where no label is given";
  EXPECT_EQ(series.replicates[0].column("axial_stress")[1], 40e6);
  EXPECT_DOUBLE_EQ(series.conditions.at("temperature"), 293.15);
  // Common range 0 .. 0.003; at its end 100 MPa and 44 + 2/3 (120 - 44) MPa.
  EXPECT_EQ(series.envelope.x.front(), 0);
  EXPECT_DOUBLE_EQ(series.envelope.x.back(), 0.003);
  const double second = 44e6 + 76e6 * 2 / 3;
  EXPECT_NEAR(series.envelope.mean.back(), (100e6 + second) / 2, 1);
  EXPECT_NEAR(series.envelope.sd.back(), std::abs(100e6 - second) / std::sqrt(2.0), 1);
}

TEST(ReadStudy, DeckVariablesFollowWhatTheParametersSet) {
  const auto variables = deck_variables(good_study(), "ucs", {30e9, 120e6});
  EXPECT_EQ(variables,
            (std::map<std::string, double>{{"E_c", 30e9}, {"E_b", 30e9}, {"sigma_c", 120e6}}));
}

TEST(TestDefinition, LimitsAreInTheVariablesUnitAndTheDeckGetsItsOwn) {
  const DeckVariable angle = good_study().test("ucs").definition.variables.at("friction_angle");
  EXPECT_DOUBLE_EQ(*angle.maximum, std::acos(-1.0) / 3) << "60 deg in SI";
  EXPECT_EQ(deck_number(angle, 30 * std::acos(-1.0) / 180), 30);
  EXPECT_EQ(why_not_allowed(angle, 1.2), "it must be at most 60 deg");
  EXPECT_EQ(why_not_allowed(angle, 0), "");
}

// A share that is declared in seconds can't be set by any study.
TEST(TestDefinition, UnitsOfTheShippedTestsAreThoseTheirDecksState) {
  const fs::path inputs = fs::path(__FILE__).parent_path() / "../../inputs";
  std::size_t checked = 0;
  for (const auto &folder : fs::directory_iterator(inputs)) {
    if (!fs::exists(folder.path() / "test.toml")) continue;
    ErrorCollector errors;
    const TestDefinition test = read_test_definition(folder.path(), errors);
    errors.throw_if_any();
    std::istringstream deck(read_text_file(test.deck));
    for (std::string line; std::getline(deck, line);) {
      std::istringstream words(line);
      std::string command, name, style, value, hash, comment;
      if (!(words >> command >> name >> style >> value >> hash) || command != "variable" ||
          style != "index" || hash != "#" || !std::getline(words >> std::ws, comment))
        continue;
      const auto variable = test.variables.find(name);
      if (variable == test.variables.end() || !variable->second.choices.empty()) continue;
      const std::string first = comment.substr(0, comment.find_first_of(", "));
      const bool is_unit = comment.size() == first.size() || comment[first.size()] == ',';
      bool known = is_unit;
      if (is_unit) try {
          to_si(1, first);
        } catch (const UserError &) {
          known = false;
        }
      const std::string &unit = variable->second.unit;
      if (known && first != "m") {  // "m" is also Norton's exponent
        EXPECT_TRUE(same_dimension(unit, first) || unit == "1")
            << test.name << " " << name << ": " << unit;
      } else if (!known) {
        EXPECT_TRUE(unit == "1" || unit == "deg") << test.name << " " << name << ": " << unit;
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 200u);
}

TEST(ReadStudy, TakesEverySizeDistributionOfTheGenerator) {
  const TestFolder folder;
  fs::copy(kTestdata, folder / "study", fs::copy_options::recursive);
  setenv("BONDLAB_INPUTS", (folder / "study").c_str(), 1);
  const std::string good = read_text_file(folder / "study" / "good.toml"), from = "r_min = \"0.66 mm\"";
  const auto with = [&](const std::string &lines) {
    std::string text = good;
    text.replace(text.find(from), from.size(), lines);
    std::ofstream(folder / "study" / "sizes.toml") << text;
    return read_study(folder / "study" / "sizes.toml").specimen("slab");
  };
  const SpecimenEntry normal = with("sizes = \"log-normal\"\nr_median = \"0.8 mm\"\nr_spread = 0.2\nmethod = \"filling\"");
  EXPECT_EQ(specimen_request(normal, 0).r_median, 0.8e-3);
  EXPECT_EQ(specimen_request(normal, 0).method, "filling");
  const SpecimenEntry inserted = with("r_min = \"0.66 mm\"\nr_ratio = 3\nmethod = \"insertion\"\ntries = 50");
  EXPECT_EQ(specimen_request(inserted, 0).method, "insertion");
  EXPECT_EQ(specimen_request(inserted, 0).tries, 50);
  EXPECT_EQ(specimen_request(with("r_min = \"0.66 mm\"\nr_ratio = 3\nmethod = \"insertion\""), 0).tries, default_tries);
  EXPECT_LT(normal.r_min, 0.6e-3) << "the smallest radius, for people";
  EXPECT_GT(normal.r_min * normal.r_ratio, 1.1e-3);
  const SpecimenEntry classes = with("sizes = \"discrete\"\nclasses = [\"0.5 mm: 30 %\", \"0.8 mm: 70 %\"]");
  ASSERT_EQ(specimen_request(classes, 0).classes.size(), 2u);
  EXPECT_EQ(specimen_request(classes, 0).classes[1].r, 0.8e-3);
  EXPECT_DOUBLE_EQ(classes.r_min, 0.5e-3);
  const SpecimenEntry sieve = with("sizes = \"d10-d50-d90\"\nd10 = \"1 mm\"\nd50 = \"1.2 mm\"\nd90 = \"1.5 mm\"");
  EXPECT_EQ(specimen_request(sieve, 0).d50, 1.2e-3);
}

TEST(ReadStudy, LooksUpNamesOrSaysWhichThereAre) {
  const Study study = good_study();
  try {
    study.fit("mian");
    FAIL();
  } catch (const UserError &error) {
    EXPECT_EQ(error.text(), "the study has no fit 'mian'; it has: main");
  }
}

TEST(ReadStudy, AMissingFileIsNamed) {
  try {
    read_study("no/such/study.toml");
    FAIL();
  } catch (const UserError &error) {
    EXPECT_STREQ(error.what(), "no/such/study.toml: there is no such file");
  }
}

TEST(ReadStudy, FindsATestByPathFromTheStudyFile) {
  const TestFolder folder;
  fs::copy(kTestdata, folder / "study", fs::copy_options::recursive);
  fs::create_directories(folder / "empty");
  setenv("BONDLAB_INPUTS", (folder / "empty").c_str(), 1);
  EXPECT_EQ(find_test_folder("./compression", folder / "study"), folder / "study" / "compression");
  EXPECT_EQ(find_test_folder("compression", folder / "study"), fs::path());
}

TEST(SpecimenRequestOfAStudy, ThePackingShiftsTheSeedOnly) {
  const Study study = good_study();
  const SpecimenRequest own = specimen_request(study.specimen("slab"), 0),
                        third = specimen_request(study.specimen("slab"), 3);
  EXPECT_EQ(own.seed, 1u);
  EXPECT_EQ(third.seed, 4u);
  EXPECT_EQ(own.width, third.width);
  EXPECT_NE(specimen_key(own), specimen_key(third));
}

MeasuredCurve curve_of(const std::vector<double> &x, const std::vector<double> &y) {
  MeasuredCurve curve;
  curve.file = "a.tsv";
  curve.names = {"x", "y"};
  curve.columns = {x, y};
  return curve;
}

TEST(MakeEnvelope, OfOneReplicateIsTheCurveWithoutScatter) {
  const Envelope envelope = make_envelope({curve_of({0, 1, 3}, {0, 10, 30})}, "x", "y", 4);
  EXPECT_EQ(envelope.x, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(envelope.mean, (std::vector<double>{0, 10, 20, 30}));
  EXPECT_TRUE(envelope.sd.empty());
}

TEST(MakeEnvelope, RefusesReplicatesWithoutCommonRange) {
  EXPECT_THROW(make_envelope({curve_of({0, 1}, {0, 1}), curve_of({1, 2}, {0, 1})}, "x", "y"),
               UserError);
  EXPECT_THROW(make_envelope({curve_of({0, 1, 1}, {0, 1, 2})}, "x", "y"), UserError);
  EXPECT_THROW(make_envelope({curve_of({0}, {0})}, "x", "y"), UserError);
}

}  // namespace
}  // namespace bondlab
