// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how well each effect's trace, off what the parameters can do, explains a residual, alone and
//   in pairs; and which traces can't be told apart.
// Method: score (Lagrange multiplier) test. s = trace off the Jacobian's span, e = residual:
//   t = s.e / |s| is normal with sd 1 if the effect is absent, t / |s| estimates its amplitude, t^2
//   is the gain in chi squared. An effect that can have one sign only gets 0 for the other; an
//   amplitude beyond its largest admissible size is cut there, with the gain that is left. Pairs
//   are solved from the Gram matrix of the unit traces, so that all of them cost nothing. Two
//   conversion errors make no pair: a free factor a test fits any strength that differs between
//   tests, which is a finding and no cause. Isolability: cos of the angle between two such traces;
//   two effects of cos c and size lambda (in noise units) differ by lambda^2 (1 - c^2) in chi
//   squared on average, with sd 2 lambda sqrt(1 - c^2): hence the chance that they cannot be told
//   apart, before any data.
// Source: Rao 1948; Saris, Satorra & van der Veld 2009 (expected parameter change).
// Units: none. Failure: an effect whose trace is within 1e-3 of what the parameters can do is
//   `hidden`: no data of these tests can show it.
#pragma once

#include <vector>

#include "diagnose/projection.h"
#include "diagnose/refit.h"

namespace bondlab::diagnose {

constexpr double margin_needed = 6.63;  // chi squared, one degree of freedom, 1 %

struct Score {
  std::size_t effect = 0;
  double t = 0;          // signed
  double amplitude = 0;  // admissible
  double gain = 0;       // in chi squared, at the admissible amplitude
};

struct PairScore {
  std::size_t first = 0, second = 0;
  double gain = 0;
};

class ScoreTable {
 public:
  ScoreTable(const Projection &fitted, const Linearisation &model,
             const std::vector<EffectEntry> &catalogue);

  std::vector<Score> scores(const Eigen::VectorXd &residual) const;  // best gain first
  std::vector<Score> scores_of(const Eigen::VectorXd &t) const;      // t: one an effect
  std::vector<PairScore> pairs(const Eigen::VectorXd &residual) const;
  double largest(const Eigen::VectorXd &residual) const;  // sqrt of the best gain
  double norm(std::size_t effect) const { return norm_(static_cast<Eigen::Index>(effect)); }
  bool hidden(std::size_t effect) const { return hidden_[effect]; }
  const Eigen::MatrixXd &cosines() const { return cosines_; }
  const Eigen::MatrixXd &unit() const { return unit_; }

 private:
  const std::vector<EffectEntry> &catalogue_;
  Eigen::MatrixXd unit_;     // rows x effects
  Eigen::VectorXd norm_;     // of the projected traces
  Eigen::MatrixXd cosines_;  // effects x effects
  std::vector<bool> hidden_;
};

// Chance that the rival's chi squared is within margin_needed of the right effect's.
double confusion_chance(double cosine, double lambda);

}  // namespace bondlab::diagnose
