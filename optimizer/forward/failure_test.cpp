// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/failure.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"

namespace bondlab {
namespace {

const char *const kDeck =
    "# a deck\n"                      // 1
    "variable a index 3   # three\n"  // 2
    "units si\n"                      // 3
    "if \"${a} == 3\" then &\n"       // 4
    "  \"variable q equal 4\" &\n"    // 5
    "  \"variable r equal 5\"\n"      // 6
    "label again\n"                   // 7
    "run 10\n"                        // 8
    "jump SELF again\n"               // 9
    "units si\n";                     // 10

TEST(LastDeckLine, IsTheCommandEchoedLast) {
  EXPECT_EQ(last_deck_line(kDeck, "LIGGGHTS\n# a deck\nvariable a index 3   # three\n"), 2);
  EXPECT_EQ(last_deck_line(kDeck, "variable a index 3\nunits si\nStep 1 2\n"), 3);
  EXPECT_EQ(last_deck_line(kDeck, "nothing of it\n"), 0);
  EXPECT_EQ(last_deck_line(kDeck, ""), 0);
}

TEST(LastDeckLine, JoinsContinuedLinesAsTheEngineDoes) {
  EXPECT_EQ(last_deck_line(kDeck,
                           "units si\nif \"${a} == 3\" then   \"variable q equal 4\"   \"variable "
                           "r equal 5\"\nvariable q equal 4\n"),
            4);
}

TEST(LastDeckLine, TellsEqualLinesApartByWhatCameBefore) {
  EXPECT_EQ(last_deck_line(kDeck, "units si\n"), 3);
  EXPECT_EQ(last_deck_line(kDeck, "units si\nrun 10\nunits si\n"), 10);
  EXPECT_EQ(last_deck_line(kDeck,
                           "units si\nlabel again\nrun 10\njump SELF again\nlabel again\nrun 10\n"),
            8)
      << "after a jump back";
}

TEST(LogTail, IsTheEndOfTheLogOrOfTheScreen) {
  const TestFolder folder;
  EXPECT_EQ(log_tail(folder.path()), "");
  folder.write("screen.txt", "one\ntwo\n");
  EXPECT_EQ(log_tail(folder.path()), "one\ntwo");
  folder.write("log.bondlab", "1\n2\n3\n4\n");
  EXPECT_EQ(log_tail(folder.path(), 2), "3\n4");
}

TEST(FailureCauseNames, GoBothWays) {
  for (int i = 0; i <= static_cast<int>(FailureCause::specimen); ++i) {
    const auto cause = static_cast<FailureCause>(i);
    EXPECT_EQ(failure_cause_from(to_string(cause)), cause);
  }
  EXPECT_THROW(failure_cause_from("sunspots"), UserError);
}

}  // namespace
}  // namespace bondlab
