// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: covariances of rows from few samples, and how much more specimens scatter than packings.
// Method: the sample covariance with its correlations drawn towards zero by as much as they are
//   noise: lambda = sum (1 - r^2)^2 / dof over sum r^2 (off the diagonal), at least
//   p / (p + 10 dof), so that it can be inverted. Strong correlations that many samples carry are
//   kept, which matters: rows of one curve go together, and a row that is wrongly taken for
//   independent counts twice.
//   Specimens have all the scatter that packings have, and sensors besides. Their excess, variance
//   over variance, is taken to be the same for one quantity of one kind of test in all its series;
//   its logarithm is drawn towards that of all quantities together by what chance allows (an
//   empirical Bayes estimate, normal with sd 0.5 before the data, or with what lies beyond chance
//   where that is more), and is never below none; what stays unknown of it is added, so that a row
//   whose noise few specimens tell counts for less. The excess is independent from row to row. A
//   row whose own specimens scatter more still than chance allows is given what they show.
// Source: Schaefer & Strimmer, Stat. Appl. Genet. Mol. Biol. 4 (2005) 32, eq. 10 (target D).
// Units: squared units of the rows. Failure: one sample has covariance zero.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace bondlab::diagnose {

// Of samples x rows, each about the mean of its column.
Eigen::MatrixXd shrunk_covariance(const Eigen::MatrixXd &sample);

// The same of deviations that have been taken off their means; `dof` of them are independent.
Eigen::MatrixXd shrunk_covariance_of(const Eigen::MatrixXd &deviations, double dof);

// What the variance of a mean of so many samples is widened by, as Student's.
double widening(double samples);

// Variances over samples, one a column.
Eigen::VectorXd variances(const Eigen::MatrixXd &sample);

// Specimens' variance over packings' of one quantity, pooled over series.
struct ExcessTally {
  double sum = 0, dof = 0;  // of ratios times dof; dof of the specimens
  void add(double specimens, double packings, double specimens_dof, double packings_dof);
};

// One a tally, at least 1.
std::vector<double> excess_scatter(const std::vector<ExcessTally> &tallies);

// Of one specimen, from packings and specimens (samples x rows) and the rows' excess.
Eigen::MatrixXd specimen_covariance(const Eigen::MatrixXd &packings,
                                    const Eigen::MatrixXd &specimens,
                                    const Eigen::VectorXd &excess);

}  // namespace bondlab::diagnose
