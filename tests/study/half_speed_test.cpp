// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab run --half-speed` from the command line: every response with its shift, the run's cost,
// and the run at half the speed among the runs. Units: per cent, ns. Failure: the folder is left and named.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>

#include "base/table_file.h"

namespace {
namespace fs = std::filesystem;

TEST(HalfSpeed, shifts_the_small_granite_hardly_and_takes_twice_the_steps) {
  const fs::path folder = fs::temp_directory_path() / ("bondlab_half_" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto screen_of = [&](const std::string &words) {
    const std::string command = std::string("'") + BONDLAB_BIN + "' run '" + BONDLAB_SOURCE_DIR +
                                "/inputs/studies/granite_small.toml' --test ucs " + words + " --out '" +
                                folder.string() + "' > '" + (folder / "screen.txt").string() + "' 2>&1 < /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return bondlab::read_text_file(folder / "screen.txt");
  };
  const auto number = [](const std::string &text, const std::string &pattern) {
    std::smatch found;
    EXPECT_TRUE(std::regex_search(text, found, std::regex(pattern))) << pattern << "\n" << text;
    return found.size() > 1 ? std::stod(found[1]) : std::nan("");
  };
  const std::string screen = screen_of("--half-speed");
  EXPECT_LT(std::abs(number(screen, " E  .*half speed ([-+0-9.]+) %")), 1);
  EXPECT_LT(std::abs(number(screen, " UCS  .*half speed ([-+0-9.]+) %")), 5);
  EXPECT_EQ(number(screen, " bonds  .*half speed ([-+0-9.]+) %"), 0);
  EXPECT_GT(number(screen, "bonds, ([0-9]+) ns a bond and step"), 1);
  EXPECT_EQ(screen_of("").find("half speed"), std::string::npos) << "only on request";
  // the second run, by its own log
  double steps[2] = {0, 0};
  for (const auto &run : fs::directory_iterator(folder / "runs")) {
    const std::string log = bondlab::read_text_file(run.path() / "log.bondlab");
    steps[run.path().filename().string().rfind("000002", 0) == 0] = number(log, "procs for ([0-9]+) steps");
  }
  EXPECT_NEAR(steps[1] / steps[0], 2, 0.2);
  if (!::testing::Test::HasFailure()) fs::remove_all(folder);
  else std::printf("the run is left in %s\n", folder.c_str());
}

}  // namespace
