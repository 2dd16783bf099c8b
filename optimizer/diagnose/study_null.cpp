// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_null.h"

#include <memory>

namespace bondlab::diagnose {

namespace {

Eigen::MatrixXd root_of(const Eigen::MatrixXd &covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

// count samples x rows
Eigen::MatrixXd draws(const Eigen::MatrixXd &root, Eigen::Index count, RandomStream &random) {
  Eigen::MatrixXd out(root.rows(), count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index i = 0; i < out.rows(); ++i) out(i, j) = random.normal();
  return (root * out).transpose();
}

struct Roots {
  Eigen::MatrixXd specimens, packings, doubt;
};

}  // namespace

NullSource study_null(NullModel given) {
  const auto model = std::make_shared<NullModel>(std::move(given));
  const auto roots = std::make_shared<std::vector<Roots>>();
  const Whitening found(model->evidence);
  for (std::size_t i = 0; i < model->series.size(); ++i) {
    const auto &s = model->evidence.series[i];
    const double scale = found.noise().by_test.at(s.test);
    Roots r;
    r.specimens = root_of(scale * scale * s.stated);
    r.packings = root_of(s.simulated * static_cast<double>(model->by_packing.rows()));
    if (model->doubt.size() > 0)
      r.doubt = root_of(model->doubt.block(s.first, s.first, s.count, s.count));
    roots->push_back(std::move(r));
  }
  return [model, roots](RandomStream &random) {
    std::vector<MeasuredSeries> series = model->series;
    Eigen::MatrixXd packings(model->by_packing.rows(), model->by_packing.cols());
    Eigen::VectorXd doubt = Eigen::VectorXd::Zero(packings.cols());
    for (std::size_t i = 0; i < series.size(); ++i) {
      const auto &s = model->evidence.series[i];
      const auto &r = (*roots)[i];
      series[i].replicates = draws(r.specimens, series[i].replicates.rows(), random);
      packings.middleCols(s.first, s.count) = draws(r.packings, packings.rows(), random);
      if (r.doubt.size() > 0)
        doubt.segment(s.first, s.count) = draws(r.doubt, 1, random).row(0).transpose();
    }
    const Evidence evidence = evidence_of(model->study, series, packings);
    const Whitening whitening(evidence, model->doubt);
    NullDraw draw;
    draw.residual =
        whitening.residual(Eigen::VectorXd(packings.colwise().mean().transpose()) + doubt);
    const auto whitened = [&](const Eigen::MatrixXd &columns) {
      Eigen::MatrixXd out(columns.rows(), columns.cols());
      for (Eigen::Index j = 0; j < columns.cols(); ++j) out.col(j) = whitening.apply(columns.col(j));
      return out;
    };
    draw.jacobian = whitened(model->jacobian);
    draw.traces = whitened(model->traces);
    return draw;
  };
}

}  // namespace bondlab::diagnose
