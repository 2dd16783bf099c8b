// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: hidden-effect laboratories out of the closed-form rheology: a prober for the diagnosis, and
//   evidence in which an effect is hidden.
// Method: a laboratory picks some of rheology's series. Its specimens differ in stiffness,
// strength,
//   post-peak and seating; load and strain carry sensor noise, point by point; rows are taken from
//   the noisy curve by the code that takes them from the model's. The model's own curve is that of
//   a few packings, which differ like specimens do and are the same in every run (common random
//   numbers), so that the model carries an error of its own that no refit sees. Stated covariances
//   are drawn from the same scatter at the nominal material, times what the statement is wrong by.
// Units: SI; rows are logarithms or shares. Failure: none. Limits: see rheology/laboratory.h.
#pragma once

#include <cstdint>
#include <vector>

#include "diagnose/catalogue.h"
#include "diagnose/prober.h"
#include "diagnose/whitening.h"
#include "rheology/laboratory.h"

namespace bondlab::diagnose {

struct BenchScatter {  // sd of what differs between specimens, and of the sensors
  double stiffness = 0.03, strength = 0.05, post = 0.08;
  double seating = 2e-5;                              // strain
  double load = 0.002, strain = 0.004, hold = 0.002;  // shares
};

struct BenchTruth {
  rheology::Material material;
  rheology::Effects effects;
};

// The catalogue of the rheology's effects, in the order of rheology::Effect.
const std::vector<EffectEntry> &bench_catalogue();
const std::vector<std::string> &bench_parameters();

// A rock whose base parameters are some 10 % off the nominal ones.
rheology::Material bench_rock(std::uint64_t seed);

class BenchLaboratory : public Prober {
 public:
  BenchLaboratory(std::vector<rheology::Series> series, int replicates,
                  const rheology::Material &rock, std::uint64_t seed);

  std::size_t parameters() const override { return rheology::base_count; }
  std::size_t effects() const override { return rheology::catalogue_count; }
  double parameter_step(std::size_t) const override { return 0.02; }
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override;

  // Another draw of the packings that the model is run on.
  void take_packings(std::uint64_t seed);

  // Rows of the model's mean (no scatter of packings), with any effect, catalogued or not.
  Eigen::VectorXd exact(const BenchTruth &truth) const;

  // Measured data of a truth: other specimens than the model's packings. A series' data depend on
  // the seed and its place in the campaign only, so that a laboratory with a further test has the
  // same data in the others.
  Evidence measure(const BenchTruth &truth, std::uint64_t seed, double stated_over_true = 1) const;

  const rheology::Material &rock() const { return rock_; }
  ModelPoint nominal() const;  // where fits start; not the rock
  BenchTruth truth_at(const ModelPoint &point) const;
  const Evidence &blank() const { return blank_; }  // without replicates
  int replicates() const { return replicates_; }
  int rows() const { return static_cast<int>(blank_.rows.size()); }
  const std::vector<rheology::Series> &series() const { return series_; }

 private:
  Eigen::VectorXd rows_of(const BenchTruth &truth,
                          const std::vector<rheology::Specimen> &specimens) const;
  std::vector<rheology::Series> series_;
  int replicates_;
  rheology::Material rock_;
  Evidence blank_;
  std::vector<rheology::Specimen> packings_;  // one a series
};

}  // namespace bondlab::diagnose
