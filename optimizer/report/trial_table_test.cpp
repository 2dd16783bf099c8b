// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/trial_table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

namespace bondlab::diagnose {
namespace {

TEST(JudgeATrial, KnowsRightFromOfferedFromWrong) {
  EXPECT_EQ(judge({"a"}, {"a"}, false), Judgement::right);
  EXPECT_EQ(judge({"a"}, {"b", "a"}, false), Judgement::in_set);
  EXPECT_EQ(judge({"a"}, {"b"}, false), Judgement::wrong);
  EXPECT_EQ(judge({"a"}, {}, false), Judgement::nothing);
  EXPECT_EQ(judge({"a"}, {}, true), Judgement::outside);
  EXPECT_EQ(judge({"a", "b"}, {"b", "a"}, false), Judgement::right);
  EXPECT_EQ(judge({"a", "b"}, {"b"}, false), Judgement::wrong) << "one of two";
  EXPECT_EQ(judge({}, {}, false), Judgement::nothing);
  EXPECT_EQ(judge({}, {"a"}, false), Judgement::wrong) << "a false alarm";
}

TrialCase a_case(const std::string &kind, Judgement judgement) {
  TrialCase out;
  out.hidden.id = kind + " " + to_string(judgement);
  out.hidden.kind = kind;
  out.judgement = judgement;
  out.others_judged = {Judgement::wrong, Judgement::right, Judgement::nothing};
  out.others = {{"b"}, {"a"}, {}};
  out.margin = std::numeric_limits<double>::infinity();
  return out;
}

TEST(TrialTable, CountsWithBinomialIntervalsByKind) {
  const auto text = trial_markdown({a_case("effect", Judgement::right),
                                    a_case("effect", Judgement::right),
                                    a_case("effect", Judgement::right),
                                    a_case("effect", Judgement::wrong),
                                    a_case("null", Judgement::nothing)});
  // Clopper & Pearson for 3 of 4: 19.4 to 99.4 %.
  EXPECT_NE(text.find("| effect | 3 of 4 (19 to 99 %) | 0 of 4 (0 to 60 %) | 1 of 4 (1 to 81 %)"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| effect, BIC | 4 of 4 (40 to 100 %)"), std::string::npos) << text;
  EXPECT_NE(text.find("| null | 0 of 1"), std::string::npos) << text;
  EXPECT_EQ(text.find("| pair"), std::string::npos) << "no pair was tried";
}

TEST(TrialTable, FileHoldsEveryCaseAndNoInfinity) {
  const auto folder = std::filesystem::temp_directory_path() / "bondlab_trial_table_test";
  std::filesystem::create_directories(folder);
  write_trial({a_case("effect", Judgement::right), a_case("null", Judgement::nothing)}, folder);
  std::ifstream file(folder / "trial.json");
  const auto all = nlohmann::json::parse(file);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0]["judgement"], "right");
  EXPECT_TRUE(all[0]["margin"].is_null());
  EXPECT_TRUE(std::filesystem::exists(folder / "trial.md"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace bondlab::diagnose
