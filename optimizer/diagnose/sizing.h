// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the size at which an effect reaches a wanted number of noise units, so that it can be hidden.
// Method: noise units are the norm of the mean change of the rows, whitened by what the laboratory's
//   specimens scatter (packings, sensors and the rest, from data with nothing hidden), off what the
//   parameters can do, without what the noise of few packings adds. A first size comes from the
//   emulator, taken at sizes near it. Then the engine is run at it: where its own units
//   are more than a quarter off, the size is corrected along a power law through those that were
//   run, and run again, four times at most; the one that comes nearest stands. So an effect with a
//   threshold (a bond that yields at a stress it never sees) is not hidden where it does nothing.
//   An error of measuring needs no run: its change is that of curves already there.
// Units: sizes SI. Failure: an effect whose largest size gives less is given that size, and the
//   units it has. Limits: the noise of six packings is some two units.
#pragma once

#include <functional>

#include "diagnose/study_evidence.h"
#include "diagnose/study_model.h"

namespace bondlab::diagnose {

struct Sized {
  double size = 0;
  double units = 0;  // by the engine itself
};

// What is measured on so many specimens a series, before it is: specimens scatter as packings do.
Evidence plan_evidence(StudyModel &model, int replicates);

// Sd of specimens over that of packings, one a row of the model, from measurements with nothing
// hidden; 1 for rows that these lack.
Eigen::VectorXd wider_than_packings(StudyModel &model, std::vector<MeasuredSeries> measured);

// The plan with specimens that scatter so much more.
Evidence widened(Evidence plan, const Eigen::VectorXd &wider);

// Takes the effect at other sizes where it must: rescale() the model afterwards.
Sized size_for(StudyModel &model, const Evidence &plan, const EffectDefinition &effect,
               double wanted, double largest);

// Sizes near the one that has the wanted units, from `first` on: at most `most` of them are tried.
Sized search_size(const std::function<double(double)> &units, double first, double wanted,
                  double largest, int most = 4);

}  // namespace bondlab::diagnose
