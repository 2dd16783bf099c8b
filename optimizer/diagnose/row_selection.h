// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a prober of some rows of another one: a data set that lacks rows, a test that is held out.
// Method: rows are picked by index. Units: as the other's. Failure: as the other's.
#pragma once

#include <vector>

#include "diagnose/prober.h"

namespace bondlab::diagnose {

inline Eigen::MatrixXd columns_of(const Eigen::MatrixXd &all,
                                  const std::vector<Eigen::Index> &rows) {
  Eigen::MatrixXd out(all.rows(), static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    out.col(static_cast<Eigen::Index>(i)) = all.col(rows[i]);
  return out;
}

class RowSelection : public Prober {
 public:
  // `whole` must outlive the selection.
  RowSelection(Prober &whole, std::vector<Eigen::Index> rows)
      : whole_(whole), rows_(std::move(rows)) {}
  RowSelection(std::unique_ptr<Prober> whole, std::vector<Eigen::Index> rows)
      : owned_(std::move(whole)), whole_(*owned_), rows_(std::move(rows)) {}

  std::size_t parameters() const override { return whole_.parameters(); }
  std::size_t effects() const override { return whole_.effects(); }
  double parameter_step(std::size_t parameter) const override {
    return whole_.parameter_step(parameter);
  }
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override {
    std::vector<Eigen::VectorXd> out;
    for (const auto &all : whole_.probe(batch)) out.push_back(of(all));
    return out;
  }
  Eigen::MatrixXd uncertainty(const ModelPoint &point) override {
    const Eigen::MatrixXd all = whole_.uncertainty(point);
    if (all.size() == 0) return all;
    return columns_of(columns_of(all, rows_).transpose(), rows_);
  }
  std::unique_ptr<Prober> anchored(const ModelPoint &point, Anchoring how) override {
    auto all = whole_.anchored(point, how);
    return all ? std::make_unique<RowSelection>(std::move(all), rows_) : nullptr;
  }
  Eigen::VectorXd of(const Eigen::VectorXd &all) const {
    return columns_of(all.transpose(), rows_).transpose();
  }

 private:
  std::unique_ptr<Prober> owned_;
  Prober &whole_;
  std::vector<Eigen::Index> rows_;
};

}  // namespace bondlab::diagnose
