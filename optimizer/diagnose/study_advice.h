// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the last word on a diagnosis: a name that does not predict is not given alone, and what to
//   measure next.
// Method: a single name becomes a set with every effect that was tried when the series held out
//   lies beyond chance with it (3 sd of a chi squared) and is worse, by 6.63 in chi squared, or was
//   beyond chance already and is no better. A series that the effect does not touch takes no name
//   away. For a set, the tests of the study that were not measured are tried for the one that
//   separates it (further_tests.h); besides, the effects' own words.
// Units: none. Failure: none.
#pragma once

#include "diagnose/study_diagnosis.h"

namespace bondlab::diagnose {

// Nothing is named when series held out in turn (cross_gap.h) are worse with it by 6.63 and beyond
// chance.
void take_back(StudyDiagnosis &out);

void give_not_alone(StudyDiagnosis &out);

void advise_tests(StudyModel &model, const std::vector<MeasuredSeries> &measured,
                  StudyDiagnosis &out);

// The block "scatter" (scatter_block.h), among where something shows when it is beyond the alarm.
void add_scatter(StudyDiagnosis &out);

void advise_on(StudyDiagnosis &out);

}  // namespace bondlab::diagnose
