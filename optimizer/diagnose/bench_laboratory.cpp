// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/bench_laboratory.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "base/random.h"

namespace bondlab::diagnose {

namespace {

using rheology::Curve;
using rheology::Kind;
using rheology::Series;
using rheology::Specimen;

constexpr int packings = 4;             // of the model
constexpr int covariance_draws = 4000;  // a covariance from n draws of p rows is off by p/n

struct Quantity {
  CurvePart part;
  const char *name;
};

const std::vector<Quantity> &quantities(Kind kind) {
  using P = CurvePart;
  static const std::vector<Quantity> compression = {{P::toe, "platen strain at 0.1"},
                                                    {P::toe, "platen strain at 0.2"},
                                                    {P::toe, "gauge strain at 0.1"},
                                                    {P::toe, "gauge strain at 0.2"},
                                                    {P::toe, "Poisson's ratio at 0.2"},
                                                    {P::toe, "side difference at 0.2"},
                                                    {P::slope, "gauge compliance"},
                                                    {P::slope, "platen compliance"},
                                                    {P::slope, "Poisson's ratio at 0.5"},
                                                    {P::slope, "side difference at 0.7"},
                                                    {P::pre_peak, "compliance 0.5 to 0.7"},
                                                    {P::pre_peak, "compliance 0.7 to 0.9"},
                                                    {P::pre_peak, "compliance 0.9 to 1"},
                                                    {P::pre_peak, "Poisson's ratio at 0.9"},
                                                    {P::peak, "log stress"},
                                                    {P::post_peak, "stress at 0.5e-3"},
                                                    {P::post_peak, "stress at 1.5e-3"},
                                                    {P::post_peak, "stress at 4e-3"},
                                                    {P::unload, "compliance"},
                                                    {P::unload, "permanent strain"},
                                                    {P::hold, "relaxed after 10 s"},
                                                    {P::hold, "relaxed after 100 s"},
                                                    {P::hold, "relaxed after 1000 s"}};
  static const std::vector<Quantity> others = {{P::toe, "strain at 0.1"},
                                               {P::toe, "strain at 0.2"},
                                               {P::slope, "compliance"},
                                               {P::pre_peak, "compliance 0.6 to 0.9"},
                                               {P::peak, "log stress"},
                                               {P::post_peak, "stress at 0.5e-3"},
                                               {P::post_peak, "stress at 1.5e-3"},
                                               {P::post_peak, "stress at 4e-3"}};
  return kind == Kind::compression ? compression : others;
}

// Channel against the share of the peak stress, by linear interpolation.
double at_share(const Curve &curve, const std::array<double, Curve::points> &channel,
                double share) {
  const double wanted = share * curve.stress[Curve::peak];
  int i = 1;
  while (i < Curve::peak && curve.stress[i] < wanted) ++i;
  const double low = curve.stress[i - 1], high = curve.stress[i];
  const double t = high > low ? (wanted - low) / (high - low) : 0;
  return channel[i - 1] + t * (channel[i] - channel[i - 1]);
}

// Strain at a low load over the strain between 0.3 and 0.6 of the peak. A share, not a logarithm:
// seating can make it zero.
double toe_share(const Curve &curve, const std::array<double, Curve::points> &channel,
                 double share) {
  return at_share(curve, channel, share) /
         (at_share(curve, channel, 0.6) - at_share(curve, channel, 0.3));
}

double log_compliance(const Curve &curve, const std::array<double, Curve::points> &channel,
                      double from, double to) {
  const double strain = at_share(curve, channel, to) - at_share(curve, channel, from);
  return std::log(std::max(1e-9, strain) / ((to - from) * curve.stress[Curve::peak]));
}

// Stress over the peak at a platen strain beyond it.
double falling_share(const Curve &curve, double beyond) {
  const double wanted = curve.platen[Curve::peak] + beyond;
  int i = Curve::rising;
  while (i < Curve::points - 1 && curve.platen[i] < wanted) ++i;
  const double low = curve.platen[i - 1], high = curve.platen[i];
  const double t = high > low ? std::clamp((wanted - low) / (high - low), 0.0, 1.0) : 0;
  const double stress = curve.stress[i - 1] + t * (curve.stress[i] - curve.stress[i - 1]);
  return stress / curve.stress[Curve::peak];
}

void add_rows(const Curve &curve, Kind kind, double *row) {
  const double peak = curve.stress[Curve::peak];
  const double reference = 80e6 / 40e9;  // strain in which small strains are counted
  if (kind != Kind::compression) {
    *row++ = toe_share(curve, curve.platen, 0.1);
    *row++ = toe_share(curve, curve.platen, 0.2);
    *row++ = log_compliance(curve, curve.platen, 0.3, 0.6);
    *row++ = log_compliance(curve, curve.platen, 0.6, 0.9);
    *row++ = std::log(peak);
  } else {
    for (const auto *channel : {&curve.platen, &curve.gauge})
      for (const double share : {0.1, 0.2}) *row++ = toe_share(curve, *channel, share);
    const auto poisson = [&](double share) {
      return at_share(curve, curve.lateral, share) / at_share(curve, curve.gauge, share);
    };
    *row++ = poisson(0.2);
    *row++ = at_share(curve, curve.difference, 0.2);
    *row++ = log_compliance(curve, curve.gauge, 0.3, 0.5);
    *row++ = log_compliance(curve, curve.platen, 0.3, 0.5);
    *row++ = poisson(0.5);
    *row++ = at_share(curve, curve.difference, 0.7);
    *row++ = log_compliance(curve, curve.gauge, 0.5, 0.7);
    *row++ = log_compliance(curve, curve.gauge, 0.7, 0.9);
    *row++ = log_compliance(curve, curve.gauge, 0.9, 1);
    *row++ = poisson(0.9);
    *row++ = std::log(peak);
  }
  for (const double beyond : {0.5e-3, 1.5e-3, 4e-3}) *row++ = falling_share(curve, beyond);
  if (kind == Kind::compression) {
    *row++ = -std::log(curve.unload_modulus);
    *row++ = curve.permanent / reference;
    for (const double relaxed : curve.relaxed) *row++ = relaxed;
  }
}

Specimen draw_specimen(RandomStream &random, const BenchScatter &s, double shrink,
                       double added_strength) {
  Specimen out;
  const double strength = std::hypot(s.strength, added_strength);
  out.stiffness = std::exp(shrink * s.stiffness * random.normal());
  out.strength = std::exp(shrink * strength * random.normal());
  out.post = std::exp(shrink * s.post * random.normal());
  out.seating = shrink * s.seating * random.normal();
  return out;
}

void add_sensor_noise(Curve &curve, RandomStream &random, const BenchScatter &s) {
  // A cell and its amplifier err by a share that is the same along a curve, and jitter less.
  const double gain = 1 + s.load * random.normal();
  for (int i = 0; i < Curve::points; ++i) {
    curve.stress[i] *= gain;
    curve.platen[i] *= 1 + s.strain * random.normal();
    curve.gauge[i] *= 1 + s.strain * random.normal();
    curve.lateral[i] *= 1 + s.strain * random.normal();
    curve.difference[i] += 5 * s.strain * random.normal();
  }
  for (int i = Curve::rising; i < Curve::points; ++i)
    curve.stress[i] += 0.01 * curve.stress[Curve::peak] * random.normal();
  curve.unload_modulus *= 1 + 2 * s.strain * random.normal();
  curve.permanent += 2e-5 * random.normal();
  for (double &relaxed : curve.relaxed) relaxed += s.hold * random.normal();
}

const BenchScatter scatter;

}  // namespace

const std::vector<std::string> &bench_parameters() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (std::size_t i = 0; i < rheology::base_count; ++i) list.push_back(rheology::base_name(i));
    return list;
  }();
  return names;
}

const std::vector<EffectEntry> &bench_catalogue() {
  static const std::vector<EffectEntry> list = [] {
    using K = EffectKind;
    std::vector<EffectEntry> all;
    const auto add = [&](rheology::Effect effect, K kind, const char *unit, double on, double low,
                         double high) {
      EffectEntry entry;
      entry.name = entry.title = rheology::effect_name(effect);
      entry.kind = kind;
      entry.unit = unit;
      entry.switch_on = on;
      entry.lowest = low;
      entry.largest = high;
      all.push_back(entry);
    };
    add(rheology::norton_creep, K::bond, "1/s", 1e-9, 0, 1e-5);
    add(rheology::arrhenius, K::bond, "J/mol", 200, 0, 2e4);
    add(rheology::weibull, K::bond, "1", 0.005, 0, 0.25);
    add(rheology::missing_bonds, K::bond, "1", 0.005, 0, 0.3);
    add(rheology::platen_seating, K::machine, "1", 5e-6, 0, 2e-3);
    add(rheology::residual_friction, K::bond, "1", 0.02, -0.4, 1);
    add(rheology::frame_compliance, K::machine, "m/N", 5e-12, 0, 2e-8);
    add(rheology::end_parallelism, K::specimen, "rad", 2e-5, 0, 5e-3);
    add(rheology::tilt, K::specimen, "rad", 5e-4, 0, 0.1);
    add(rheology::platen_friction, K::machine, "1", 0.02, 0, 1);
    add(rheology::tension_compression, K::bond, "1", 0.01, 0, 0.8);
    add(rheology::pressure_dependence, K::bond, "1", 0.01, 0, 1.5);
    add(rheology::yielding, K::bond, "1", 0.01, 0, 1);
    add(rheology::softening, K::bond, "1", 0.01, 0, 0.9);
    add(rheology::inertia, K::bond, "1", 0.01, 0, 1);
    add(rheology::rolling_resistance, K::bond, "1", 0.02, 0, 1);
    add(rheology::brazilian_conversion, K::conversion, "1", 0.01, -0.9, 10);
    add(rheology::shear_conversion, K::conversion, "1", 0.01, -0.9, 10);
    assert(all.size() == rheology::catalogue_count);
    return all;
  }();
  return list;
}

BenchLaboratory::BenchLaboratory(std::vector<Series> series, int replicates,
                                 const rheology::Material &rock, std::uint64_t seed)
    : series_(std::move(series)), replicates_(replicates), rock_(rock) {
  for (const auto &s : series_) {
    SeriesEvidence evidence;
    evidence.name = s.name;
    evidence.test = s.test;
    evidence.conditions = {{"rate", s.rate},
                           {"temperature", s.temperature},
                           {"size", s.size},
                           {"order of testing", s.order}};
    if (s.kind == Kind::shear) evidence.conditions["normal stress"] = s.normal_stress;
    evidence.planned = replicates_;
    evidence.first = static_cast<int>(blank_.rows.size());
    for (const auto &q : quantities(s.kind))
      blank_.rows.push_back({s.test, s.name, q.part, q.name});
    evidence.count = static_cast<int>(blank_.rows.size()) - evidence.first;
    blank_.series.push_back(evidence);
  }
  std::map<std::string, double> dof;
  for (const auto &s : series_) dof[s.test] += replicates_ - 1;
  for (const auto &[test, count] : dof) {
    ScatterEvidence evidence;
    evidence.row = static_cast<int>(blank_.rows.size());
    evidence.dof = count;
    evidence.stated = scatter.strength * scatter.strength + scatter.load * scatter.load;
    blank_.rows.push_back({test, test, CurvePart::scatter, "scatter of the strength"});
    blank_.scatter.push_back(evidence);
  }
  // Covariances of one specimen and of the mean over the model's packings, for this rock.
  const BenchTruth truth{rock_, {}};
  RandomStream random(seed, 7);
  for (std::size_t i = 0; i < series_.size(); ++i) {
    auto &evidence = blank_.series[i];
    Eigen::MatrixXd measured(covariance_draws, evidence.count),
        simulated(covariance_draws, evidence.count);
    Eigen::VectorXd row(evidence.count);
    for (int draw = 0; draw < covariance_draws; ++draw) {
      auto curve =
          curve_of(series_[i], truth.material, truth.effects, draw_specimen(random, scatter, 1, 0));
      add_sensor_noise(curve, random, scatter);
      add_rows(curve, series_[i].kind, row.data());
      measured.row(draw) = row.transpose();
      curve = curve_of(series_[i], truth.material, truth.effects,
                       draw_specimen(random, scatter, 0.5 / std::sqrt(packings), 0));
      add_rows(curve, series_[i].kind, row.data());
      simulated.row(draw) = row.transpose();
    }
    const auto covariance = [](const Eigen::MatrixXd &sample) {
      const Eigen::MatrixXd centred = sample.rowwise() - sample.colwise().mean();
      return Eigen::MatrixXd(centred.transpose() * centred / (sample.rows() - 1.0));
    };
    evidence.stated = covariance(measured);
    const auto mean = curve_of(series_[i], truth.material, truth.effects, Specimen());
    add_rows(mean, series_[i].kind, row.data());
    evidence.shift = measured.colwise().mean().transpose() - row;
    evidence.simulated = covariance(simulated);
  }
  take_packings(seed);
}

void BenchLaboratory::take_packings(std::uint64_t seed) {
  packings_.clear();
  for (const auto &s : series_) {
    RandomStream random(hash_ints({seed, static_cast<std::uint64_t>(s.order)}), 8);
    packings_.push_back(draw_specimen(random, scatter, 0.5 / std::sqrt(packings), 0));
  }
}

Eigen::VectorXd BenchLaboratory::rows_of(const BenchTruth &truth,
                                         const std::vector<Specimen> &specimens) const {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(blank_.rows.size()));
  std::map<std::string, std::pair<double, int>> added;
  for (std::size_t i = 0; i < series_.size(); ++i) {
    const auto curve = curve_of(series_[i], truth.material, truth.effects, specimens[i]);
    add_rows(curve, series_[i].kind, rows.data() + blank_.series[i].first);
    const double more = rheology::added_strength_scatter(series_[i], truth.effects);
    auto &sum = added[series_[i].test];
    sum.first += more * more, ++sum.second;
  }
  for (const auto &evidence : blank_.scatter) {
    const auto &sum = added[blank_.rows[static_cast<std::size_t>(evidence.row)].test];
    const double variance = evidence.stated + sum.first / sum.second;
    rows(evidence.row) = std::cbrt(variance / evidence.stated) * (1 - 2 / (9 * evidence.dof));
  }
  return rows;
}

rheology::Material bench_rock(std::uint64_t seed) {
  RandomStream random(seed, 10);
  rheology::Material rock;
  for (std::size_t i = 0; i < rheology::base_count; ++i)
    base(rock, i) *= std::exp(0.1 * random.normal());
  return rock;
}

std::vector<Eigen::VectorXd> BenchLaboratory::probe(const std::vector<ModelPoint> &batch) {
  std::vector<Eigen::VectorXd> out;
  out.reserve(batch.size());
  for (const auto &point : batch) out.push_back(rows_of(truth_at(point), packings_));
  return out;
}

Eigen::VectorXd BenchLaboratory::exact(const BenchTruth &truth) const {
  return rows_of(truth, std::vector<Specimen>(series_.size()));
}

ModelPoint BenchLaboratory::nominal() const {
  return {Eigen::VectorXd::Zero(rheology::base_count),
          Eigen::VectorXd::Zero(rheology::catalogue_count)};
}

BenchTruth BenchLaboratory::truth_at(const ModelPoint &point) const {
  static const rheology::Material nominal;
  BenchTruth truth;
  for (std::size_t i = 0; i < rheology::base_count; ++i)
    base(truth.material, i) = base(nominal, i) * std::exp(point.z(static_cast<Eigen::Index>(i)));
  for (std::size_t k = 0; k < rheology::catalogue_count; ++k)
    truth.effects.size[k] =
        point.amplitude(static_cast<Eigen::Index>(k)) * bench_catalogue()[k].switch_on;
  return truth;
}

Evidence BenchLaboratory::measure(const BenchTruth &truth, std::uint64_t seed,
                                  double stated_over_true) const {
  Evidence out = blank_;
  std::map<std::string, std::pair<double, double>> variance;  // sum of squares, dof
  for (std::size_t i = 0; i < series_.size(); ++i) {
    auto &evidence = out.series[i];
    RandomStream random(hash_ints({seed, static_cast<std::uint64_t>(series_[i].order)}), 9);
    evidence.replicates.resize(replicates_, evidence.count);
    const double added = rheology::added_strength_scatter(series_[i], truth.effects);
    Eigen::VectorXd row(evidence.count);
    int peak = 0;
    while (out.rows[static_cast<std::size_t>(evidence.first + peak)].part != CurvePart::peak)
      ++peak;
    for (int r = 0; r < replicates_; ++r) {
      auto curve = curve_of(series_[i], truth.material, truth.effects,
                            draw_specimen(random, scatter, 1, added));
      add_sensor_noise(curve, random, scatter);
      add_rows(curve, series_[i].kind, row.data());
      evidence.replicates.row(r) = row.transpose();
    }
    const auto column = evidence.replicates.col(peak);
    auto &sum = variance[evidence.test];
    sum.first += (column.array() - column.mean()).square().sum();
    sum.second += replicates_ - 1;
    evidence.stated *= stated_over_true * stated_over_true;
    evidence.shift *= stated_over_true * stated_over_true;
  }
  for (auto &evidence : out.scatter) {
    const auto &sum = variance[out.rows[static_cast<std::size_t>(evidence.row)].test];
    evidence.variance = sum.first / sum.second;
    evidence.stated *= stated_over_true * stated_over_true;
  }
  return out;
}

}  // namespace bondlab::diagnose
