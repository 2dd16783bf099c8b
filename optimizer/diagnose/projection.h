// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: take off what a set of columns can explain.
// Method: an orthonormal basis by pivoted Householder QR, once; projecting a vector is then two
//   small products. Columns that add nothing (below 1e-9 of the largest) are left out.
// Units: none. Failure: none; no columns leave everything as it is.
#pragma once

#include <Eigen/Dense>

namespace bondlab::diagnose {

class Projection {
 public:
  explicit Projection(const Eigen::MatrixXd &columns) {
    if (columns.cols() == 0) {
      basis_.resize(columns.rows(), 0);
      return;
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
    qr.setThreshold(1e-9);
    basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
  }
  template <class Derived>
  Eigen::MatrixXd off(const Eigen::MatrixBase<Derived> &columns) const {
    return columns - basis_ * (basis_.transpose() * columns);
  }
  const Eigen::MatrixXd &basis() const { return basis_; }
  int rank() const { return static_cast<int>(basis_.cols()); }

 private:
  Eigen::MatrixXd basis_;
};

}  // namespace bondlab::diagnose
