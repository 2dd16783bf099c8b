// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: do strengths scatter from specimen to specimen as they do from packing to packing? The block
//   "scatter" of a diagnosis.
// Method: the specimens' variance of a strength over that of the packings at the centre of the
//   model and the sensors (sensor_noise.h), pooled over the series of a kind of test by degrees of
//   freedom, and over all. The null is had by drawing specimens and packings anew from the packings
//   themselves, because brittle strengths have tails that no F table knows, the shape of all series
//   together; p is two-sided, that of the most unlikely block is counted among the most unlikely of
//   each draw.
// Why beside the other blocks and not among them: it judges the noise that those are whitened with.
//   Ten series of four specimens tell a factor of 1.5 in the standard deviation, not less, so it is
//   said, and names nothing.
// Units: none. Failure: series of targets or of one specimen tell nothing; no block without any.
// Source: a bootstrap of variance ratios, Boos & Brownie, Technometrics 31 (1989) 69; the least of
//   several p values, Westfall & Young, Resampling-Based Multiple Testing (1993), ch. 2.
#pragma once

#include "diagnose/study_evidence.h"

namespace bondlab::diagnose {

struct ScatterBlock {
  std::string name;  // "uniaxial_compression, scatter"
  double ratio = 1;  // of variances, specimens over packings
  double p = 1;      // two-sided, of this block alone
};

struct ScatterTest {
  std::vector<ScatterBlock> blocks;
  double p = 1;  // of the most unlikely of them
  // The most unlikely block; null without any.
  const ScatterBlock *worst() const;
};

// `by_packing`: packings x rows of all series; NaN where a packing has no strength.
ScatterTest scatter_test(const Study &study, const std::vector<MeasuredSeries> &series,
                         const Eigen::MatrixXd &by_packing, std::uint64_t seed);

}  // namespace bondlab::diagnose
