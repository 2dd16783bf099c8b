// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: is it the parameters or the model? From measured rows and a model that can be probed to a
//   verdict: one effect, a set that these data can't separate, two effects, not in the catalogue,
//   nothing missing.
// Method: refit the parameters -> omnibus and score tests against their null (null_table.h) ->
//   nothing, unless one of them is passed. The best effects by score are confirmed by true refits
//   of the model with the effect on (a trace is a tangent, an effect of ten noise units is not
//   small); near the best of them the model is made right (Prober::anchored) and they are fitted
//   again. The best is named alone if nothing is left (omnibus within its null) and no second
//   effect is asked for; all admissible effects whose refit is within 6.63 in chi squared stand
//   beside it, as does every effect that wins in more than a fifth of parametric resamples. Else
//   pairs: all by score, the best by refit, and a pair is named if nothing is left, if either
//   member alone loses more than the threshold of a single effect, and with the same margin to the
//   next pair. Else it is not in the catalogue.
//   Explanations are compared by deviance, chi squared plus the log determinant of the rows'
//   covariance, which is chi squared alone where the model is exact.
// Why the order: a single cause is tried before two, and what the catalogue cannot explain is said
//   rather than given the nearest name.
// Units: standardised rows; sizes in the effects' own units. Failure: a base refit that fails is a
//   UserError. Limits: parameters' intervals are linear at the refit point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/null_table.h"
#include "diagnose/score.h"

namespace bondlab::diagnose {

enum class Verdict { one, set, two, not_in_catalogue, nothing };
std::string to_string(Verdict verdict);

struct NamedEffect {
  std::size_t effect = 0;
  double size = 0, low = 0, high = 0;  // 95 % interval
  double gain = 0;                     // in chi squared, realised by the refit (of the pair: of it)
  double p = 1;                        // chance of such a score anywhere in the catalogue
  double margin =
      0;  // chi squared of the best rival less its own (one, two); of it to the best (set)
};

struct Spot {
  std::string name;
  double score = 0;
};

// What the refits tried, and how far each was behind the best in deviance.
struct Tried {
  std::vector<std::size_t> effects;
  std::vector<double> amplitudes;
  double behind = 0;
};

struct Diagnosis {
  Verdict verdict = Verdict::nothing;
  std::vector<NamedEffect> effects;
  double margin = 0;       // to the best rival that is not named, in chi squared
  double false_alarm = 0;  // rate the alarm is set to
  double p_omnibus = 1, p_trace = 1;
  // Largest score of the whole, its blocks and drifts, and of a trace; what an alarm takes.
  double omnibus = 0, omnibus_alarm = 0, trace = 0, trace_alarm = 0;
  std::vector<Spot> where;    // blocks and drifts beyond the null, largest first, before
  std::vector<Spot> remains;  // the same after the best that the catalogue can do
  double stability = 1;       // share of resamples with the same effect on top
  double predicted_gain = 0, realised_gain = 0;
  std::vector<double> smallest_size;  // one an effect: seen with 90 %; infinite when hidden
  Refit before, after;                // `after` as `before` when nothing is named
  std::optional<ModelPoint> anchor;   // where the model was made right for `after`
  std::vector<Tried> tried;
  NoiseEstimate noise;
  Linearisation model;  // at the base refit, for isolability and advice
};

struct DiagnoseOptions {
  std::size_t confirmed = 5;        // single effects refitted
  std::size_t confirmed_pairs = 6;  // pairs refitted
  std::size_t checked = 3;          // of them, those that the model is made right for
  std::size_t checked_pairs = 2;
  double worth_refitting = 30;  // chi squared behind the best by score
  std::uint64_t seed = 1;
};

// What is the same for all data sets of one study.
struct DiagnosisSetup {
  const std::vector<EffectEntry> &catalogue;
  const std::vector<std::string> &parameters;
  const NullTable &null;
};

Diagnosis diagnose(Prober &prober, const Evidence &evidence, const DiagnosisSetup &setup,
                   const ModelPoint &start, const DiagnoseOptions &options = {});

// The best fit of the parameters alone, and the model about it.
Linearisation fit_base(Prober &prober, const Whitening &whitening,
                       const std::vector<EffectEntry> &catalogue, const ModelPoint &start,
                       Refit &base);

// The same, and `whitening` made to hold what the prober does not know of its rows there.
Linearisation fit_base(Prober &prober, const Evidence &evidence,
                       const std::vector<EffectEntry> &catalogue, const ModelPoint &start,
                       Refit &base, Whitening &whitening);

}  // namespace bondlab::diagnose
