// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "diagnose/covariance.h"
#include "diagnose/measuring_error.h"
#include "diagnose/row_selection.h"
#include "diagnose/score.h"

namespace bondlab::diagnose {

namespace {

constexpr int sizing_rounds = 2;
constexpr double near_enough = 0.25;  // of the wanted units
constexpr double longest_stride = 3;  // of a size, at a time

// Data of a plan with nothing measured yet: what noise units are counted in.
std::vector<MeasuredSeries> plan_of(const std::vector<ProbedSeries> &probed, int replicates) {
  std::vector<MeasuredSeries> out;
  for (const auto &p : probed) {
    MeasuredSeries series;
    series.probed = p;
    series.replicates =
        Eigen::MatrixXd::Zero(replicates, static_cast<Eigen::Index>(p.quantities.size()));
    out.push_back(std::move(series));
  }
  return out;
}

class Sizer {
 public:
  Sizer(StudyModel &model, const Evidence &plan)
      : model_(model),
        whitening_(plan),
        linear_(linearise(model.emulated(), whitening_, model.emulated().centre())),
        fitted_(linear_.jacobian) {}

  // The norm of the mean change without what the noise of few packings adds to it.
  double units(const EffectDefinition &effect, double size) {
    return norm_of(emulated(effect, size));
  }

  // The same of the engine's own runs at that size.
  double units_run(const EffectDefinition &effect, double size) {
    return norm_of(model_.emulated().engine_changes(with(effect, size)));
  }

  // The size with so many units, or the largest there is.
  double size_of(const EffectDefinition &effect, double wanted, double largest) {
    if (units(effect, largest) <= wanted) return largest;
    double low = 0, high = largest;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (units(effect, middle) < wanted ? low : high) = middle;
    }
    return high;
  }

 private:
  double norm_of(const Eigen::MatrixXd &changes) const {
    const auto count = static_cast<double>(changes.rows());
    Eigen::MatrixXd off(changes.cols(), changes.rows());
    for (Eigen::Index i = 0; i < changes.rows(); ++i)
      off.col(i) = fitted_.off(whitening_.apply(changes.row(i).transpose()));
    const Eigen::VectorXd mean = off.rowwise().mean();
    const double noise = (off.colwise() - mean).squaredNorm() / (count * (count - 1));
    return std::sqrt(std::max(0.0, mean.squaredNorm() - noise));
  }

  ModelPoint with(const EffectDefinition &effect, double size) const {
    ModelPoint out = model_.emulated().centre();
    for (std::size_t k = 0; k < model_.effects().size(); ++k)
      if (model_.effects()[k].name == effect.name)
        out.amplitude(static_cast<Eigen::Index>(k)) = size / model_.catalogue()[k].switch_on;
    return out;
  }

  Eigen::MatrixXd emulated(const EffectDefinition &effect, double size) {  // packings x rows
    Eigen::MatrixXd out = model_.emulated().changes(with(effect, size));
    out.rowwise() += measuring(effect, size).transpose();
    return out;
  }

  // What an error of measuring does to the centre's curves: packings as specimens of a campaign.
  Eigen::VectorXd measuring(const EffectDefinition &effect, double size) {
    auto &engine = model_.engine();
    Eigen::VectorXd out = Eigen::VectorXd::Zero(engine.rows());
    if (effect.measures.empty()) return out;
    constexpr int campaign = 4;
    const auto &series = engine.series();
    const auto &study = model_.study();
    std::vector<MeasuredRun> runs;
    std::vector<std::map<std::string, double>> variables;
    for (std::size_t t = 0; t < series.size(); ++t)
      for (int packing = 0; packing < campaign; ++packing) {
        const auto outcome = engine.curves(model_.emulated().centre(), packing)[t];
        runs.push_back({study.test(series[t].test).definition.name, series[t].name, outcome.curve});
        variables.push_back(outcome.deck_variables);
      }
    const auto rows_of = [&] {
      Eigen::VectorXd rows(engine.rows());
      Eigen::Index first = 0;
      for (std::size_t t = 0; t < series.size(); ++t) {
        const auto count = static_cast<Eigen::Index>(series[t].quantities.size());
        Eigen::VectorXd mean = Eigen::VectorXd::Zero(count);
        for (std::size_t i = t * campaign; i < (t + 1) * campaign; ++i)
          mean += rows_of_curve(runs[i].curve, series[t].quantities,
                                study.test(series[t].test).definition, variables[i]) /
                  campaign;
        rows.segment(first, count) = mean;
        first += count;
      }
      return rows;
    };
    const Eigen::VectorXd without = rows_of();
    apply_measuring_errors(effect, size, runs);
    out = rows_of() - without;
    // A cell that saturates takes rows away (no fall): nothing can be told of them here.
    for (Eigen::Index row = 0; row < out.size(); ++row)
      if (!std::isfinite(out(row))) out(row) = 0;
    return out;
  }

  StudyModel &model_;
  Whitening whitening_;
  Linearisation linear_;
  Projection fitted_;
};

// Empty, or the switch-on size that puts `size` between the two that are run: it is beyond them, or
// so far below that a slope between them says nothing of it.
std::map<std::size_t, double> beyond_sizes_run(StudyModel &model, const EffectDefinition &effect,
                                               double size) {
  for (std::size_t k = 0; k < model.effects().size(); ++k) {
    const double switch_on = model.catalogue()[k].switch_on;
    if (model.effects()[k].name != effect.name || model.emulated().knows(k, size / switch_on))
      continue;
    return {{k, std::copysign(size / 1.5, switch_on)}};
  }
  return {};
}

}  // namespace

Evidence plan_evidence(StudyModel &model, int replicates) {
  auto evidence = evidence_of(model.study(), plan_of(model.engine().series(), 0),
                              model.emulated().centre_rows());
  for (auto &series : evidence.series) series.planned = replicates;
  return without_data(evidence);
}

Sized search_size(const std::function<double(double)> &units, double first, double wanted,
                  double largest, int most) {
  std::map<double, double> run;  // size: units
  Sized best;
  double off = std::numeric_limits<double>::infinity(), size = std::min(first, largest);
  for (int i = 0; i < most; ++i) {
    const double found = units(size);
    run[size] = found;
    const double now = std::abs(found - wanted);
    if (now < off) best = {size, found}, off = now;
    if (now <= near_enough * wanted || (found < wanted && size >= largest)) break;
    // Between the sizes on either side of what is wanted, else on from the nearest.
    const auto above =
        std::find_if(run.begin(), run.end(), [&](const auto &one) { return one.second >= wanted; });
    double next = 0;
    if (above == run.end()) {
      next = size * std::min(longest_stride, wanted / std::max(found, wanted / longest_stride));
    } else if (above == run.begin()) {
      next = above->first * std::max(1 / longest_stride, wanted / above->second);
    } else {
      const auto below = std::prev(above);
      const double slope = std::log(above->second / std::max(below->second, 0.1 * wanted)) /
                           std::log(above->first / below->first);
      next = above->first * std::pow(wanted / above->second, 1 / slope);
    }
    next = std::min(next, largest);
    if (run.count(next)) break;
    size = next;
  }
  return best;
}

Eigen::VectorXd wider_than_packings(StudyModel &model, std::vector<MeasuredSeries> measured) {
  const auto rows = keep_modelled(measured, model.engine().series());
  const Evidence evidence =
      evidence_of(model.study(), measured, columns_of(model.emulated().centre_rows(), rows));
  const Eigen::VectorXd packings = variances(model.emulated().centre_rows());
  Eigen::VectorXd out = Eigen::VectorXd::Ones(packings.size());
  for (const auto &series : evidence.series)
    for (int i = 0; i < series.count; ++i) {
      const auto row = rows[static_cast<std::size_t>(series.first + i)];
      const double least = instrument_sd * instrument_sd;
      out(row) = std::sqrt(series.stated(i, i) / std::max(least, packings(row)));
    }
  return out;
}

Evidence widened(Evidence plan, const Eigen::VectorXd &wider) {
  for (auto &series : plan.series) {
    const auto by = wider.segment(series.first, series.count).asDiagonal();
    series.stated = by * series.stated * by;
  }
  return plan;
}

Sized size_for(StudyModel &model, const Evidence &plan, const EffectDefinition &effect,
               double wanted, double largest) {
  for (int round = 0;; ++round) {
    Sizer sizer(model, plan);
    const double size = sizer.size_of(effect, wanted, largest);
    const auto further = round < sizing_rounds ? beyond_sizes_run(model, effect, size)
                                               : std::map<std::size_t, double>();
    if (!further.empty()) {
      model.rescale(further);
      continue;
    }
    if (!effect.measures.empty()) return {size, sizer.units(effect, size)};
    return search_size([&](double s) { return sizer.units_run(effect, s); }, size, wanted, largest);
  }
}

}  // namespace bondlab::diagnose
