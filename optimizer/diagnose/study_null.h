// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: draws of data in which nothing is missing, for a study whose scatter is itself an estimate.
// Method: a draw is as many packings and specimens as there are, normal with the covariances found,
//   and the model's own doubt at the fitted point; from them the covariance is estimated anew by
//   the code that made the evidence, and residual, Jacobian and traces are whitened with that. So a
//   covariance from a score of samples, which is wrong by a fifth in every row, alarms no more often
//   than it should.
// Units: none. Failure: none.
// Limits: normal scatter; targets with a stated sd are taken to have exactly that.
#pragma once

#include "diagnose/null_table.h"
#include "diagnose/study_evidence.h"

namespace bondlab::diagnose {

struct NullModel {
  const Study &study;
  const std::vector<MeasuredSeries> &series;
  const Eigen::MatrixXd &by_packing;  // packings x rows of `series`
  const Evidence &evidence;           // made of these
  Eigen::MatrixXd doubt;              // Prober::uncertainty() at the fitted point
  Eigen::MatrixXd jacobian, traces;   // not whitened
};

// What `model` refers to must outlive the source.
NullSource study_null(NullModel model);

}  // namespace bondlab::diagnose
