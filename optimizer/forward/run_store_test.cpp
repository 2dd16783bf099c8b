// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/run_store.h"

#include <gtest/gtest.h>

#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "base/test_folder.h"

namespace bondlab {
namespace {

RunKey key(const std::string &name, std::uint64_t seed = 1) {
  RunKey key;
  key.full = name;
  key.point = "point of " + name;
  key.seed = seed;
  return key;
}

RunPlan plan() {
  RunPlan plan;
  plan.test = plan.virtual_test = "ucs";
  plan.variables = {{"E_c", "3e10"}, {"word", "normal"}};
  plan.specimen.size.width = plan.specimen.size.height = 0.05;
  return plan;
}

void sql(const std::filesystem::path &file, const std::string &text) {
  sqlite3 *database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  sqlite3_close(database);
}

TEST(RunStore, ARunGoesFromQueuedThroughRunningToDone) {
  const TestFolder folder;
  RunStore store(folder / "s.sqlite");
  const RunRecord queued = store.get_or_queue(key("a"), plan());
  EXPECT_EQ(queued.state, RunState::queued);
  EXPECT_TRUE(store.claim(queued.id, "runs/1"));
  EXPECT_EQ(store.find("a")->state, RunState::running);
  EXPECT_TRUE(store.owner_is_alive(*store.find("a")));
  store.finish_done(queued.id, 12.5);
  const RunRecord done = *store.find("a");
  EXPECT_EQ(done.state, RunState::done);
  EXPECT_EQ(done.wall_seconds, 12.5);
  EXPECT_EQ(done.directory, "runs/1");
  EXPECT_EQ(done.attempts, 1);
  EXPECT_EQ(done.seed, 1u);
  EXPECT_FALSE(store.claim(queued.id, "runs/2")) << "what is done isn't done again";
  EXPECT_EQ(store.get_or_queue(key("a"), plan()).id, queued.id);
  EXPECT_FALSE(store.find("b").has_value());
}

TEST(RunStore, OneRunIsClaimedOnce) {
  const TestFolder folder;
  RunStore one(folder / "s.sqlite"), other(folder / "s.sqlite");
  const std::int64_t id = one.get_or_queue(key("a"), plan()).id;
  EXPECT_EQ(other.get_or_queue(key("a"), plan()).id, id);
  EXPECT_TRUE(one.claim(id, "runs/1"));
  EXPECT_FALSE(other.claim(id, "runs/2"));
  EXPECT_EQ(other.find("a")->directory, "runs/1");
}

TEST(RunStore, FailuresAreCountedAndKept) {
  const TestFolder folder;
  RunStore store(folder / "s.sqlite");
  const std::int64_t id = store.get_or_queue(key("a"), plan()).id;
  for (int attempt = 1; attempt <= 2; ++attempt) {
    ASSERT_TRUE(store.claim(id, "runs/" + std::to_string(attempt)));
    Failure failure;
    failure.cause = FailureCause::lost_atoms;
    failure.message = "attempt " + std::to_string(attempt);
    store.finish_failed(id, failure, 3);
    EXPECT_EQ(store.find("a")->attempts, attempt);
  }
  EXPECT_EQ(store.find("a")->cause, FailureCause::lost_atoms);
  EXPECT_EQ(store.find("a")->message, "attempt 2");
  store.mark_lost(id, "files gone");
  EXPECT_EQ(store.find("a")->state, RunState::lost);
  EXPECT_EQ(store.find("a")->attempts, 2) << "a lost run isn't an attempt";
}

TEST(RunStore, ARunOfADeadProcessMayBeTaken) {
  const TestFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    RunStore store(folder / "s.sqlite");
    const bool claimed = store.claim(store.get_or_queue(key("a"), plan()).id, "runs/1");
    _exit(claimed ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  RunStore store(folder / "s.sqlite");
  const RunRecord run = *store.find("a");
  EXPECT_EQ(run.state, RunState::running);
  EXPECT_EQ(run.owner.pid, child);
  EXPECT_FALSE(store.owner_is_alive(run));
  EXPECT_TRUE(store.claim(run.id, "runs/2"));
}

TEST(RunStore, APidUsedAgainIsNotTheOwner) {
  const TestFolder folder;
  RunStore store(folder / "s.sqlite");
  const std::int64_t id = store.get_or_queue(key("a"), plan()).id;
  ASSERT_TRUE(store.claim(id, "runs/1"));
  EXPECT_TRUE(store.owner_is_alive(*store.find("a")));
  sql(folder / "s.sqlite", "UPDATE runs SET start_ticks = start_ticks + 1");
  EXPECT_FALSE(store.owner_is_alive(*store.find("a")));
  sql(folder / "s.sqlite", "UPDATE runs SET start_ticks = start_ticks - 1, boot = 'another'");
  EXPECT_FALSE(store.owner_is_alive(*store.find("a"))) << "the machine was started again";
}

TEST(RunStore, AnOwnerOnAnotherHostLivesAsLongAsItsHeartbeat) {
  const TestFolder folder;
  RunStore store(folder / "s.sqlite");
  ASSERT_TRUE(store.claim(store.get_or_queue(key("a"), plan()).id, "runs/1"));
  sql(folder / "s.sqlite", "UPDATE runs SET host = 'elsewhere', boot = 'another'");
  EXPECT_TRUE(store.owner_is_alive(*store.find("a")));
  sql(folder / "s.sqlite", "UPDATE runs SET heartbeat = heartbeat - 3600");
  EXPECT_FALSE(store.owner_is_alive(*store.find("a")));
}

TEST(RunStore, HeartbeatMovesOnlyOurRunningRuns) {
  const TestFolder folder;
  RunStore store(folder / "s.sqlite");
  ASSERT_TRUE(store.claim(store.get_or_queue(key("a"), plan()).id, "runs/1"));
  const RunRecord b = store.get_or_queue(key("b"), plan());
  ASSERT_TRUE(store.claim(b.id, "runs/2"));
  store.finish_done(b.id, 1);
  sql(folder / "s.sqlite", "UPDATE runs SET heartbeat = 5");
  store.heartbeat();
  EXPECT_GT(store.find("a")->heartbeat, 5);
  EXPECT_EQ(store.find("b")->heartbeat, 5);
}

TEST(RunStore, MeanSecondsAreOfFinishedRunsOfTheWorkload) {
  const TestFolder folder;
  RunStore store(folder / "s.sqlite");
  EXPECT_FALSE(store.mean_seconds(workload_of(plan())).has_value());
  for (const auto &[name, seconds] : {std::make_pair("a", 10.0), std::make_pair("b", 20.0)}) {
    const std::int64_t id = store.get_or_queue(key(name), plan()).id;
    ASSERT_TRUE(store.claim(id, "runs/x"));
    store.finish_done(id, seconds);
  }
  const std::int64_t failed = store.get_or_queue(key("c"), plan()).id;
  ASSERT_TRUE(store.claim(failed, "runs/x"));
  store.finish_failed(failed, {FailureCause::timeout, "", "", "", ""}, 1000);
  EXPECT_EQ(store.mean_seconds(workload_of(plan())).value(), 15);
  RunPlan other = plan();
  other.specimen.size.width *= 2;
  EXPECT_FALSE(store.mean_seconds(workload_of(other)).has_value());
}

template <class Function>
std::string message(Function function) {
  try {
    function();
  } catch (const UserError &error) {
    return error.text();
  }
  return "accepted";
}

TEST(RunStore, AnotherSchemaVersionIsAClearError) {
  const TestFolder folder;
  { RunStore store(folder / "s.sqlite"); }
  EXPECT_NO_THROW(RunStore(folder / "s.sqlite"));
  sql(folder / "s.sqlite", "PRAGMA user_version = 7");
  EXPECT_EQ(message([&] { RunStore(folder / "s.sqlite"); }),
            "this run store has schema version 7, this bondlab reads version 1; use the bondlab it "
            "was made with, or another --out");
}

TEST(RunStore, AFileThatIsNoStoreIsLeftAlone) {
  const TestFolder folder;
  const auto text = folder.write(
      "text.sqlite",
      "This is not a database, and it is long enough to be told from one by its first bytes.\n");
  EXPECT_NE(message([&] { RunStore store(text); }).find("this file isn't a run store"),
            std::string::npos);
  sql(folder / "other.sqlite", "CREATE TABLE theirs (a)");
  EXPECT_EQ(message([&] { RunStore store(folder / "other.sqlite"); }),
            "this SQLite file isn't a run store; choose another --out or move it away");
  EXPECT_NE(message([&] { RunStore store(folder / "text.sqlite" / "s.sqlite"); }), "accepted");
}

TEST(RunStore, ManyProcessesMayMakeItAtOnce) {
  for (int round = 0; round < 20; ++round) {
    const TestFolder folder;
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) {
      children.push_back(fork());
      if (children.back() != 0) continue;
      try {
        RunStore store(folder / "s.sqlite");
        store.get_or_queue(key("a"), plan());
        _exit(0);
      } catch (const std::exception &) {
        _exit(1);
      }
    }
    for (const pid_t child : children) {
      int status = 0;
      waitpid(child, &status, 0);
      EXPECT_EQ(status, 0) << "round " << round;
    }
    EXPECT_EQ(RunStore(folder / "s.sqlite").counts().queued, 1);
  }
}

TEST(RunStore, WhatWasCommittedSurvivesKillNine) {
  const TestFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    RunStore store(folder / "s.sqlite");
    for (int i = 0;; ++i) {
      const std::int64_t id = store.get_or_queue(key(std::to_string(i)), plan()).id;
      store.claim(id, "runs/x");
      store.finish_done(id, i);
    }
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  RunStore store(folder / "s.sqlite");
  const RunStore::Counts counts = store.counts();
  EXPECT_GT(counts.done, 0);
  EXPECT_LE(counts.queued + counts.running, 1) << "one run was in the works, no row is torn";
  for (int i = 0; i < counts.done; ++i) EXPECT_EQ(store.find(std::to_string(i))->wall_seconds, i);
}

}  // namespace
}  // namespace bondlab
