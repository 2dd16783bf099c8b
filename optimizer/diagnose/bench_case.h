// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one case of the benchmark on the closed-form laboratory: a rock, hidden effects of a wanted
//   size in noise units, data, and what the diagnosis makes of them.
// Method: eight rocks, each with its covariances and its null table, made once; a case takes one of
//   them, its own packings for the model and its own specimens. The size of an effect is found by
//   bisection so that the whitened change of the rows, off what the parameters can do, has the
//   wanted norm. An effect is left out of the catalogue by allowing it no size.
// Units: sizes in noise units. Failure: assertions. Limits: an effect that cannot reach the wanted
//   size within ten times its admissible range is planted at that bound.
#pragma once

#include <memory>
#include <optional>

#include "diagnose/bench_laboratory.h"
#include "diagnose/diagnose.h"

namespace bondlab::diagnose {

struct BenchSetup {
  BenchLaboratory laboratory;
  Whitening plan;       // as stated, before data
  Linearisation model;  // at the rock, as planned
  NullTable null;
};

struct BenchRun {
  BenchTruth truth;
  std::vector<std::size_t> hidden;
  Evidence evidence;
  Diagnosis diagnosis;
  bool names(std::size_t effect) const;
  bool names_only(std::size_t effect) const;
};

class Bench {
 public:
  explicit Bench(std::vector<rheology::Series> series, int rocks = 8, int replicates = 4,
                 std::uint64_t seed = 1);

  // The size at which `effect` reaches `lambda` noise units in the laboratory of a rock.
  double size_of(std::size_t rock, std::size_t effect, double lambda) const;
  // Noise units that a size reaches.
  double lambda_of(std::size_t rock, std::size_t effect, double size) const;

  struct Wish {
    std::vector<std::size_t> hidden;
    double lambda = 10;
    std::optional<std::size_t> left_out;
    double stated_over_true = 1;
  };
  BenchRun run(const Wish &wish, std::uint64_t number);
  // The same with the truth given; `wish` says what is hidden in it.
  BenchRun run(const Wish &wish, const BenchTruth &truth, std::uint64_t number);

  std::size_t rock_of(std::uint64_t number) const { return number % setups_.size(); }
  BenchSetup &setup(std::size_t rock) { return *setups_[rock]; }
  const BenchSetup &setup(std::size_t rock) const { return *setups_[rock]; }

 private:
  std::vector<std::unique_ptr<BenchSetup>> setups_;
};

// Series of some tests: "uc_mid_293K" or a kind of test; empty: all.
std::vector<rheology::Series> bench_series(const std::vector<std::string> &names);

}  // namespace bondlab::diagnose
