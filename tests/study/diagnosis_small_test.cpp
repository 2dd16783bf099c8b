// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the missing-effect workflow, reduced, from the command line: `bondlab trial` hides four cases
// of tests/data/hidden_small in engine runs and judges what it names; `bondlab diagnose` then reads
// one of these data folders without its sealed truth, must say the same, write the model that it
// proposes and find nothing missing in that. Units: as in trial.json and diagnosis.json. Failure: the
// folder is left and named.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace {
namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kSource = BONDLAB_SOURCE_DIR;
const fs::path kData = kSource / "tests/data/hidden_small";
const char *const kPlan = " --packings 4 --scatter 8";

std::string text_of(const fs::path &file) {
  std::ifstream in(file);
  std::stringstream all;
  all << in.rdbuf();
  return all.str();
}

class ReducedDiagnosis : public ::testing::Test {
 protected:
  fs::path folder;
  void SetUp() override {
    folder = fs::temp_directory_path() / ("bondlab_diagnosis_" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override {
    if (HasFailure())
      std::printf("left for a look: %s\n", folder.c_str());
    else
      fs::remove_all(folder);
  }
  int bondlab(const std::string &arguments) {
    const std::string command = std::string("'") + BONDLAB_BIN + "' " + arguments + " > '" +
                                (folder / "screen.txt").string() + "' 2>&1 < /dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string screen() const { return text_of(folder / "screen.txt"); }
};

TEST_F(ReducedDiagnosis, NamesWhatWasHiddenAndNothingWhereNothingWas) {
  const fs::path out = folder / "out";
  const std::string effects = " --effects '" + (kData / "effects").string() + "'";
  ASSERT_EQ(bondlab("trial '" + (kData / "set.toml").string() + "' --out '" + out.string() + "'" +
                    effects + kPlan),
            0)
      << screen();
  const json cases = json::parse(text_of(out / "trial.json"));
  ASSERT_EQ(cases.size(), 4u);
  for (const auto &one : cases) {
    if (one.at("kind") == "left_out") {  // whatever else it may be taken for
      EXPECT_NE(one.at("verdict"), "nothing") << one.dump(1);
      for (const auto &name : one.at("named")) EXPECT_NE(name, "brazilian_conversion") << one.dump(1);
      continue;
    }
    const bool null = one.at("kind") == "null";
    EXPECT_EQ(one.at("verdict"), null ? "nothing" : "one") << one.dump(1);
    EXPECT_EQ(one.at("judgement"), null ? "nothing" : "right") << one.dump(1);
    if (null) continue;
    EXPECT_GT(one.at("margin").get<double>(), 6.63);
    const double hidden = one.at("sizes")[0], named = one.at("named_sizes")[0];
    EXPECT_NEAR(named / hidden, 1, 0.5) << one.dump(1);
  }

  // One effect offered, for the time: the trial had them all, on the same data.
  const fs::path data = out / "data" / "platen_compliance";
  fs::remove(data / "sealed_truth.json");
  ASSERT_EQ(bondlab("diagnose '" + (kSource / "inputs/studies/hidden_small.toml").string() +
                    "' --data '" + data.string() + "' --out '" + (out / "model").string() +
                    "' --holdout none --rounds 3 --only platen_compliance" + effects + kPlan),
            0)
      << screen();
  // The model with what was named is asked again; it lacks nothing, so there is no third round.
  const json again = json::parse(text_of(out / "model" / "round_2" / "diagnosis.json"));
  EXPECT_EQ(again.at("verdict"), "nothing") << again.dump(1);
  EXPECT_FALSE(fs::exists(out / "model" / "round_3"));
  const json diagnosis = json::parse(text_of(out / "model" / "diagnosis.json"));
  EXPECT_EQ(diagnosis.at("verdict"), "one");
  ASSERT_EQ(diagnosis.at("effects").size(), 1u);
  EXPECT_EQ(diagnosis.at("effects")[0].at("name"), "platen_compliance");
  const auto &gap = diagnosis.at("gap");
  // The engine itself, run with what was named, closes most of the gap; a placebo does not.
  const double before = gap.at("before"), after = gap.at("after"), placebo = gap.at("placebo_after");
  EXPECT_LT(after, 0.6 * before) << gap.dump(1);
  EXPECT_LT(after, placebo) << gap.dump(1);
  const std::string diff = text_of(out / "model" / "model.diff");
  EXPECT_NE(diff.find("platen_modulus"), std::string::npos) << diff;
  EXPECT_EQ(bondlab("check '" + (out / "model" / "model_with_effect.toml").string() + "'"), 0)
      << screen();
  EXPECT_TRUE(fs::exists(out / "model" / "diagnosis.html"));
}

}  // namespace
