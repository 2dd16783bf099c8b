// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the one interface of the diagnosis to a model: a batch of model points in, a batch of row
//   vectors out.
// Method: a model point is the fitted parameters in transformed space and the amplitude of every
//   candidate effect, in units of the effect's switch-on size; amplitude 0 is a model without it.
//   The rows are the same figures as are taken from the measured curves, by the same code. Base
//   curves, Jacobian columns and traces of a whole catalogue are one batch, so that an expensive
//   engine runs them side by side.
// Units: rows as the prober defines them, z and amplitudes without. Failure: a point whose runs
//   failed gives rows with NaN; what concerns the whole batch is thrown as by ForwardModel::run().
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <vector>

#include "diagnose/row_key.h"

namespace bondlab::diagnose {

struct ModelPoint {
  Eigen::VectorXd z;          // fitted parameters, transformed
  Eigen::VectorXd amplitude;  // one an effect, in switch-on sizes
};

// How many runs a model is made right at a point with: to see whether it is worth more, or to
// judge.
enum class Anchoring { rough, whole };

class Prober {
 public:
  virtual ~Prober() = default;
  virtual std::size_t parameters() const = 0;
  virtual std::size_t effects() const = 0;
  virtual double parameter_step(std::size_t parameter) const = 0;  // in z, of the differences
  virtual std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) = 0;
  // Covariance (rows x rows, not whitened) of what the prober does not know of its own rows at a
  // point, over and above the scatter that the evidence states. Empty: none, the model is exact.
  virtual Eigen::MatrixXd uncertainty(const ModelPoint &) { return {}; }
  // The same model made right at this point, whatever that costs; it lives no longer than this one.
  // Null: this one is as right as can be had there.
  virtual std::unique_ptr<Prober> anchored(const ModelPoint &, Anchoring) { return nullptr; }
};

}  // namespace bondlab::diagnose
