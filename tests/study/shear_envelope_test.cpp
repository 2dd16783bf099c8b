// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab run` on several shear tests of one study: their envelopes on the screen, in run.json and
// as a picture. Method: shear_envelope.toml with coarser grains, a shorter way and three normal stresses;
// the lines are computed again from the points in run.json by the normal equations. Then the same runs,
// from the store, as a published table of the friction angle.
// Units: Pa. Failure: the folder is left and named.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "base/table_file.h"

namespace {
namespace fs = std::filesystem;

TEST(ShearEnvelope, is_the_line_through_the_tests_of_a_study) {
  const fs::path folder = fs::temp_directory_path() / ("bondlab_envelope_" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::string text =
      bondlab::read_text_file(fs::path(BONDLAB_SOURCE_DIR) / "inputs" / "studies" / "shear_envelope.toml");
  text = std::regex_replace(text, std::regex("r_min = \"0.4 mm\""), "r_min = \"0.6 mm\"");
  text = std::regex_replace(text, std::regex("max_shear = 0.06"), "max_shear = 0.03");
  text = std::regex_replace(text, std::regex(", \"shear_20\"\\]"), "]");
  text +=
      "\n[[targets]]\nname = \"c_peak\"\nenvelope = \"peak\"\nresponse = \"cohesion\"\nvalue = \"16 MPa\"\n"
      "sd = \"1 MPa\"\n[[quantities]]\nname = \"phi_peak\"\nenvelope = \"peak\"\nresponse = \"friction_angle\"\n"
      "unit = \"deg\"\ntolerance = \"5 deg\"\n[[cases]]\nname = \"as_started\"\n"
      "set = { sigma_c = \"35 MPa\", mu = 0.5 }\nexpect = { phi_peak = \"50 deg\" }\n";
  std::ofstream(folder / "small.toml") << text;
  const std::string command = std::string("'") + BONDLAB_BIN + "' run '" + (folder / "small.toml").string() +
                              "' --test shear_2 --test shear_5 --test shear_10 --out '" + folder.string() +
                              "' > '" + (folder / "screen.txt").string() + "' 2>&1 < /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0) << bondlab::read_text_file(folder / "screen.txt");
  const std::string screen = bondlab::read_text_file(folder / "screen.txt");
  EXPECT_NE(screen.find("envelope peak: c "), std::string::npos) << screen;
  EXPECT_NE(screen.find("envelope residual: c "), std::string::npos) << screen;
  EXPECT_TRUE(std::regex_search(screen, std::regex("  cohesion +[0-9.]+ MPa +measured 16 MPa"))) << screen;
  EXPECT_NE(screen.find("kinetic over strain energy"), std::string::npos) << screen;
  EXPECT_GT(fs::file_size(folder / "envelopes.svg"), 1000u);

  const auto record = nlohmann::json::parse(bondlab::read_text_file(folder / "run.json"));
  const auto &peak = record.at("envelopes").at(0), &residual = record.at("envelopes").at(1);
  for (const auto *envelope : {&peak, &residual}) {
    const auto &points = envelope->at("points");
    ASSERT_EQ(points.size(), 3u);
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;  // MPa, so that squares don't cancel
    for (const auto &point : points) {
      const double x = point.at("over").get<double>() / 1e6, y = point.at("value").get<double>() / 1e6;
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), c = (sy - slope * sx) / n;
    EXPECT_NEAR(envelope->at("cohesion").get<double>() / 1e6, c, 1e-9 * std::fabs(sy));
    EXPECT_NEAR(std::tan(envelope->at("friction_angle").get<double>() * std::acos(-1.0) / 180), slope, 1e-9);
  }
  // a bonded specimen has cohesion; what is left of it when the bonds along the plane are gone is less
  EXPECT_GT(peak.at("cohesion").get<double>(), 0);
  EXPECT_GT(peak.at("friction_angle").get<double>(), 0);
  EXPECT_LT(residual.at("cohesion").get<double>(), 0.5 * peak.at("cohesion").get<double>());
  // the abscissa is what the servo held: its lag is 0.25 MPa where the lid moves as fast as the box, and
  // the lid may move faster for a while
  const double nominal[] = {2e6, 5e6, 10e6};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(residual.at("points")[k].at("over").get<double>(), nominal[k], 2 * 0.25e6);
  // every run says what it cost
  for (const auto &test : record.at("tests")) EXPECT_GT(test.at("ns_per_bond_and_step").get<double>(), 1);
  const std::string compare = std::string("'") + BONDLAB_BIN + "' compare '" + (folder / "small.toml").string() +
                              "' --packings 1 --out '" + folder.string() + "' > '" +
                              (folder / "compare.txt").string() + "' 2>&1 < /dev/null";
  ASSERT_EQ(std::system(compare.c_str()), 0) << bondlab::read_text_file(folder / "compare.txt");
  const std::string table = bondlab::read_text_file(folder / "comparison.tsv");
  std::smatch row;  // case, quantity, unit, published, its sd, ours
  ASSERT_TRUE(std::regex_search(
      table, row, std::regex("as_started\tphi_peak\trad\t([0-9.]+)\t0\t([0-9.]+)\t")))
      << table;
  EXPECT_NEAR(std::stod(row[1]), 50 * std::acos(-1.0) / 180, 1e-8);
  EXPECT_NEAR(std::stod(row[2]), peak.at("friction_angle").get<double>() * std::acos(-1.0) / 180, 1e-8);
  if (!::testing::Test::HasFailure()) fs::remove_all(folder);
  else std::printf("the run is left in %s\n", folder.c_str());
}

}  // namespace
