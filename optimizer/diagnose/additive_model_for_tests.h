// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what an emulator makes of a model whose parameters and effects act on each other, for tests:
//   changes from the centre along single coordinates, added up.
// Method: every coordinate alone is exact. anchored() shifts it to the model's own rows at a point,
//   if it may. Units: the model's. Failure: the model's.
#pragma once

#include <memory>

#include "diagnose/prober.h"

namespace bondlab::diagnose {

class AdditiveModel : public Prober {
 public:
  AdditiveModel(Prober &exact, ModelPoint centre, bool may_anchor)
      : exact_(exact), centre_(std::move(centre)), may_anchor_(may_anchor) {
    at_centre_ = exact_.probe({centre_}).front();
    shift_ = Eigen::VectorXd::Zero(at_centre_.size());
  }
  std::size_t parameters() const override { return exact_.parameters(); }
  std::size_t effects() const override { return exact_.effects(); }
  double parameter_step(std::size_t i) const override { return exact_.parameter_step(i); }
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override {
    std::vector<Eigen::VectorXd> out;
    for (const auto &point : batch) out.push_back(added(point) + shift_);
    return out;
  }
  std::unique_ptr<Prober> anchored(const ModelPoint &point, Anchoring) override {
    if (!may_anchor_) return nullptr;
    auto out = std::make_unique<AdditiveModel>(exact_, centre_, true);
    out->shift_ = exact_.probe({point}).front() - added(point);
    return out;
  }

 private:
  Eigen::VectorXd added(const ModelPoint &point) {
    Eigen::VectorXd out = at_centre_;
    const auto add = [&](const ModelPoint &single) {
      out += exact_.probe({single}).front() - at_centre_;
    };
    for (Eigen::Index i = 0; i < point.z.size(); ++i) {
      if (point.z(i) == centre_.z(i)) continue;
      ModelPoint single = centre_;
      single.z(i) = point.z(i);
      add(single);
    }
    for (Eigen::Index k = 0; k < point.amplitude.size(); ++k) {
      if (point.amplitude(k) == 0) continue;
      ModelPoint single = centre_;
      single.amplitude(k) = point.amplitude(k);
      add(single);
    }
    return out;
  }

  Prober &exact_;
  ModelPoint centre_;
  bool may_anchor_;
  Eigen::VectorXd at_centre_, shift_;
};

}  // namespace bondlab::diagnose
