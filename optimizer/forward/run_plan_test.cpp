// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/run_plan.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "forward/fake_engine_for_tests.h"
#include "forward/run_folder.h"

namespace bondlab {
namespace {

std::string full_key(const RunPlan &plan, const std::string &engine = "engine") {
  return key_of(plan, engine).full;
}

TEST(RunKey, ChangesWithEverythingThatCanChangeTheResult) {
  const FakeEngine fake;
  RunPlan plan = plan_run(fake.study, fake.request(1));
  plan.wants_specimen = true;
  plan.specimen_file.hash = "specimen";
  const std::string key = full_key(plan);
  const auto changed = [&](auto change) {
    RunPlan other = plan;
    change(other);
    return full_key(other) != key;
  };
  EXPECT_TRUE(changed([](RunPlan &p) { p.variables["act"] = "1.0000000000000002"; }));
  EXPECT_TRUE(changed([](RunPlan &p) { p.variables["word"] = "weibull"; }));
  EXPECT_TRUE(changed([](RunPlan &p) { p.deck_hash = "another"; }));
  EXPECT_TRUE(changed([](RunPlan &p) { p.ranks = 2; }));
  EXPECT_TRUE(changed([](RunPlan &p) { p.packing = 1; }));
  EXPECT_TRUE(changed([](RunPlan &p) { p.specimen_file.hash = "another"; }));
  EXPECT_TRUE(changed([](RunPlan &p) { p.specimen.r_min *= 1.01; }));
  EXPECT_NE(full_key(plan, "another engine"), key);
}

TEST(RunKey, DoesNotChangeWithPathsNamesAndLimits) {
  const FakeEngine fake;
  RunPlan plan = plan_run(fake.study, fake.request(1));
  const std::string key = full_key(plan);
  plan.wall_limit = 7;
  plan.deck = "elsewhere";
  plan.test = "another name";
  plan.specimen_file.path = "elsewhere";
  EXPECT_EQ(full_key(plan), key);
}

TEST(RunKey, TheSeedIsADimensionOfItsOwn) {
  const FakeEngine fake;
  RunPlan plan = plan_run(fake.study, fake.request(1));
  plan.wants_specimen = true;
  const RunKey own = key_of(plan, "e");
  plan.packing = 3;
  plan.specimen_file.hash = "another packing";
  const RunKey third = key_of(plan, "e");
  EXPECT_EQ(own.point, third.point);
  EXPECT_EQ(own.seed + 3, third.seed);
  EXPECT_NE(own.full, third.full);
}

TEST(RunPlan, ValuesGoToTheDeckInItsOwnUnits) {
  const FakeEngine fake;
  const RunPlan plan = plan_run(fake.study, fake.request(1e-3));
  EXPECT_EQ(plan.variables.at("act"), "0.001");
  EXPECT_EQ(plan.variables.at("angle"), "30")
      << "degrees in the study, radians in SI, degrees in the deck";
  EXPECT_EQ(plan.variables.at("width"), "0.05") << "from the specimen, because the deck has it";
  EXPECT_EQ(plan.variables.count("height"), 0u) << "the deck doesn't have it";
  EXPECT_EQ(plan.variables.count("value"), 0u) << "the deck's default stands";
  EXPECT_EQ(plan.numeric.at("value"), 1);
}

TEST(RunPlan, WorkloadIsTheSameForEveryPointAndPackingOfATest) {
  const FakeEngine fake;
  ForwardRequest request = fake.request(1);
  const std::string workload = workload_of(plan_run(fake.study, request));
  request.variables["act"] = 2;
  request.packing = 4;
  EXPECT_EQ(workload_of(plan_run(fake.study, request)), workload);
  FakeEngine other;
  other.study.tests[0].variables["value"].number = 7;
  EXPECT_NE(workload_of(plan_run(other.study, request)), workload)
      << "a fixed variable (the platen speed, say) makes another workload";
}

std::string message(const std::filesystem::path &deck) {
  try {
    return "hash " + deck_hash(deck);
  } catch (const UserError &error) {
    const std::string text = error.what();
    return text.substr(text.rfind('/', text.find(": ")) + 1);
  }
}

TEST(DeckHash, CoversIncludedFilesAndRefusesWhatItCannotFollow) {
  const TestFolder folder;
  const auto deck = folder.write(
      "in.a",
      "variable deck_dir index .\ninclude ${deck_dir}/common.in # shared\njump SELF again\n");
  folder.write("common.in", "units si\n");
  const std::string before = message(deck);
  EXPECT_EQ(before.substr(0, 5), "hash ");
  EXPECT_EQ(message(deck), before);
  folder.write("common.in", "units cgs\n");
  EXPECT_NE(message(deck), before);
  EXPECT_EQ(message(folder.write("in.b", "units si\ninclude common.in\n")).substr(0, 54),
            "in.b:2: the file 'common.in' can't be found from a run");
  EXPECT_EQ(message(folder.write("in.c", "include ${other}/common.in\n")).substr(0, 33),
            "in.c:1: the file '${other}/common");
  EXPECT_EQ(message(folder.write("in.d", "include ${deck_dir}/none.in\n")).substr(0, 24),
            "in.d:1: there is no file");
  EXPECT_EQ(message(folder.write("in.e", "include ${deck_dir}/in.e\n")).substr(0, 5), "hash ")
      << "a file that includes itself ends";
}

TEST(EngineCommand, GivesTheDeckEverythingByVar) {
  const FakeEngine fake;
  RunPlan plan = plan_run(fake.study, fake.request(-0.0));
  plan.wants_specimen = plan.wants_deck_dir = true;
  plan.specimen_file.path = "the specimen.data";
  const std::string command = join(engine_command(fake.settings.engine, plan), "|");
  EXPECT_NE(command.find("|-np|1|--oversubscribe|--bind-to|none|"), std::string::npos);
  EXPECT_NE(command.find("|-var|specimen|the specimen.data"), std::string::npos);
  EXPECT_NE(command.find("|-var|deck_dir|" + plan.deck.parent_path().string()), std::string::npos);
  EXPECT_NE(command.find("|-var|act|0"), std::string::npos);
  EXPECT_NE(command.find("|-log|log.bondlab"), std::string::npos);
}

TEST(EngineCommand, StartsOneRankWithoutALauncherUnlessTheUserNamedOne) {
  const FakeEngine fake;
  Engine engine = fake.settings.engine;
  RunPlan plan = plan_run(fake.study, fake.request(-0.0));
  EXPECT_EQ(engine_command(engine, plan).front(), engine.mpirun.string());
  engine.alone_without_mpirun = true;
  EXPECT_EQ(engine_command(engine, plan).front(), engine.program.string());
  plan.ranks = 2;
  EXPECT_EQ(engine_command(engine, plan).front(), engine.mpirun.string());
}

TEST(Quoted, SurvivesAShell) { EXPECT_EQ(quoted("it's 5 $x"), "'it'\\''s 5 $x'"); }

}  // namespace
}  // namespace bondlab
