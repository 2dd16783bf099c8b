// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a study, an engine and a ledger made of shell scripts, so that a driver's behaviour is
// tested in seconds; tests only. Method: testdata/fake_engine.sh does what the deck variable `act`
// says (0 a good run, 1 a crash, ... see there).
#pragma once

#include <cstdlib>
#include <map>
#include <sstream>

#include "base/sha256.h"
#include "base/table_file.h"
#include "base/test_folder.h"
#include "forward/engine_forward_model.h"

namespace bondlab {

struct FakeEngine {
  FakeEngine() : testdata(std::filesystem::path(__FILE__).parent_path() / "testdata") {
    study = read_study(testdata / "study.toml");
    settings.results = folder / "results";
    settings.engine.program = testdata / "fake_engine.sh";
    settings.engine.mpirun = testdata / "fake_mpirun.sh";
    settings.engine.hash = sha256_file(settings.engine.program);
    settings.cores = 4;
    setenv("FAKE_LEDGER", (folder / "ledger").c_str(), 1);
  }

  ForwardRequest request(double act, const std::string &test = "fake") const {
    return {test, {{"act", act}}, 0};
  }

  std::vector<ForwardOutcome> run(const std::vector<double> &acts) {
    std::vector<ForwardRequest> requests;
    for (const double act : acts) requests.push_back(request(act));
    EngineForwardModel model(study, settings);
    return model.run(requests, nullptr);
  }

  // How often each key was started or ended well: word is "start" or "end".
  std::map<std::string, int> ledger(const std::string &word) const {
    std::map<std::string, int> counts;
    if (!std::filesystem::exists(folder / "ledger")) return counts;
    std::istringstream lines(read_text_file(folder / "ledger"));
    for (std::string what, key; lines >> what >> key;)
      if (what == word) ++counts[key];
    return counts;
  }
  int total(const std::string &word) const {
    int sum = 0;
    for (const auto &[key, count] : ledger(word)) sum += count;
    return sum;
  }

  std::filesystem::path testdata;
  TestFolder folder;
  Study study;
  ForwardSettings settings;
};

}  // namespace bondlab
