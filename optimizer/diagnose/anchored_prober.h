// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: an emulator that is right at one point besides its centre: where a fit has to be judged.
// Method: the engine was run at the anchor on some of the emulator's packings; its mean change from
//   the centre stands there in place of the emulated one, and what the emulator says of the way
//   from the anchor is added. So what effects and parameters do to each other, and what bends
//   beyond the sizes run, is in the rows, and the doubt is that of the runs at the anchor.
// Why: changes along different coordinates add in the emulator. Two effects of twenty noise units
//   that change each other by a fifth leave four units, which no name explains.
// Source: a multi-point correction of a response surface, Haftka, AIAA J. 29 (1991) 1523.
// Units: as EmulatedProber. Failure: none here.
// Limits: away from the anchor as far off as the emulator.
#pragma once

#include <vector>

#include "diagnose/emulated_prober.h"

namespace bondlab::diagnose {

class AnchoredProber : public Prober {
 public:
  // `change`: packings x rows, of the engine from the centre to the anchor, on those of the
  // emulator's packings with these indices; nothing in it is NaN. `whole` must outlive the prober.
  AnchoredProber(EmulatedProber &whole, ModelPoint anchor, std::vector<Eigen::Index> packings,
                 Eigen::MatrixXd change);

  std::size_t parameters() const override { return whole_.parameters(); }
  std::size_t effects() const override { return whole_.effects(); }
  double parameter_step(std::size_t parameter) const override {
    return whole_.parameter_step(parameter);
  }
  std::vector<Eigen::VectorXd> probe(const std::vector<ModelPoint> &batch) override;
  Eigen::MatrixXd uncertainty(const ModelPoint &point) override;
  std::unique_ptr<Prober> anchored(const ModelPoint &point, Anchoring how) override {
    return whole_.anchored(point, how);
  }

 private:
  Eigen::MatrixXd emulated(const ModelPoint &point) const;  // changes on the anchor's packings

  EmulatedProber &whole_;
  ModelPoint anchor_;
  std::vector<Eigen::Index> packings_;
  Eigen::MatrixXd change_;
  Eigen::VectorXd shift_;  // engine less emulator at the anchor
};

}  // namespace bondlab::diagnose
