// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what a user gets for bad input from the real programs: one clear message with its place, an
// exit status that isn't 0, and nothing half-written. The wording of each message is tested beside
// the readers; here it is the whole way. Method: copies of inputs/studies/granite_small.toml with
// lines exchanged, through `bondlab check` and `bondlab run`.
#include <gtest/gtest.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include "base/sha256.h"
#include "base/test_folder.h"

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path &file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class BadInput : public ::testing::Test {
 protected:
  void SetUp() override {
    study_ = text_of(fs::path(BONDLAB_SOURCE_DIR) / "inputs/studies/granite_small.toml");
    ASSERT_FALSE(study_.empty());
  }

  // Exchanges the first occurrence; the study must have it.
  static void exchange(std::string &text, const std::string &old_text,
                       const std::string &new_text) {
    const std::size_t at = text.find(old_text);
    ASSERT_NE(at, std::string::npos) << old_text;
    text.replace(at, old_text.size(), new_text);
  }
  void edit(const std::string &old_text, const std::string &new_text) {
    exchange(study_, old_text, new_text);
  }

  // Line of the study, as it is now, that begins with `text`.
  int line_of(const std::string &text) const {
    std::istringstream lines(study_);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (line.rfind(text, 0) == 0) return number;
    }
    return -1;
  }

  // Runs bondlab in the folder on study.toml; standard error goes to err_.
  int bondlab(const std::string &arguments, const std::string &environment = "") {
    folder_.write("study.toml", study_);
    const std::string command = "cd '" + folder_.path().string() + "' && " + environment + " '" +
                                BONDLAB_BIN + "' " + arguments + " >out.txt 2>err.txt </dev/null";
    const int status = std::system(command.c_str());
    err_ = text_of(folder_ / "err.txt");
    out_ = text_of(folder_ / "out.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  void expect_error(const std::string &text) const {
    EXPECT_NE(err_.find(text), std::string::npos) << "wanted: " << text << "\ngot: " << err_;
  }
  void expect_nothing_written() const { EXPECT_FALSE(fs::exists(folder_ / "bondlab-results")); }

  // A copy of the compression test with its deck changed, named by path in the study.
  void change_deck(const std::string &old_text, const std::string &new_text) {
    const fs::path inputs = fs::path(BONDLAB_SOURCE_DIR) / "inputs/uniaxial_compression";
    std::string deck = text_of(inputs / "in.uniaxial_compression");
    exchange(deck, old_text, new_text);
    folder_.write("changed/in.uniaxial_compression", deck);
    folder_.write("changed/test.toml", text_of(inputs / "test.toml"));
    edit("test = \"uniaxial_compression\"", "test = \"./changed\"");
  }

  bondlab::TestFolder folder_;
  std::string study_, err_, out_;
};

TEST_F(BadInput, TheUnchangedStudyIsRight) {
  EXPECT_EQ(bondlab("check study.toml"), 0) << err_;
  EXPECT_NE(out_.find("study.toml: nothing wrong"), std::string::npos);
  EXPECT_EQ(err_, "");
  expect_nothing_written();
}

TEST_F(BadInput, EverythingWrongIsToldAtOnceAndNothingIsRun) {
  edit("seed = 1\n", "sede = 1\n");                       // unknown key
  edit("width = \"25 mm\"", "width = \"25 MPa\"");        // wrong unit
  edit("ranks = 1", "ranks = \"1\"");                     // wrong type
  edit("lower = \"20 GPa\"", "lower = \"40 GPa\"");       // bounds reversed
  edit("lower = \"20 MPa\"", "lower = \"-20 MPa\"");      // negative strength
  edit("test = \"brazilian\"\n", "test = \"brasilian\"\n");  // no such test
  for (const std::string command : {"check", "run", "fit"}) {
    EXPECT_EQ(bondlab(command + " study.toml"), 1);
    expect_error("error: study.toml:" + std::to_string(line_of("sede")) +
                 ":1: unknown key 'sede' in [[specimens]] (did you mean 'seed'?)");
    expect_error("error: study.toml:" + std::to_string(line_of("width")) +
                 ":9: '25 MPa' has the unit 'MPa'; allowed here: m, cm, mm, um");
    expect_error("error: study.toml:" + std::to_string(line_of("ranks")) +
                 ":9: 'ranks' must be a whole number, \"1\" is a string");
    expect_error("error: study.toml:" + std::to_string(line_of("lower = \"40")) +
                 ":9: the bounds are reversed or equal: lower = 40 GPa, upper = 30 GPa");
    expect_error("error: study.toml:" + std::to_string(line_of("lower = \"-20")) +
                 ":9: 'lower' can't be -20 MPa");
    expect_error(
        ": there is no virtual test 'brasilian' (did you mean 'brazilian'?); known: brazilian, ");
    EXPECT_EQ(out_, "");
    expect_nothing_written();
  }
}

TEST_F(BadInput, AMissingFileAndAMisspelledCommandAreUserErrors) {
  EXPECT_EQ(bondlab("check nothing.toml"), 1);
  expect_error("error: nothing.toml: there is no such file");
  EXPECT_EQ(bondlab("chek study.toml"), 1);
  expect_error(
      "error: there is no command 'chek' (did you mean 'check'?); commands: check, run, ");
  EXPECT_EQ(bondlab("check study.toml --jbs 3"), 1);
  expect_error("error: ");
  EXPECT_EQ(bondlab("--help"), 0);
  expect_nothing_written();
}

TEST_F(BadInput, RanksTimesJobsBeyondTheCoresIsAnError) {
  EXPECT_EQ(bondlab("check study.toml --jobs 10000"), 1);
  expect_error("error: study.toml:" + std::to_string(line_of("[[tests]]")) +
               ":1: ranks x jobs = 1 x 10000 = 10000 for the test 'ucs'");
}

TEST_F(BadInput, AValueToSetIsJudgedBeforeAnythingRuns) {
  EXPECT_EQ(bondlab("run study.toml --set sigma_c=\"50 GPa/m\""), 1);
  expect_error(
      "error: --set sigma_c: '50 GPa/m' has the unit 'GPa/m'; allowed here: Pa, kPa, MPa, GPa");
  EXPECT_EQ(bondlab("run study.toml --set sigmac=\"50 MPa\""), 1);
  expect_error(
      "error: --set: the study has no parameter 'sigmac' (did you mean 'sigma_c'?); it has: E_c, "
      "kn_ks, sigma_c");
  EXPECT_EQ(bondlab("run study.toml --set sigma_c=\"-50 MPa\""), 1);
  expect_error("error: the variable 'sigma_c' of the test 'ucs' can't be -5e+07 Pa; it must be");
  EXPECT_EQ(bondlab("run study.toml --test usc"), 1);
  expect_error("the study has no test 'usc'; it has: ucs, brazilian");
}

TEST_F(BadInput, AnErrorInTheDeckNamesItsFileAndLine) {
  change_deck("pair_style      grain", "pair_style      gravel");
  EXPECT_EQ(bondlab("run study.toml --test ucs"), 2);
  std::istringstream deck(text_of(folder_ / "changed/in.uniaxial_compression"));
  int number = 0;
  for (std::string line; std::getline(deck, line) && line.find("gravel") == std::string::npos;)
    ++number;
  expect_error("error: the test 'ucs' failed (deck_error): ");
  expect_error("in.uniaxial_compression:" + std::to_string(number + 1) + ": ");
  expect_error("air style");  // the engine's own words
  expect_error("replay: sh ");
}

TEST_F(BadInput, ACrashOfTheEngineIsNamedAndItsFolderKept) {
  const fs::path crash = folder_.write("crash.sh", "#!/bin/sh\nkill -SEGV $$\n");
  fs::permissions(crash, fs::perms::owner_all);
  EXPECT_EQ(bondlab("run study.toml --test ucs", "BONDLAB_LMP='" + crash.string() + "'"), 2);
  expect_error(
      "error: the test 'ucs' failed (engine_crash): the engine was ended by signal 11 "
      "(Segmentation fault)");
  int kept = 0;
  for (const auto &entry : fs::directory_iterator(folder_ / "bondlab-results/granite_small/runs"))
    kept += fs::exists(entry.path() / "screen.txt");
  EXPECT_EQ(kept, 1);
  // The real engine is another engine: its run has nothing to do with the failed one.
  EXPECT_EQ(bondlab("run study.toml --test ucs"), 0) << err_;
  EXPECT_NE(out_.find("UCS"), std::string::npos);
}

TEST_F(BadInput, ADeckThatHangsEndsAtTheWallLimit) {
  change_deck("run             ${steps}", "shell sleep 100");
  edit("wall_limit = \"300 s\"", "wall_limit = \"3 s\"");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(bondlab("run study.toml --test ucs"), 2);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 40);
  expect_error("error: the test 'ucs' failed (timeout): ended at the wall limit of 3 s");
}

TEST_F(BadInput, AParticleOutsideTheBoxOfASpecimenFileIsFound) {
  ASSERT_EQ(bondlab("specimen disc --diameter '20 mm' --r-min '0.8 mm' --out disc.data"), 0)
      << err_;
  std::string data = text_of(folder_ / "disc.data");
  const std::size_t atoms = data.find("Atoms"), row = data.find("\n\n", atoms) + 2,
                    end = data.find('\n', row);
  std::istringstream cells(data.substr(row, end - row));
  std::string id, type, diameter, density;
  cells >> id >> type >> diameter >> density;
  data.replace(row, end - row, id + " " + type + " " + diameter + " " + density + " 9.0 0 0");
  folder_.write("disc.data", data);
  EXPECT_EQ(bondlab("specimen check disc.data"), 1);
  const auto line = std::count(data.begin(), data.begin() + static_cast<long>(row), '\n') + 1;
  expect_error("error: disc.data:" + std::to_string(line) + ":");
}

// A packing cut in two by a gap that no bond crosses: refused as an import, by `specimen check`, and
// before a run although its record is in order.
TEST_F(BadInput, APackingInPiecesIsRefusedOnEveryWay) {
  ASSERT_EQ(bondlab("run study.toml --test ucs"), 0) << err_;
  fs::path data;
  for (const auto &entry : fs::recursive_directory_iterator(folder_ / "bondlab-results"))
    if (entry.path().filename().string().rfind("rectangle-", 0) == 0 &&
        entry.path().extension() == ".data")
      data = entry.path();
  ASSERT_FALSE(data.empty());
  fs::path record = data;
  record.replace_extension(".json");

  // The upper half is lifted by 1 mm.
  std::istringstream rows(text_of(data));
  std::string cut, xyzr;
  bool in_atoms = false;
  for (std::string line; std::getline(rows, line); cut += line + "\n") {
    std::istringstream cells(line);
    std::string id, type, density;
    double diameter = 0, x = 0, y = 0;
    if (in_atoms && cells >> id >> type >> diameter >> density >> x >> y) {
      if (y > 0.025) y += 0.001;
      std::ostringstream place, row;
      place.precision(17), row.precision(17);
      place << x << " " << y << " 0";
      row << id << " " << type << " " << diameter << " " << density << " " << place.str();
      line = row.str();
      xyzr += place.str() + " " + std::to_string(diameter / 2) + "\n";
    }
    in_atoms = in_atoms || line == "Atoms";
  }
  folder_.write("halves.xyzr", xyzr);
  EXPECT_EQ(bondlab("specimen rectangle --width '25 mm' --height '51 mm' --from halves.xyzr --out "
                    "halves.data"),
            1);
  expect_error("touches the rest nowhere within the bond gap");
  EXPECT_FALSE(fs::exists(folder_ / "halves.data"));
  folder_.write("halves.data", "# no description\n" + cut.substr(cut.find('\n') + 1));
  EXPECT_EQ(bondlab("specimen check halves.data --gap '0.08 mm'"), 1);
  expect_error("error: halves.data:");
  expect_error("touches the rest nowhere within the bond gap");

  const std::string old_hash = bondlab::sha256(text_of(data));
  std::string entry = text_of(record);
  exchange(entry, old_hash, bondlab::sha256(cut));
  std::ofstream(data, std::ios::binary) << cut;
  std::ofstream(record, std::ios::binary) << entry;
  EXPECT_EQ(bondlab("run study.toml --test ucs --set sigma_c=\"41 MPa\""), 2);
  expect_error("the packing is in pieces: ");
  expect_error(data.filename().string() + ":");
}

int engines_of(const fs::path &folder) {
  int count = 0;
  std::error_code error;
  for (const auto &entry : fs::directory_iterator("/proc", error))
    count += text_of(entry.path() / "environ").find("BONDLAB_RUN_DIR=" + folder.string()) !=
             std::string::npos;
  return count;
}

TEST_F(BadInput, InterruptAndKillLeaveNoEngineAndTheSameCommandGoesOn) {
  for (const int signal : {SIGINT, SIGKILL}) {
    folder_.write("study.toml", study_);
    const fs::path results = folder_ / ("results" + std::to_string(signal));
    const pid_t driver = fork();
    if (driver == 0) {
      if (chdir(folder_.path().c_str()) != 0 || !freopen("out.txt", "w", stdout) ||
          !freopen("err.txt", "w", stderr))
        _exit(99);
      execl(BONDLAB_BIN, BONDLAB_BIN, "run", "study.toml", "--out", results.c_str(),
            static_cast<char *>(nullptr));
      _exit(99);
    }
    // Until an engine is at work.
    bool begun = false;
    for (int i = 0; i < 3000 && !begun; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::error_code error;
      for (const auto &entry : fs::directory_iterator(results / "runs", error))
        begun = begun || text_of(entry.path() / "curve.tsv").size() > 300;
    }
    ASSERT_TRUE(begun);
    kill(driver, signal);
    int status = 0;
    waitpid(driver, &status, 0);
    if (signal == SIGINT) {
      EXPECT_EQ(WEXITSTATUS(status), 130);
      EXPECT_NE(text_of(folder_ / "err.txt")
                    .find("error: interrupted; the same command goes on from here"),
                std::string::npos);
    }
    for (int i = 0; i < 500 && engines_of(results) > 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(engines_of(results), 0);
    EXPECT_EQ(bondlab("run study.toml --out '" + results.string() + "'"), 0) << err_;
    EXPECT_NE(out_.find("UCS"), std::string::npos);
  }
}

}  // namespace
