// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a Prober over a study and a forward model: model points become forward runs, their curves
//   become rows.
// Method: a point's parameters set deck variables as in a fit, its effects change them by the rules
//   of their files; rows are means over the same packings at every point (common random numbers),
//   so that differences cancel what packings have in common. All points of a batch, all series and
//   packings are one batch of forward requests, and a request made before is not made again.
//   Words (strength_distribution = "weibull") are not numbers that a request can carry: the
//   expanded study has each test once more for every set of such effects, with the words fixed.
//   A conversion error scales the simulated loads.
// Why steps as they are: the study's difference_step is never below what noise hides
//   (fit options); turned into z at the start it stays the same throughout.
// Units: SI to the decks. Failure: a point whose runs failed, or whose effect asks a deck for a
//   value it refuses, gives NaN rows.
#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "diagnose/catalogue.h"
#include "diagnose/curve_rows.h"
#include "diagnose/prober.h"
#include "forward/forward_model.h"
#include "study/effect_definition.h"
#include "study/parameter_space.h"
#include "study/study.h"

namespace bondlab::diagnose {

// A test of the study with the rows that its data and its curves both give.
struct ProbedSeries {
  std::string name, test;
  std::vector<CurveQuantity> quantities;
};

// Effects that change some deck of the study, or convert some test of it.
std::vector<EffectDefinition> effects_of_study(const Study &study,
                                               const std::vector<EffectDefinition> &all);

// The study with its tests repeated for every set of up to two effects that set words.
Study with_word_tests(const Study &study, const std::vector<EffectDefinition> &effects);

// As catalogue, with admissible sizes cut to what the decks accept.
std::vector<EffectEntry> catalogue_of(const Study &study,
                                      const std::vector<EffectDefinition> &effects);

class ForwardProber : public Prober {
 public:
  // `study` is with_word_tests(); study, effects and model must outlive the prober.
  ForwardProber(const Study &study, const std::vector<EffectDefinition> &effects,
                ForwardModel &model, std::vector<ProbedSeries> series, std::vector<int> packings);

  std::size_t parameters() const override { return space_.n(); }
  std::size_t effects() const override { return effects_.size(); }
  double parameter_step(std::size_t parameter) const override { return steps_[parameter]; }
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override;

  // Makes all runs of these points on these packings as one batch, for by_packing() and curves().
  void prepare(const std::vector<ModelPoint> &points, const std::vector<int> &packings);

  // Rows of each packing alone, packings x rows, at one point; runs that failed have NaN.
  Eigen::MatrixXd by_packing(const ModelPoint &point, const std::vector<int> &packings);
  // Curves of one point on the first packing, one a series.
  std::vector<ForwardOutcome> curves(const ModelPoint &point, int packing);

  // Amplitudes of this effect count in this size from now on.
  void rescale(std::size_t effect, double switch_on) { switch_on_[effect] = switch_on; }

  ModelPoint start() const;
  std::vector<double> physical(const ModelPoint &point) const;
  const ParameterSpace &space() const { return space_; }
  const std::vector<ProbedSeries> &series() const { return series_; }
  const std::vector<int> &packings() const { return packings_; }
  int rows() const { return rows_; }
  int runs() const { return runs_; }
  void set_progress(std::function<void(const BatchProgress &)> progress) {
    progress_ = std::move(progress);
  }

 private:
  struct Wanted {
    ForwardRequest request;
    double load_factor = 1;
    bool allowed = true;
  };
  using Key = std::tuple<std::string, int, std::map<std::string, double>>;
  Wanted wanted(const ModelPoint &point, const ProbedSeries &series, int packing) const;
  Key key(const ForwardRequest &request) const;
  void make(const std::vector<Wanted> &list);
  Eigen::VectorXd rows_on(const ModelPoint &point, int packing) const;

  const Study &study_;
  const std::vector<EffectDefinition> &effects_;
  ForwardModel &model_;
  ParameterSpace space_;
  std::vector<ProbedSeries> series_;
  std::vector<int> packings_;
  std::vector<double> steps_, switch_on_;
  std::map<std::string, std::map<std::string, double>> defaults_;  // by test, SI
  std::map<Key, ForwardOutcome> known_;
  std::function<void(const BatchProgress &)> progress_;
  int rows_ = 0, runs_ = 0;
};

}  // namespace bondlab::diagnose
