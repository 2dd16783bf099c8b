// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "app/commands.h"
#include "base/table_file.h"
#include "base/test_folder.h"
#include "base/user_error.h"
#include "specimen/data_file.h"
#include "specimen/test_packings.h"

namespace bondlab {
namespace {

// Runs `bondlab specimen ARGUMENTS`; returns what it printed, or throws what it throws.
std::string specimen_command(std::vector<std::string> arguments) {
  CLI::App app;
  add_specimen(app);
  arguments.insert(arguments.begin(), "specimen");
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  ::testing::internal::CaptureStdout();
  try {
    app.parse(arguments);
  } catch (...) {
    std::fflush(stdout);
    ::testing::internal::GetCapturedStdout();
    throw;
  }
  std::fflush(stdout);
  return ::testing::internal::GetCapturedStdout();
}

std::string complaint(const std::vector<std::string> &arguments) {
  try {
    specimen_command(arguments);
  } catch (const UserError &error) {
    return error.what();
  }
  return "";
}

void expect_part(const std::string &text, const std::string &part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" without \"" << part << "\"";
}

TEST(SpecimenCommand, MakesWhatTheGeneratorMakes) {
  const TestFolder folder;
  const std::string out = (folder / "disc.data").string();
  const std::string printed = specimen_command({"disc", "--diameter", "25 mm", "--r-min", "0.49 mm",
                                                "--ratio", "1.66", "--seed", "1", "--out", out});
  EXPECT_TRUE(read_text_file(out) == data_file_text(make_specimen(small_disc())));
  expect_part(printed, "299 discs");
  expect_part(printed, "porosity");
  expect_part(printed, "bonds per particle");
  expect_part(printed, "0 left, 20 grown");
  EXPECT_TRUE(std::filesystem::exists(folder / "disc.json"));
}

TEST(SpecimenCommand, PlainNumbersAreMetres) {
  const TestFolder folder;
  const std::string out = (folder / "a.data").string();
  specimen_command(
      {"rectangle", "--width", "0.025", "--height", "5 cm", "--r-min", "780 um", "--out", out});
  EXPECT_TRUE(read_text_file(out) == data_file_text(make_specimen(small_rectangle())));
}

TEST(SpecimenCommand, CylinderAndCheck) {
  const TestFolder folder;
  const std::string out = (folder / "a.data").string();
  const std::string made = specimen_command(
      {"cylinder", "--diameter", "10 mm", "--height", "20 mm", "--r-min", "0.56 mm", "--out", out});
  expect_part(made, "506 spheres");
  expect_part(made, "touching the ends");
  expect_part(specimen_command({"check", out}), "506 spheres");
  Specimen apart = read_data_file(out);
  for (Particle &p : apart.particles) p.r *= 0.99;
  write_data_file(apart, out);
  expect_part(specimen_command({"check", out}), "506 spheres");
  expect_part(complaint({"check", out, "--gap", "1 um"}), "touches no other");
  expect_part(complaint({"check", (folder / "absent.data").string()}), "absent.data");
}

TEST(SpecimenCommand, TakesParticlesFromAFile) {
  const TestFolder folder;
  const std::string from =
      folder.write("a.xyzr", "-1e-3 1e-3 0 1e-3\n1e-3 1e-3 0 1e-3\n1e-3 3e-3 0 1e-3\n").string();
  const std::string out = (folder / "a.data").string();
  expect_part(specimen_command({"rectangle", "--width", "4 mm", "--height", "4 mm", "--from", from,
                                "--out", out}),
              "3 discs");
  EXPECT_EQ(read_packing_file(out).rows.size(), 3u);
  expect_part(complaint({"rectangle", "--width", "3 mm", "--height", "4 mm", "--from", from,
                         "--out", (folder / "b.data").string()}),
              "sticks out of the rectangle");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.data"));
}

TEST(SpecimenCommand, BadInputLeavesNothingBehind) {
  const TestFolder folder;
  const std::string out = (folder / "a.data").string();
  expect_part(complaint({"disc", "--diameter", "-25 mm", "--r-min", "0.5 mm", "--out", out}),
              "diameter of a disc is -0.025 m");
  expect_part(complaint({"disc", "--diameter", "25 kg", "--r-min", "0.5 mm", "--out", out}),
              "--diameter: ");
  expect_part(complaint({"disc", "--diameter", "25 mm", "--out", out}), "--r-min is missing");
  expect_part(complaint({"disc", "--diameter", "25 mm", "--r-min", "0.5 mm", "--ratio", "0.5",
                         "--out", out}),
              "(allowed: 1 to 10)");
  expect_part(complaint({"disc", "--diameter", "5 mm", "--r-min", "0.5 mm", "--out", out}),
              "five particles across");
  expect_part(complaint({"disc", "--diameter", "25 mm", "--r-min", "0.5 mm", "--out",
                         (folder / "no" / "a.data").string()}),
              "there is no directory");
  expect_part(complaint({"disc", "--diameter", "25 mm", "--r-min", "0.5 mm", "--out",
                         folder.path().string()}),
              "is a directory");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(specimen_command({"cube"}), CLI::ParseError);
}

}  // namespace
}  // namespace bondlab
