// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what a study's laboratory measured, as rows, and the evidence made of it together with the
//   simulation's own scatter.
// Method: a data folder's replicates give rows by the code that takes them from simulated curves; a
//   row that any replicate lacks is left out. Without a folder the study's targets are the rows:
//   their logarithms, with the sd stated. Specimens are taken to scatter as the simulation's
//   packings do at the fitted point (measured) and as their sensors do (sensor_noise.h), and
//   besides by what the replicates of a quantity scatter more in all its series (covariance.h), and
//   at least 0.1 %, which no instrument is better than; the mean over P packings has a P-th of the
//   packings' covariance.
// Units: SI in; rows have none. Failure: UserError when nothing of the data can be compared.
// Limits: an excess of one series alone is seen only as far as its own few specimens show it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnose/forward_prober.h"
#include "diagnose/whitening.h"

namespace bondlab::diagnose {

constexpr double instrument_sd = 1e-3;  // of a row: no laboratory is better, one specimen

struct MeasuredSeries {
  ProbedSeries probed;
  std::map<std::string, double> conditions;
  Eigen::MatrixXd replicates;  // specimens x quantities
  Eigen::MatrixXd stated;      // of one specimen; empty: as the packings scatter
  Eigen::VectorXd sensors;     // variance that they make of one specimen's rows; empty: none seen
  std::vector<Curve> curves;   // for the page; empty for targets
};

// Rows that some replicate lacks are left out; `whole`: kept, as NaN, so that a model can be made
// for many data sets of one plan.
std::vector<MeasuredSeries> measured_series(const Study &study, bool whole = false);

// Leaves in only what `model` (the series of a prober) has as well; which of the prober's rows they
// are, in order.
std::vector<Eigen::Index> keep_modelled(std::vector<MeasuredSeries> &series,
                                        const std::vector<ProbedSeries> &model);

// "SERIES, QUANTITY" of what was measured and `model` lacks.
std::vector<std::string> not_modelled(const std::vector<MeasuredSeries> &series,
                                      const std::vector<ProbedSeries> &model);

// "TARGET, cohesion of envelope NAME" of the targets that no row of a single test can hold; none
// when curves were measured instead of targets.
std::vector<std::string> targets_of_envelopes(const Study &study);

// Leaves out quantities whose simulated rows (packings x rows) do not scatter, or that more than this
// share of the packings lacks (a specimen without a peak).
std::vector<ProbedSeries> that_scatter(std::vector<ProbedSeries> series,
                                       const Eigen::MatrixXd &by_packing, double may_lack = 0);

std::vector<ProbedSeries> probed(const std::vector<MeasuredSeries> &series);

// `by_packing` (packings x rows of all series) is what the simulation's mean is over.
Evidence evidence_of(const Study &study, const std::vector<MeasuredSeries> &series,
                     const Eigen::MatrixXd &by_packing);

// The same before any data: nothing but the plan.
Evidence without_data(Evidence evidence);

}  // namespace bondlab::diagnose
