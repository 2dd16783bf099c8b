// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: is anything left in a residual, and where: one standard score for the whole, for every block
//   and for every drift of a fitted parameter.
// Method: three families of statistics over the residual e off the span of what was fitted.
//   Whole and blocks (series x part, test x part, series, test, part, all): e^2 summed, made a
//   standard normal score by matching mean and variance of the quadratic form to a scaled chi
//   squared and taking its cube root (Satterthwaite; Wilson & Hilferty).
//   Drifts: the direction "parameter j differs in this series, this test or at this level of this
//   condition" is the Jacobian's column cut down to those rows, or weighted with the rank of the
//   condition for "drifts with it"; or one quantity of a test is off in all its series alike,
//   or with the rank of a condition. The score is e along the direction. A modulus
//   that changes with the loading rate is a missing effect in disguise, and a model error that
//   spreads thinly over a hundred rows, which no sum of squares sees, is seen along a direction.
//   The largest score of all is the statistic; its null is had by drawing (null_table.h).
// Source: Saris, Satorra & van der Veld, Struct. Equ. Modeling 16 (2009), for directed tests.
// Units: none. Failure: none; directions that the fit explains (norm below 3 % left) are left out.
#pragma once

#include <string>
#include <vector>

#include "diagnose/projection.h"
#include "diagnose/whitening.h"

namespace bondlab::diagnose {

struct Block {
  std::string name;  // "uc_slow_293K, peak", "brazilian", "whole"
  std::vector<int> rows;
};

struct Drift {
  std::string parameter;  // or quantity
  std::string over;       // "rate 1e-05", "test brazilian", "series uc_short"
};

struct OmnibusScore {
  double score = 0;   // standard normal when alone
  bool block = true;  // else a drift
  std::size_t index = 0;
};

class Omnibus {
 public:
  // `jacobian` is whitened; parameters are named for the drifts.
  Omnibus(const Evidence &evidence, const Whitening &whitening,
          const std::vector<std::string> &parameters, const Eigen::MatrixXd &jacobian);

  // The scores of residuals off what `fitted` spans; the residuals given must be off it.
  class Prepared {
   public:
    Prepared(const Omnibus &omnibus, const Projection &fitted);
    OmnibusScore largest(const Eigen::VectorXd &residual) const;
    std::vector<double> block_scores(const Eigen::VectorXd &residual) const;
    Eigen::VectorXd drift_scores(const Eigen::VectorXd &residual) const;

   private:
    const Omnibus &omnibus_;
    Eigen::VectorXd rescale_;         // 1 / what is left of a direction; 0: too little
    std::vector<double> mean_, dof_;  // of the blocks' scaled chi squared
  };

  const std::vector<Block> &blocks() const { return blocks_; }
  const std::vector<Drift> &drifts() const { return drifts_; }

 private:
  std::vector<Block> blocks_;
  std::vector<Drift> drifts_;
  Eigen::MatrixXd directions_;
};

}  // namespace bondlab::diagnose
