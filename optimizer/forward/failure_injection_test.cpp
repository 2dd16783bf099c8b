// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every way a run can fail has its named cause, its message, its kept folder, and spoils no other
// run of its batch.
#include <gtest/gtest.h>

#include <chrono>

#include "forward/fake_engine_for_tests.h"

namespace bondlab {
namespace {

namespace fs = std::filesystem;

struct Injection {
  const char *name;
  double act;
  FailureCause cause;
  const char *words;  // in the message
};

class FailureInjection : public testing::TestWithParam<Injection> {};

TEST_P(FailureInjection, HasANamedCauseAndKeepsItsFolder) {
  FakeEngine fake;
  fake.study.tests[0].wall_limit = 1;
  const Injection &injection = GetParam();
  const auto outcomes = fake.run({0, injection.act, 30});
  ASSERT_EQ(outcomes.size(), 3u);
  EXPECT_TRUE(outcomes[0].ok) << outcomes[0].failure.message;
  EXPECT_TRUE(outcomes[2].ok) << outcomes[2].failure.message;
  const ForwardOutcome &failed = outcomes[1];
  EXPECT_FALSE(failed.ok);
  EXPECT_EQ(to_string(failed.failure.cause), to_string(injection.cause)) << failed.failure.message;
  EXPECT_NE(failed.failure.message.find(injection.words), std::string::npos)
      << failed.failure.message;
  EXPECT_TRUE(fs::exists(fs::path(failed.failure.run_directory) / "manifest.json"));
  EXPECT_TRUE(fs::exists(fs::path(failed.failure.run_directory) / "screen.txt"))
      << "a failed run keeps everything";
  EXPECT_NE(read_text_file(fs::path(failed.failure.run_directory) / "manifest.json")
                .find(to_string(injection.cause)),
            std::string::npos);
  EXPECT_NE(failed.failure.command.find("replay.sh"), std::string::npos);
  RunStore store(fake.settings.results / "store.sqlite");
  EXPECT_EQ(store.counts().failed, 1);
  EXPECT_EQ(store.counts().done, 2);
  EXPECT_EQ(store.counts().running, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Causes, FailureInjection,
    testing::Values(
        Injection{"crash", 1, FailureCause::engine_crash, "signal 11 (Segmentation fault)"},
        Injection{"hang", 2, FailureCause::timeout, "wall limit of 1 s"},
        Injection{"not_a_number", 3, FailureCause::not_a_number,
                  "curve.tsv:5:9: 'nan' in column 'axial_stress'"},
        Injection{"truncated", 4, FailureCause::truncated_output,
                  "ends after 3 rows without '# complete:'"},
        Injection{"missing", 5, FailureCause::missing_output, "wrote no 'curve.tsv'"},
        Injection{"status", 6, FailureCause::engine_crash, "status 3 without an error message"},
        Injection{"deck_error", 7, FailureCause::deck_error, "in.fake:11: Unknown pair style"},
        Injection{"wrong_column", 8, FailureCause::bad_output,
                  "no column 'axial_stress'; columns: step, time, force"},
        Injection{"lost_atoms", 9, FailureCause::lost_atoms,
                  "Lost atoms: original 100 current 99; "},
        Injection{"bond_atoms_missing", 10, FailureCause::bond_atoms_missing,
                  "Bond atoms 3 4 missing at step 7; "},
        Injection{"runaway_atoms", 18, FailureCause::runaway_atoms,
                  "atom 5 has flown to 0 9 0 m; no specimen that breaks"},
        Injection{"error_then_hang", 11, FailureCause::lost_atoms, "(then it hung and was ended)"},
        Injection{"malformed", 13, FailureCause::bad_output,
                  "curve.tsv:4:5: 'abc' in column 'axial_stress' isn't a number"},
        Injection{"not_a_number_in_engine", 14, FailureCause::not_a_number,
                  "Non-numeric positions"},
        Injection{"launcher", 16, FailureCause::launcher, "mpirun was unable to launch"}),
    [](const auto &info) { return info.param.name; });

TEST(FailureInjectionLauncher, AnMpirunThatIsNoProgramIsALauncherFailure) {
  FakeEngine fake;
  fake.settings.engine.mpirun = fake.folder.write("mpirun", "not executable");
  const auto outcomes = fake.run({0});
  EXPECT_EQ(outcomes[0].failure.cause, FailureCause::launcher);
  EXPECT_NE(outcomes[0].failure.message.find("can't be started"), std::string::npos)
      << outcomes[0].failure.message;
}

TEST(FailureInjectionStall, OutputThatStopsGrowingIsNoProgress) {
  FakeEngine fake;
  fake.settings.stall_limit = 1;
  const auto begin = std::chrono::steady_clock::now();
  const auto outcomes = fake.run({15});
  EXPECT_EQ(outcomes[0].failure.cause, FailureCause::no_progress) << outcomes[0].failure.message;
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 10);
}

TEST(FailureInjectionSpecimen, AGeneratorThatFailsSpoilsOnlyItsPacking) {
  FakeEngine fake;
  fake.study.tests[0].definition.deck_defaults["specimen"] = "x";
  fake.settings.specimens = [](const SpecimenEntry &, int) -> SpecimenFile {
    throw UserError("no equilibrium was found");
  };
  const auto outcomes = fake.run({0});
  EXPECT_EQ(outcomes[0].failure.cause, FailureCause::specimen);
  EXPECT_EQ(outcomes[0].failure.message,
            "the specimen 'none' (seed 5) can't be tested: no equilibrium was found");
  EXPECT_EQ(fake.total("start"), 0);
}

}  // namespace
}  // namespace bondlab
