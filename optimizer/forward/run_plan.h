// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: everything one forward run consists of, decided before it starts, and the key under which
// its result is kept. Method: a virtual test (deck, its included files, fixed variables), the
// request's variables, the specimen and the packing
//   are put together in canonical form; the key is a hash over all that can change the result:
//   these, the engine's binary and the number of ranks. Time limits and paths aren't in it. The
//   seed is kept beside the key's other part, so that runs of one point on different packings can
//   be found together.
// Units: the command line's numbers are in the deck's units (test.toml), `numeric` is in SI.
// Failure: UserError for a variable the test doesn't declare, a value it doesn't allow, or an
// include that can't be read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "forward/forward_model.h"
#include "study/study.h"

namespace bondlab {

// A packing as a file. The hash is of its bytes.
struct SpecimenFile {
  std::filesystem::path path;
  std::string hash;
};
using SpecimenSource = std::function<SpecimenFile(const SpecimenEntry &, int packing)>;

struct RunKey {
  std::string point;       // everything but the packing
  std::uint64_t seed = 0;  // of the specimen
  std::string full;        // everything: what a result is kept under
};

struct RunPlan {
  std::string test;          // name in the study
  std::string virtual_test;  // name in test.toml
  std::filesystem::path deck;
  std::string deck_hash;                         // of the deck and all it includes
  std::map<std::string, std::string> variables;  // -var NAME TEXT, without the specimen's path
  std::vector<std::string> varied;               // of these, the request's own
  std::map<std::string, double>
      numeric;  // SI; these, the deck's defaults and the specimen's dimensions
  SpecimenEntry specimen;
  SpecimenFile specimen_file;   // set by the forward model
  bool wants_specimen = false;  // the deck has a variable `specimen`
  bool wants_deck_dir = false;  // ... and one `deck_dir`, the folder of the deck
  int packing = 0;
  int ranks = 1;
  double wall_limit = 0;                 // s
  std::string curve, events, particles;  // names in the run's folder
  std::vector<std::string> columns;      // the curve must have
  std::vector<std::string> keep;         // further files to keep after success

  std::uint64_t seed() const { return specimen.seed + static_cast<std::uint64_t>(packing); }
};

RunPlan plan_run(const Study &study, const ForwardRequest &request);

// specimen_file must be set where the deck wants one.
RunKey key_of(const RunPlan &plan, const std::string &engine_hash);

// Runs that take about the same time: equal but for parameters and packing. For estimates.
std::string workload_of(const RunPlan &plan);

// Hash of a deck and the files it includes by `include` or `jump`, with ${deck_dir} standing for
// the deck's folder.
std::string deck_hash(const std::filesystem::path &deck);

}  // namespace bondlab
