// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/local_dump.h"

#include <gtest/gtest.h>

#include "base/user_error.h"
#include "view/run_for_tests.h"

namespace bondlab {
namespace {

std::string complaint(const std::string &text, const std::string &log,
                      const std::vector<std::string> &words = {}) {
  const TestFolder folder;
  try {
    read_local_dump(folder.write("bonds.txt", text), log, words);
  } catch (const UserError &error) {
    return error.what();
  }
  return "";
}

TEST(LocalDump, ColumnsGetTheWordsOfTheComputeInTheLog) {
  const TestFolder folder;
  const LocalDump dump = read_local_dump(folder.write("b.txt", lattice_forces()), lattice_log());
  EXPECT_EQ(dump.step, 400);
  EXPECT_EQ(dump.names, (std::vector<std::string>{"id2", "id1", "fs", "fn"}));
  ASSERT_EQ(dump.rows.size(), 2u);
  EXPECT_EQ(dump.rows[0], (std::vector<double>{2, 1, 5, -100}));
  EXPECT_EQ(dump.column("fn"), 3);
  EXPECT_EQ(dump.column("mb"), -1);
}

TEST(LocalDump, WordsInTheFileOrGivenByTheUserServeToo) {
  const TestFolder folder;
  std::string named = lattice_forces();
  named.replace(named.find("c_b[1]"), 27, "id1 id2 fn fs");
  EXPECT_EQ(read_local_dump(folder.write("n.txt", named), "").names,
            (std::vector<std::string>{"id1", "id2", "fn", "fs"}));
  EXPECT_EQ(
      read_local_dump(folder.write("b.txt", lattice_forces()), "", {"a", "b", "c", "d"}).names,
      (std::vector<std::string>{"a", "b", "c", "d"}));
}

TEST(LocalDump, LastFrameCounts) {
  const TestFolder folder;
  std::string late = lattice_forces();
  late.replace(late.find("400"), 3, "900");
  late.replace(late.find("-100"), 4, "-200");
  const LocalDump dump =
      read_local_dump(folder.write("b.txt", lattice_forces() + late), lattice_log());
  EXPECT_EQ(dump.step, 900);
  ASSERT_EQ(dump.rows.size(), 2u);
  EXPECT_EQ(dump.rows[0][3], -200);
}

TEST(LocalDump, SaysWhatIsWrong) {
  const auto expect = [](const std::string &text, const std::string &part) {
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" without " << part;
  };
  const std::string good = lattice_forces();
  expect(complaint(good, "compute other all bonded/local id1 id2 fn fs\n"),
         "what the column c_b[1] holds isn't in the run's log");
  expect(complaint(good, "", {"id1", "id2"}), "4 columns, but 2 names were given");
  expect(complaint(good.substr(0, good.size() - 10), lattice_log()), "the dump ends after 1 of 2");
  std::string bad = good;
  bad.replace(bad.find("-100"), 4, "nan ");
  expect(complaint(bad, lattice_log()), "bonds.txt:10: 'nan' isn't a finite number");
  expect(complaint("ITEM: TIMESTEP\n0\n", ""), "this isn't a `dump local` file");
}

}  // namespace
}  // namespace bondlab
