// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the model made linear at a point (Jacobian and traces of all effects), and fits of the
//   parameters with some effects switched on.
// Method: linearise() asks for everything in one batch: central differences would double the
//   batch, and the fit that follows is judged by the model itself, so forward differences do.
//   refit() is Gauss-Newton with the Jacobian it is given, re-linearised at the point reached,
//   until the gain that is still promised is below 0.01 in chi squared. A step that makes things
//   worse is halved; a slight damping keeps parameters that the rows hardly see from running away,
//   and gives them an sd of 1 in z. An amplitude that leaves its admissible range is put on the
//   bound and stays there.
// Units: standardised rows, z, amplitudes. Failure: a point with NaN ends a refit with ok = false;
//   in a linearisation the effect's column is zero and `dead` tells it.
#pragma once

#include <vector>

#include "diagnose/catalogue.h"
#include "diagnose/prober.h"
#include "diagnose/whitening.h"

namespace bondlab::diagnose {

struct Linearisation {
  ModelPoint point;
  Eigen::VectorXd residual;  // whitened, measured - simulated
  Eigen::MatrixXd jacobian;  // d simulated / d z
  Eigen::MatrixXd traces;    // d simulated / d amplitude
  std::vector<bool> dead;    // effects whose run failed
};

// Model points of linearise(), in order: the point, each parameter, each of `effects`.
Linearisation linearise(Prober &prober, const Whitening &whitening, const ModelPoint &point,
                        bool with_traces = true);

struct Refit {
  bool ok = false;
  ModelPoint point;
  std::vector<std::size_t> effects;  // switched on
  std::vector<bool> at_bound;        // one an effect in `effects`
  std::vector<double> pull;          // how far beyond the bound the rows ask for, in sd; 0 off it
  double chi2 = 0;
  double deviance = 0;  // chi2 plus the log determinant of the rows' covariance
  Eigen::VectorXd residual;
  Eigen::MatrixXd columns;     // Jacobian and the traces of `effects` at the point
  Eigen::MatrixXd covariance;  // of z and amplitudes; bounds ignored
  // No amplitude on a bound, or on one other than 0 that chance may have pushed it over: a size
  // near the largest that is possible comes out above it in every second specimen set.
  bool admissible() const;
};

// Whitened columns at a point: the Jacobian, then the slopes along the amplitudes of `effects`.
Eigen::MatrixXd fit_columns(Prober &prober, const Whitening &whitening, const ModelPoint &point,
                            const std::vector<std::size_t> &effects);

// What keeps p parameters and q amplitudes from running away, one over its reach, in their units.
Eigen::VectorXd refit_damping(Eigen::Index p, Eigen::Index q);

// Adds a step of z and the amplitudes of `effects`; an amplitude stays within its bounds, which
// `at_bound` then tells.
void move_point(ModelPoint &point, const Eigen::VectorXd &step,
                const std::vector<std::size_t> &effects, const std::vector<EffectEntry> &catalogue,
                std::vector<bool> &at_bound);

// Fits z and the amplitudes of `effects`, from `start`. `columns` are those at the start, Jacobian
// first; `on` limits the rows used (empty: all; else weights 0 or 1 a row, for held-out tests).
Refit refit(Prober &prober, const Whitening &whitening, const std::vector<EffectEntry> &catalogue,
            const Linearisation &start, const std::vector<std::size_t> &effects,
            const Eigen::VectorXd &on = Eigen::VectorXd());

}  // namespace bondlab::diagnose
