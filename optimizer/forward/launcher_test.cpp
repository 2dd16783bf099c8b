// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/launcher.h"

#include <gtest/gtest.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "base/table_file.h"
#include "base/test_folder.h"

namespace bondlab {
namespace {

using namespace std::chrono_literals;

Launch shell(const TestFolder &folder, const std::string &script) {
  Launch launch;
  launch.command = {"/bin/sh", "-c", script};
  launch.directory = folder.path();
  launch.screen = folder / "screen.txt";
  return launch;
}

RunEnd wait_for(EngineProcess &process) {
  for (int i = 0; i < 2000 && !process.poll(); ++i) std::this_thread::sleep_for(5ms);
  EXPECT_TRUE(process.poll());
  return process.end();
}

bool alive(const TestFolder &folder, const std::string &pid_file) {
  const pid_t pid = static_cast<pid_t>(std::stol(read_text_file(folder / pid_file)));
  if (kill(pid, 0) != 0) return false;
  const std::string stat = read_text_file("/proc/" + std::to_string(pid) + "/stat");
  return stat.find(") Z ") == std::string::npos;
}

TEST(EngineProcess, RunsInItsFolderWithOutputInAFileAndNoInput) {
  const TestFolder folder;
  Launch launch = shell(folder, "pwd; cat; echo $COLOUR >&2; exit 4");
  launch.environment["COLOUR"] = "blue";
  EngineProcess process(launch);
  const RunEnd end = wait_for(process);
  EXPECT_EQ(end.reason, EndReason::by_itself);
  EXPECT_EQ(end.status, 4);
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(read_text_file(folder / "screen.txt"),
            std::filesystem::canonical(folder.path()).string() + "\nblue\n");
}

TEST(EngineProcess, ReportsTheSignalThatEndedIt) {
  const TestFolder folder;
  EngineProcess process(shell(folder, "kill -9 $$"));
  const RunEnd end = wait_for(process);
  EXPECT_EQ(end.status, -1);
  EXPECT_EQ(end.signal, SIGKILL);
}

TEST(EngineProcess, AProgramThatIsNotThereIsAnError) {
  const TestFolder folder;
  Launch launch = shell(folder, "");
  launch.command[0] = "/no/such/program";
  try {
    EngineProcess process(launch);
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(error.text().find("'/no/such/program' can't be started in '"), std::string::npos);
    EXPECT_NE(error.text().find("No such file or directory"), std::string::npos);
  }
}

TEST(EngineProcess, TheWallLimitEndsTheWholeFamilyEvenInGroupsOfItsOwn) {
  const TestFolder folder;
  // As mpirun does: the children get process groups of their own; one ignores SIGTERM.
  Launch launch = shell(folder,
                        "setsid sh -c 'trap \"\" TERM; echo $$ >one; sleep 100' & sh -c 'echo $$ "
                        ">two; exec sleep 100' & wait");
  launch.wall_limit = 0.5;
  EngineProcess process(launch);
  const RunEnd end = wait_for(process);
  EXPECT_EQ(end.reason, EndReason::wall_limit);
  EXPECT_GE(end.wall_seconds, 0.5);
  EXPECT_LT(end.wall_seconds, 5);
  EXPECT_FALSE(alive(folder, "one"));
  EXPECT_FALSE(alive(folder, "two"));
}

TEST(EngineProcess, TheWatchdogWaitsWhileAFileGrows) {
  const TestFolder folder;
  Launch launch =
      shell(folder, "for i in 1 2 3 4 5 6 7 8; do echo $i >>log; sleep 0.3; done; sleep 100");
  launch.watched = {folder / "log"};
  launch.stall_limit = 1;
  EngineProcess process(launch);
  const RunEnd end = wait_for(process);
  EXPECT_EQ(end.reason, EndReason::stalled);
  EXPECT_GT(end.wall_seconds, 2.4 + 1 - 0.5)
      << "growth until 2.4 s, then the limit, less one interval of looking";
  EXPECT_EQ(read_text_file(folder / "log"), "1\n2\n3\n4\n5\n6\n7\n8\n");
}

TEST(EngineProcess, KillEndsItAtOnce) {
  const TestFolder folder;
  EngineProcess process(shell(folder, "trap '' TERM; echo $$ >one; while :; do sleep 0.1; done"));
  for (int i = 0; i < 400 && !std::filesystem::exists(folder / "one"); ++i)
    std::this_thread::sleep_for(5ms);
  std::this_thread::sleep_for(50ms);
  process.kill();
  EXPECT_TRUE(process.poll());
  EXPECT_EQ(process.end().reason, EndReason::killed);
  EXPECT_FALSE(alive(folder, "one"));
}

TEST(EngineProcess, DiesWithTheProcessThatStartedIt) {
  const TestFolder folder;
  const pid_t driver = fork();
  if (driver == 0) {
    EngineProcess process(shell(folder, "echo $$ >one; exec sleep 100"));
    for (;;) pause();
  }
  for (int i = 0; i < 400 && !std::filesystem::exists(folder / "one"); ++i)
    std::this_thread::sleep_for(5ms);
  std::this_thread::sleep_for(50ms);
  EXPECT_TRUE(alive(folder, "one"));
  kill(driver, SIGKILL);
  waitpid(driver, nullptr, 0);
  for (int i = 0; i < 400 && alive(folder, "one"); ++i) std::this_thread::sleep_for(5ms);
  EXPECT_FALSE(alive(folder, "one"));
}

TEST(KillProcessesOfRun, KnowsThemByTheirFolderOnly) {
  const TestFolder folder, other;
  EngineProcess mine(shell(folder, "sleep 100 & wait")), theirs(shell(other, "sleep 100"));
  kill_processes_of_run(folder.path());
  EXPECT_EQ(wait_for(mine).signal, SIGKILL);
  std::this_thread::sleep_for(50ms);
  EXPECT_FALSE(theirs.poll());
}

}  // namespace
}  // namespace bondlab
