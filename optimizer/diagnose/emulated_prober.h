// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a Prober that knows how well it knows: polynomials over forward runs about one point.
// Method: at the centre the rows are the mean over many packings. About it every fitted parameter
//   is stepped up and down on some of these packings, as far as their noise asks for
//   (parameter_step.h), and every effect switched on at two sizes, on fewer (common random numbers:
//   a packing is compared with itself). Every fit needs the parameters' changes and few
//   effects; the packings that an effect lacks stand at its mean, with its scatter widened so that
//   the covariance of the mean stays what it is. The change along one coordinate is x L + x^2 Q a
//   row and packing, Q only where its mean over the packings is beyond 2.5 of its standard errors;
//   changes along different coordinates add, which rows that are logarithms and shares nearly do. A
//   straight row's mean m with standard error s is taken as m max(0, 1 - w s^2 / m^2), w the
//   widening below: a row that does not change keeps no noise, one that does is kept. uncertainty()
//   is the covariance of the whole change over the packings, over their number: it is zero at the
//   centre and grows with what is asked. x of a parameter is the logarithm of its physical value
//   over the centre's (the share of its range where it may be zero or negative), because stiffness
//   and strength scale as powers and z bends near its bounds. An effect that can have either sign
//   has a slope of its own below zero.
// Why: a brittle specimen breaks along another path after any change, so that one run's difference
//   is noise; here noise is averaged, and what is left of it is known to the scores. A probe costs
//   no run, so that one design serves many data sets and thousands of resamples.
// Source: response surfaces with common random numbers, Kleijnen, Design and Analysis of Simulation
//   Experiments (2015), ch. 2; the variance of few packings is widened by (P-1)/(P-3) as Student's;
//   shrinking a mean towards zero: Efron & Morris, J. Am. Stat. Assoc. 70 (1975) 311.
// Units: as ForwardProber. Failure: a row that fewer than three packings have at a knot is not
//   changed by that coordinate and is given three times the packings' own scatter; a packing that
//   lacks a row at the centre stands at the others' mean there and tells nothing of changes; an
//   effect with no row left, or that the plan leaves out, is dead (NaN rows).
// Limits: beyond its knots a coordinate goes on straight. Effects and parameters do not interact.
#pragma once

#include <vector>

#include "diagnose/coordinate_way.h"
#include "diagnose/forward_prober.h"

namespace bondlab::diagnose {

struct EmulatorPlan {
  int centre = 16;                 // packings of the centre's mean
  int differences = 6;             // of them, those that effects are switched on on; at least 4
  double pilot = 0.12;             // step of parameters, in x, whose noise tells the steps to take
  std::vector<double> steps = {};  // of parameters, in x; empty: from that noise
  int parameters = 16;  // packings that parameters are stepped on, no fewer than `differences`
  int anchors = 16;     // packings that the engine is run on where a fit is checked, at most;
                        // fewer where they would be more than a hundred runs
  std::vector<std::size_t> effects = {};  // switched on; empty: all of the catalogue
};

class EmulatedProber : public Prober {
 public:
  // Makes all its runs: centre, pilot, parameters, effects, a batch each. `engine` must outlive the
  // prober.
  EmulatedProber(ForwardProber &engine, const std::vector<EffectEntry> &catalogue,
                 const ModelPoint &centre, const EmulatorPlan &plan, bool with_effects = true);

  std::size_t parameters() const override { return engine_.parameters(); }
  std::size_t effects() const override { return engine_.effects(); }
  double parameter_step(std::size_t parameter) const override;
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override;
  Eigen::MatrixXd uncertainty(const ModelPoint &point) override;

  const ModelPoint &centre() const { return centre_; }
  // Of the parameters, in x: a plan with them needs no pilot.
  const std::vector<double> &steps() const { return steps_; }
  const Eigen::MatrixXd &centre_rows() const { return rows_; }  // packings x rows
  // The change from the centre on each packing alone: packings x rows, nothing shrunk. Their mean
  // is the mean change, and their covariance over their number that of the mean.
  Eigen::MatrixXd changes(const ModelPoint &point) const;
  // The engine's own, on the packings that effects are switched on on. A row that some packings
  // lack is the mean of the others there, and no change where fewer than three have it.
  Eigen::MatrixXd engine_changes(const ModelPoint &point);
  // Covariance of rows from changes (packings x rows), times a factor; series are independent.
  Eigen::MatrixXd covariance_of(const Eigen::MatrixXd &changes, double factor) const;
  // The emulator shifted to the engine's own rows at a point (anchored_prober.h); null when the
  // engine has them on fewer than four packings.
  std::unique_ptr<Prober> anchored(const ModelPoint &point, Anchoring how) override;
  // Whether a fitted point's parameters lie within twice the steps that were made.
  bool covers(const ModelPoint &point) const;
  // The centre moved towards a point, as far as the steps can be trusted.
  ModelPoint towards(const ModelPoint &point) const;
  // The engine itself at these points: the centre's mean and the change on the same packings.
  std::vector<Eigen::VectorXd> confirm(const std::vector<ModelPoint> &points);
  // Makes an effect's runs anew, at the sizes that engine and entry now have.
  void renew(std::size_t effect, const EffectEntry &entry);
  // Whether an amplitude lies within the sizes that were run.
  bool covers(std::size_t effect, double amplitude) const;
  // The same, and not so far below them that a slope between them says nothing of it.
  bool knows(std::size_t effect, double amplitude) const;
  // Standard deviation over the mean change at switch-on, root mean square over the rows that
  // scatter least: how much of an effect's trace is noise.
  double trace_noise(std::size_t effect) const;

 private:
  Way dead_way() const;
  void widen(Way &way) const;  // from the effects' packings to those of the parameters
  Way effect_way(const std::vector<double> &knots,
                 const std::vector<Eigen::MatrixXd> &changes) const;
  Eigen::RowVectorXd noise(const ModelPoint &point) const;  // of the mean change
  std::vector<double> knots_of(const EffectEntry &entry) const;

  ForwardProber &engine_;
  ModelPoint centre_;
  std::vector<int> packings_, effect_packings_;             // of the changes
  std::vector<int> anchor_packings_;                        // among those
  ModelPoint moved(std::size_t parameter, double x) const;  // of the centre; cut at its bounds
  double coordinate(std::size_t parameter, const ModelPoint &point) const;
  // Knots up and down, less than the step at a bound, and the points there.
  std::vector<double> knots_up_and_down(std::size_t parameter, double step,
                                        std::vector<ModelPoint> &points) const;
  std::vector<double> steps_from_noise(const EmulatorPlan &plan);
  std::vector<Eigen::MatrixXd> changes_at(const std::vector<ModelPoint> &points,
                                          const std::vector<int> &packings);
  std::vector<double> steps_;
  Eigen::MatrixXd as_run_,
      rows_;  // of the centre; where a packing lacks a row: NaN, the others' mean
  Eigen::VectorXd mean_, scatter_;  // of the centre: mean, variance over packings
  std::vector<Way> parameters_, effects_;
};

}  // namespace bondlab::diagnose
