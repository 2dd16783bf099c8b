// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/anchored_prober.h"

#include "diagnose/covariance.h"

namespace bondlab::diagnose {

AnchoredProber::AnchoredProber(EmulatedProber &whole, ModelPoint anchor,
                               std::vector<Eigen::Index> packings, Eigen::MatrixXd change)
    : whole_(whole),
      anchor_(std::move(anchor)),
      packings_(std::move(packings)),
      change_(std::move(change)) {
  const auto rows = whole_.probe({whole_.centre(), anchor_});
  shift_ = rows[0] + Eigen::VectorXd(change_.colwise().mean().transpose()) - rows[1];
}

Eigen::MatrixXd AnchoredProber::emulated(const ModelPoint &point) const {
  const Eigen::MatrixXd all = whole_.changes(point);
  Eigen::MatrixXd out(change_.rows(), change_.cols());
  for (std::size_t i = 0; i < packings_.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = all.row(packings_[i]);
  return out;
}

std::vector<Eigen::VectorXd> AnchoredProber::probe(const std::vector<ModelPoint> &batch) {
  auto out = whole_.probe(batch);
  for (auto &rows : out) rows += shift_;
  return out;
}

Eigen::MatrixXd AnchoredProber::uncertainty(const ModelPoint &point) {
  const auto packings = static_cast<double>(change_.rows());
  return whole_.covariance_of(change_ + emulated(point) - emulated(anchor_),
                              widening(packings) / packings);
}

}  // namespace bondlab::diagnose
