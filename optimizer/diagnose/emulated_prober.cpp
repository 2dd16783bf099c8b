// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/emulated_prober.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "diagnose/anchored_prober.h"
#include "diagnose/covariance.h"
#include "diagnose/parameter_step.h"

namespace bondlab::diagnose {

namespace {

constexpr std::size_t least_anchors = 4;
constexpr int anchor_runs = 100;
constexpr double as_good = 0.2;  // in the logarithm of a step
constexpr double unknown_variance = 9;
constexpr double least_share = 0.2;              // of a step that a bound leaves
constexpr double covered = 2, longest_move = 4;  // in steps
constexpr double least_amplitude = 0.4;          // of a switch-on size, that a slope is trusted at

std::vector<int> first(int count) {
  std::vector<int> out(static_cast<std::size_t>(count));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

// As many as a hundred runs are, and no fewer than effects are switched on on.
int most_anchors(const EmulatorPlan &plan, const ForwardProber &engine) {
  const int affordable = anchor_runs / std::max(1, static_cast<int>(engine.series().size()));
  return std::min(plan.anchors, std::max(affordable, plan.differences));
}

}  // namespace

Way EmulatedProber::dead_way() const {
  const Eigen::MatrixXd none =
      Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(effect_packings_.size()), rows_.cols(),
                                std::numeric_limits<double>::quiet_NaN());
  Way out = way_through({1.0}, {none});
  widen(out);
  return out;
}

void EmulatedProber::widen(Way &way) const {
  const auto few = static_cast<double>(effect_packings_.size()),
             many = static_cast<double>(packings_.size());
  if (few == many) return;
  const double factor = std::sqrt(many * (many - 1) / (few * (few - 1)));
  for (auto *slopes : {&way.linear, &way.squared, &way.below}) {
    if (slopes->size() == 0) continue;
    const Eigen::RowVectorXd mean = slopes->colwise().mean();
    Eigen::MatrixXd out = mean.replicate(static_cast<Eigen::Index>(packings_.size()), 1);
    out.topRows(slopes->rows()) += factor * (slopes->rowwise() - mean);
    *slopes = out;
  }
}

Way EmulatedProber::effect_way(const std::vector<double> &knots,
                               const std::vector<Eigen::MatrixXd> &changes) const {
  Way out;
  if (knots.front() > 0) {
    out = way_through(knots, changes);
  } else {
    const Way lower = way_through({knots.front()}, {changes.front()});
    out = lower;
    if (knots.size() > 1) {
      out = way_through({knots.begin() + 1, knots.end()}, {changes.begin() + 1, changes.end()});
      out.below = lower.linear;
      out.noise_below = lower.noise;
      out.low = lower.low;
      out.unknown = out.unknown || lower.unknown;
      out.dead = out.dead || lower.dead;
    }
  }
  widen(out);
  return out;
}

std::vector<double> EmulatedProber::knots_of(const EffectEntry &entry) const {
  const double largest = entry.largest / entry.switch_on, lowest = entry.lowest / entry.switch_on;
  std::vector<double> knots;
  if (lowest <= -1) knots.push_back(-1);
  knots.push_back(std::min(1.0, largest));
  if (largest >= 1.5) knots.push_back(std::min(2.0, largest));
  return knots;
}

std::vector<double> EmulatedProber::knots_up_and_down(std::size_t parameter, double step,
                                                      std::vector<ModelPoint> &points) const {
  std::vector<double> knots;
  for (const double sign : {-1.0, 1.0}) {
    const ModelPoint there = moved(parameter, sign * step);
    const double x = coordinate(parameter, there);
    if (std::abs(x) < least_share * step) continue;
    knots.push_back(x);
    points.push_back(there);
  }
  return knots;
}

// From the centre, which has been run.
std::vector<Eigen::MatrixXd> EmulatedProber::changes_at(const std::vector<ModelPoint> &points,
                                                        const std::vector<int> &packings) {
  engine_.prepare(points, packings);
  const Eigen::MatrixXd own = as_run_.topRows(static_cast<Eigen::Index>(packings.size()));
  std::vector<Eigen::MatrixXd> out;
  for (const auto &point : points) out.push_back(engine_.by_packing(point, packings) - own);
  return out;
}

std::vector<double> EmulatedProber::steps_from_noise(const EmulatorPlan &plan) {
  std::vector<ModelPoint> points;
  std::vector<std::vector<double>> knots;
  for (std::size_t i = 0; i < engine_.parameters(); ++i)
    knots.push_back(knots_up_and_down(i, plan.pilot, points));
  const auto changes = changes_at(points, effect_packings_);
  std::vector<double> out;
  auto next = changes.begin();
  for (const auto &own : knots) {
    const auto end = next + static_cast<std::ptrdiff_t>(own.size());
    const double step = parameter_step_from_noise(own, {next, end}, scatter_,
                                                  static_cast<double>(packings_.size()));
    // The pilot's own runs serve where they are as good.
    out.push_back(std::abs(std::log(step / plan.pilot)) < as_good ? plan.pilot : step);
    next = end;
  }
  return out;
}

EmulatedProber::EmulatedProber(ForwardProber &engine, const std::vector<EffectEntry> &catalogue,
                               const ModelPoint &centre, const EmulatorPlan &plan,
                               bool with_effects)
    : engine_(engine),
      centre_(centre),
      packings_(first(std::min(std::max(plan.parameters, plan.differences), plan.centre))),
      effect_packings_(first(std::min(plan.differences, plan.centre))),
      anchor_packings_(
          first(std::min(most_anchors(plan, engine), static_cast<int>(packings_.size())))) {
  const auto planned = [&](std::size_t k) {
    return plan.effects.empty() ||
           std::find(plan.effects.begin(), plan.effects.end(), k) != plan.effects.end();
  };
  std::vector<ModelPoint> effect_points;
  if (with_effects)
    for (std::size_t k = 0; k < engine.effects(); ++k)
      for (const double knot : planned(k) ? knots_of(catalogue[k]) : std::vector<double>()) {
        effect_points.push_back(centre);
        effect_points.back().amplitude(static_cast<Eigen::Index>(k)) = knot;
      }
  // The centre first: what all the rest is compared with.
  as_run_ = engine.by_packing(centre, first(plan.centre));
  rows_ = with_means_where_lacking(as_run_);
  mean_ = rows_.colwise().mean();
  scatter_ = variances(rows_);
  steps_ = plan.steps.empty() ? steps_from_noise(plan) : plan.steps;
  std::vector<ModelPoint> points;
  std::vector<std::vector<double>> knots;
  for (std::size_t i = 0; i < engine.parameters(); ++i)
    knots.push_back(knots_up_and_down(i, steps_[i], points));
  const auto changes = changes_at(points, packings_);
  auto next = changes.begin();
  for (const auto &own : knots) {
    const auto end = next + static_cast<std::ptrdiff_t>(own.size());
    parameters_.push_back(way_through(own, {next, end}));
    next = end;
  }
  const auto effect_changes = changes_at(effect_points, effect_packings_);
  next = effect_changes.begin();
  for (std::size_t k = 0; k < engine.effects() && with_effects; ++k) {
    if (!planned(k)) {
      effects_.push_back(dead_way());
      continue;
    }
    const auto own = knots_of(catalogue[k]);
    const auto end = next + static_cast<std::ptrdiff_t>(own.size());
    effects_.push_back(effect_way(own, {next, end}));
    next = end;
  }
}

double EmulatedProber::coordinate(std::size_t parameter, const ModelPoint &point) const {
  const auto k = static_cast<Eigen::Index>(parameter);
  if (point.z(k) == centre_.z(k)) return 0;
  const double x = engine_.physical(point)[parameter], x0 = engine_.physical(centre_)[parameter];
  const auto &p = engine_.space().parameter(parameter);
  return p.lower > 0 ? std::log(x / x0) : (x - x0) / (p.upper - p.lower);
}

ModelPoint EmulatedProber::moved(std::size_t parameter, double x) const {
  const auto k = static_cast<Eigen::Index>(parameter);
  const auto &p = engine_.space().parameter(parameter);
  auto values = engine_.physical(centre_);
  const double wanted =
      p.lower > 0 ? values[parameter] * std::exp(x) : values[parameter] + x * (p.upper - p.lower);
  values[parameter] = std::clamp(wanted, p.lower, p.upper);
  ModelPoint out = centre_;
  out.z(k) = engine_.space().to_transformed({values}).z[parameter];
  return out;
}

double EmulatedProber::parameter_step(std::size_t parameter) const {
  const auto k = static_cast<Eigen::Index>(parameter);
  return std::clamp(std::abs(moved(parameter, 0.5 * steps_[parameter]).z(k) - centre_.z(k)), 0.01,
                    1.0);
}

Eigen::MatrixXd EmulatedProber::changes(const ModelPoint &point) const {
  Eigen::MatrixXd out =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(packings_.size()), rows_.cols());
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const double x = coordinate(i, point);
    if (x != 0) out += parameters_[i].at(x);
  }
  for (Eigen::Index k = 0; k < point.amplitude.size(); ++k) {
    const double x = point.amplitude(k);
    if (x == 0) continue;
    const auto i = static_cast<std::size_t>(k);
    if (i >= effects_.size() || effects_[i].dead)
      out.setConstant(std::numeric_limits<double>::quiet_NaN());
    else
      out += effects_[i].at(x);
  }
  return out;
}

Eigen::RowVectorXd EmulatedProber::noise(const ModelPoint &point) const {
  Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(rows_.cols());
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    out += parameters_[i].noise_at(coordinate(i, point));
  for (std::size_t k = 0; k < effects_.size(); ++k)
    out += effects_[k].noise_at(point.amplitude(static_cast<Eigen::Index>(k)));
  return out;
}

std::vector<Eigen::VectorXd> EmulatedProber::probe(const std::vector<ModelPoint> &batch) {
  std::vector<Eigen::VectorXd> out;
  for (const auto &point : batch) {
    const Eigen::RowVectorXd change = changes(point).colwise().mean() - noise(point);
    out.push_back(mean_ + Eigen::VectorXd(change.transpose()));
  }
  return out;
}

Eigen::MatrixXd EmulatedProber::covariance_of(const Eigen::MatrixXd &changes, double factor) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(changes.cols(), changes.cols());
  Eigen::Index first_row = 0;
  for (const auto &series : engine_.series()) {
    const auto count = static_cast<Eigen::Index>(series.quantities.size());
    out.block(first_row, first_row, count, count) =
        factor * shrunk_covariance(changes.middleCols(first_row, count));
    first_row += count;
  }
  return out;
}

std::unique_ptr<Prober> EmulatedProber::anchored(const ModelPoint &point, Anchoring how) {
  const auto few = std::min(effect_packings_.size(), anchor_packings_.size());
  const auto &packings = how == Anchoring::whole ? anchor_packings_ : first(static_cast<int>(few));
  engine_.prepare({point}, packings);
  const Eigen::MatrixXd there = engine_.by_packing(point, packings);
  std::vector<Eigen::Index> whole;  // packings that lack no row
  for (Eigen::Index p = 0; p < there.rows(); ++p)
    if ((there - as_run_.topRows(there.rows())).row(p).allFinite()) whole.push_back(p);
  if (whole.size() < least_anchors) return nullptr;
  Eigen::MatrixXd change(static_cast<Eigen::Index>(whole.size()), there.cols());
  for (std::size_t i = 0; i < whole.size(); ++i)
    change.row(static_cast<Eigen::Index>(i)) = there.row(whole[i]) - as_run_.row(whole[i]);
  return std::make_unique<AnchoredProber>(*this, point, whole, change);
}

Eigen::MatrixXd EmulatedProber::uncertainty(const ModelPoint &point) {
  const Eigen::MatrixXd changed = changes(point);
  const auto packings = static_cast<double>(packings_.size());
  const bool with_effects = (point.amplitude.array() != 0).any();
  const double widened =
      widening(with_effects ? static_cast<double>(effect_packings_.size()) : packings) / packings;
  Eigen::MatrixXd out = covariance_of(changed, widened);
  const auto doubt = [&](const Way &way) {
    for (Eigen::Index row = 0; row < rows_.cols(); ++row)
      if (way.unknown(row)) out(row, row) += unknown_variance * scatter_(row);
  };
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (point.z(static_cast<Eigen::Index>(i)) != centre_.z(static_cast<Eigen::Index>(i)))
      doubt(parameters_[i]);
  for (std::size_t k = 0; k < effects_.size(); ++k)
    if (point.amplitude(static_cast<Eigen::Index>(k)) != 0) doubt(effects_[k]);
  return out;
}

bool EmulatedProber::covers(const ModelPoint &point) const {
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (std::abs(coordinate(i, point)) > covered * steps_[i]) return false;
  return true;
}

ModelPoint EmulatedProber::towards(const ModelPoint &point) const {
  ModelPoint out = centre_;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const double most = longest_move * steps_[i];
    const double x = std::clamp(coordinate(i, point), -most, most);
    const auto k = static_cast<Eigen::Index>(i);
    out.z(k) = moved(i, x).z(k);
  }
  return out;
}

void EmulatedProber::renew(std::size_t effect, const EffectEntry &entry) {
  const auto knots = knots_of(entry);
  std::vector<ModelPoint> points(knots.size(), centre_);
  for (std::size_t i = 0; i < knots.size(); ++i)
    points[i].amplitude(static_cast<Eigen::Index>(effect)) = knots[i];
  effects_[effect] = effect_way(knots, changes_at(points, effect_packings_));
}

Eigen::MatrixXd EmulatedProber::engine_changes(const ModelPoint &point) {
  Eigen::MatrixXd out = with_means_where_lacking(changes_at({point}, effect_packings_).front());
  for (Eigen::Index row = 0; row < out.cols(); ++row)
    if (!out.col(row).allFinite()) out.col(row).setZero();
  return out;
}

bool EmulatedProber::covers(std::size_t effect, double amplitude) const {
  const Way &way = effects_[effect];
  const double spare = 0.1 * (way.high - way.low);
  return amplitude <= way.high + spare && amplitude >= way.low - spare;
}

bool EmulatedProber::knows(std::size_t effect, double amplitude) const {
  return covers(effect, amplitude) && std::abs(amplitude) >= least_amplitude;
}

std::vector<Eigen::VectorXd> EmulatedProber::confirm(const std::vector<ModelPoint> &points) {
  std::vector<Eigen::VectorXd> out;
  for (const auto &change : changes_at(points, packings_))
    out.push_back(mean_ +
                  Eigen::VectorXd(with_means_where_lacking(change).colwise().mean().transpose()));
  return out;
}

double EmulatedProber::trace_noise(std::size_t effect) const {
  const Way &way = effects_[effect];
  if (way.dead) return std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd changes = way.at(1);
  const Eigen::VectorXd scatter = variances(changes);
  double noise = 0, signal = 0;
  for (Eigen::Index row = 0; row < changes.cols(); ++row) {
    if (way.unknown(row) || !(scatter_(row) > 0)) continue;
    noise += scatter(row) / static_cast<double>(changes.rows()) / scatter_(row);
    signal += changes.col(row).mean() * changes.col(row).mean() / scatter_(row);
  }
  return signal > 0 ? std::sqrt(noise / signal) : std::numeric_limits<double>::infinity();
}

}  // namespace bondlab::diagnose
