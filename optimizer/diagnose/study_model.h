// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a study's forward model as the diagnosis uses it: its catalogue, the expanded study, the
//   engine's prober and an emulator of it about a centre.
// Method: start() emulates the parameters about the study's start; move_to() does so elsewhere;
//   add_effects() makes the whole design at the centre. One StudyModel serves many data sets of one
//   plan. Runs that were made before are not made again.
// Units: as ForwardProber. Failure: UserError for a study without parameters.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "diagnose/emulated_prober.h"

namespace bondlab::diagnose {

// Makes the model of the expanded study (with_word_tests).
using ModelFactory = std::function<std::unique_ptr<ForwardModel>(const Study &)>;

class StudyModel {
 public:
  // `study` must outlive the model.
  StudyModel(const Study &study, const std::vector<EffectDefinition> &all,
             const ModelFactory &factory, EmulatorPlan plan,
             std::function<void(const BatchProgress &)> progress = {});
  StudyModel(const StudyModel &) = delete;
  StudyModel &operator=(const StudyModel &) = delete;

  // Rows of `series` that no packing lacks and that scatter over packings are kept.
  void start(const std::vector<ProbedSeries> &series);
  void move_to(const ModelPoint &centre);
  void add_effects();
  // Takes effects at other sizes: switch-on size by effect.
  void rescale(const std::map<std::size_t, double> &switch_on);

  // Effects that `whose` says stay known to the prober, but no diagnosis may name them; those
  // forbidden before may be named again.
  void forbid(const std::function<bool(const std::string &)> &whose);

  // A prober of one test of the study with all rows that its curves give and that scatter over
  // packings; null when there is none. The catalogue's switch-on sizes are those of now.
  std::unique_ptr<ForwardProber> engine_of(const std::string &test, int packings);

  const Study &study() const { return study_; }
  const std::vector<EffectDefinition> &effects() const { return effects_; }
  const std::vector<EffectEntry> &catalogue() const { return catalogue_; }
  std::string steps_line() const;  // for a person
  std::vector<std::string> parameter_names() const;
  ForwardProber &engine() { return *engine_; }
  EmulatedProber &emulated() { return *emulated_; }
  int runs() const { return earlier_runs_ + (engine_ ? engine_->runs() : 0); }

 private:
  const Study &study_;
  std::vector<EffectDefinition> effects_;
  std::vector<EffectEntry> catalogue_;
  std::vector<EffectEntry> as_read_;
  Study expanded_;
  std::unique_ptr<ForwardModel> forward_;
  EmulatorPlan plan_;
  std::function<void(const BatchProgress &)> progress_;
  std::unique_ptr<ForwardProber> engine_;
  std::unique_ptr<EmulatedProber> emulated_;
  int earlier_runs_ = 0;
};

}  // namespace bondlab::diagnose
