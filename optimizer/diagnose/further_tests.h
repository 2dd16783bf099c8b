// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: which test of the study, not measured yet, would separate effects that the data cannot.
// Method: tests of the study that no series belongs to are what a laboratory could still do. Each
//   is run at the fitted point and about it, with the rivals switched on, as the diagnosed tests
//   were (emulated_prober.h), taken to be measured on as many specimens as these, and its rows are
//   put under the present ones for advise().
// Units: chi squared. Failure: a test whose runs give no row that scatters is left out.
// Limits: a few packings; one further test at a time.
#pragma once

#include <string>
#include <vector>

#include "diagnose/advice.h"
#include "diagnose/study_evidence.h"
#include "diagnose/study_model.h"

namespace bondlab::diagnose {

// Tests of the study without a series.
std::vector<std::string> tests_not_measured(const Study &study,
                                            const std::vector<MeasuredSeries> &series);

// Best first. `present` is the model about the fit, whitened rows of the data there are.
std::vector<Advice> further_tests(StudyModel &model, const std::vector<std::string> &tests,
                                  int specimens, const Linearisation &present,
                                  const std::vector<std::size_t> &rivals,
                                  const std::vector<double> &amplitudes);

}  // namespace bondlab::diagnose
