// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: measured rows with their scatter, as standardised rows: unit variance, uncorrelated, when
//   nothing but scatter is in them.
// Method: the rows of one series come from the same specimens and are correlated; different series
//   are independent. The covariance of a series' mean is that of one specimen as stated, scaled by
//   what its replicates really scatter, over their number, and the covariance of the simulation's
//   mean over its packings (measured with the seeds, never assumed). The scale is estimated for
//   every kind of test from the replicates' deviations from their mean, whitened as stated, and
//   drawn towards the scale of all tests together where a test has few of them. The symmetric root
//   of the covariance whitens, because of all roots it changes rows least, so that a row keeps the
//   meaning of its name.
//   Scatter also shifts the mean of a figure that bends (a share, a fall after the peak); the shift
//   comes from the same draws as the stated covariance, grows with the variance and is taken off.
//   The scatter itself is a row as well, one a kind of test: the cube root of the pooled variance
//   of the strength over the scaled stated one, which is nearly normal with sd sqrt(2/(9 dof))
//   (Wilson & Hilferty 1931), so that an effect that shows as scatter is not lost.
//   Before any data the stated scatter stands as it is, so that what tests can't tell apart can be
//   said in advance.
// Units: as the rows. Failure: assertions only; a covariance that is not positive definite is
//   lifted by 1e-9 of its largest eigenvalue.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

#include "diagnose/row_key.h"

namespace bondlab::diagnose {

struct SeriesEvidence {
  std::string name, test;
  std::map<std::string, double> conditions;  // rate, temperature, size ...
  int first = 0, count = 0;                  // its rows
  Eigen::MatrixXd replicates;                // replicates x count; empty before the test is made
  int planned = 1;                           // replicates that will be, while it is empty
  Eigen::MatrixXd stated;                    // count x count, of one specimen
  Eigen::VectorXd shift;                     // what this scatter does to the mean; empty: nothing
  Eigen::MatrixXd simulated;                 // count x count, of the simulation's mean
};

struct ScatterEvidence {
  int row = 0;
  double variance = 0;  // pooled over the series of this kind of test
  double dof = 0;
  double stated = 0;  // variance as stated
};

struct Evidence {
  std::vector<RowKey> rows;
  std::vector<SeriesEvidence> series;
  std::vector<ScatterEvidence> scatter;
};

struct NoiseEstimate {
  double scale = 1;  // measured sd over stated sd, all tests
  double dof = 0;
  std::map<std::string, double> by_test;      // used
  std::map<std::string, double> dof_by_test;  // that the scale used rests on
  bool stated_wrong = false;  // scale differs from 1 by more than 10 % and more than chance allows
  std::vector<std::string> notes;
};

class Whitening {
 public:
  // `model`: what the model does not know of its rows (Prober::uncertainty()), added within each
  // series; empty: nothing.
  explicit Whitening(const Evidence &evidence, const Eigen::MatrixXd &model = Eigen::MatrixXd());

  const NoiseEstimate &noise() const { return noise_; }
  const Eigen::VectorXd &measured() const { return measured_; }  // means, not whitened
  // Of the covariance: two explanations that know their rows differently well are compared by
  // chi squared plus this.
  double log_determinant() const { return log_determinant_; }
  int rows() const { return static_cast<int>(measured_.size()); }
  Eigen::VectorXd apply(const Eigen::VectorXd &rows) const;
  // What apply() made of rows, undone.
  Eigen::MatrixXd undo(const Eigen::MatrixXd &whitened) const;
  // W (measured - simulated)
  Eigen::VectorXd residual(const Eigen::VectorXd &simulated) const;

 private:
  struct Block {
    int first, count;
    Eigen::MatrixXd root;
  };
  NoiseEstimate noise_;
  Eigen::VectorXd measured_;
  std::vector<Block> blocks_;
  double log_determinant_ = 0;
};

}  // namespace bondlab::diagnose
