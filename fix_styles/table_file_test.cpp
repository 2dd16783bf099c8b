// SPDX-License-Identifier: GPL-2.0-or-later
#include "table_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <random>

namespace {

using bondlab::number_text;
using bondlab::TableFile;
namespace fs = std::filesystem;

class TableFileTest : public testing::Test {
 protected:
  TableFileTest() {
    std::string pattern = (fs::temp_directory_path() / "bondlab-table-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    path_ = (folder_ / "t.tsv").string();
  }
  ~TableFileTest() override { fs::remove_all(folder_); }
  std::string text() const {
    std::ifstream in(path_);
    std::stringstream s;
    s << in.rdbuf();
    return s.str();
  }
  void write(const std::string &s) const { std::ofstream(path_) << s; }

  fs::path folder_;
  std::string path_;
  const std::vector<std::string> names_ = {"step", "force"}, units_ = {"1", "N"};
  const std::string head_ = "# bondlab-curve 1\n# names: step\tforce\n# units: 1\tN\n";
};

TEST(NumberText, ReadsBackToTheSameDouble) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 100000; ++k) {
    const std::uint64_t bits = random();
    double x;
    std::memcpy(&x, &bits, sizeof x);
    if (x != x) continue;
    ASSERT_EQ(std::strtod(number_text(x).c_str(), nullptr), x);
  }
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(-3.0), "-3");
}

TEST_F(TableFileTest, WritesTheFormat) {
  TableFile t;
  t.create(path_, "bondlab-curve 1", names_, units_);
  EXPECT_EQ(text(), head_);
  t.row(0, {"0"});
  EXPECT_EQ(text(), head_ + "0\t0\n");  // flushed row by row
  t.row(10, {number_text(1.5)});
  t.complete("end_of_run");
  EXPECT_EQ(text(), head_ + "0\t0\n10\t1.5\n# complete: end_of_run\n");
}

TEST_F(TableFileTest, AnotherRunTakesTheCompletionOff) {
  TableFile t;
  t.create(path_, "bondlab-curve 1", names_, units_);
  t.row(0, {"0"});
  t.complete("end_of_run");
  t.resume();
  EXPECT_EQ(text(), head_ + "0\t0\n");
  t.resume();
  t.row(10, {"1"});
  t.complete("stop_after_peak");
  EXPECT_EQ(text(), head_ + "0\t0\n10\t1\n# complete: stop_after_peak\n");
}

TEST_F(TableFileTest, GoesOnAfterTheStepOfTheRestart) {
  const std::string rows = "0\t0\n10\t1\n20\t2\n";
  for (const std::string &tail :
       {std::string(), std::string("# complete: end_of_run\n"), std::string("30\t3\n40\t4\n"),
        std::string("30\t3"), std::string("30\t3\n# complete: end_of_run\n")}) {
    write(head_ + rows + tail);
    TableFile t;
    t.go_on(path_, "bondlab-curve 1", names_, units_, 25);
    EXPECT_EQ(t.last_step(), 20);
    t.row(30, {"3.5"});
    EXPECT_EQ(text(), head_ + rows + "30\t3.5\n") << tail;
  }
}

TEST_F(TableFileTest, GoesOnWithNothing) {
  for (const std::string &old : {std::string("none"), std::string(), head_.substr(0, 30), head_}) {
    fs::remove(path_);
    if (old != "none") write(old);
    TableFile t;
    t.go_on(path_, "bondlab-curve 1", names_, units_, 100);
    EXPECT_EQ(t.last_step(), -1);
    t.row(100, {"1"});
    EXPECT_EQ(text(), head_ + "100\t1\n");
  }
}

TEST_F(TableFileTest, RefusesAFileOfOtherColumns) {
  write("# bondlab-curve 1\n# names: step\tstrain\n# units: 1\t1\n0\t0\n");
  TableFile t;
  EXPECT_THROW(t.go_on(path_, "bondlab-curve 1", names_, units_, 100), std::runtime_error);
  EXPECT_NE(text().find("strain"), std::string::npos);  // left as it was
}

TEST_F(TableFileTest, SaysWhyAFileCannotBeWritten) {
  TableFile t;
  try {
    t.create((folder_ / "absent" / "t.tsv").string(), "bondlab-curve 1", names_, units_);
    FAIL();
  } catch (const std::runtime_error &e) {
    EXPECT_NE(std::string(e.what()).find("absent"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos);
  }
  if (!fs::exists("/dev/full")) return;
  TableFile full;
  EXPECT_THROW(full.create("/dev/full", "bondlab-curve 1", names_, units_), std::runtime_error);
}

}  // namespace
