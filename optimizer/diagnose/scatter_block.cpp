// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/scatter_block.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace bondlab::diagnose {

namespace {

constexpr int draws = 2000;
constexpr Eigen::Index least_packings = 8;

// A strength in one series.
struct Strength {
  std::string test;
  Eigen::VectorXd specimens, packings;  // about their means
  double sensors = 0;                   // variance
};

double variance_of(const Eigen::VectorXd &sample) {
  return (sample.array() - sample.mean()).square().sum() /
         static_cast<double>(std::max<Eigen::Index>(1, sample.size() - 1));
}

std::vector<Strength> strengths_of(const Study &study, const std::vector<MeasuredSeries> &series,
                                   const Eigen::MatrixXd &by_packing) {
  std::vector<Strength> out;
  Eigen::Index first = 0;
  for (const auto &s : series) {
    const auto &quantities = s.probed.quantities;
    const auto peak = std::find_if(quantities.begin(), quantities.end(),
                                   [](const auto &q) { return q.part == CurvePart::peak; });
    const auto j = static_cast<Eigen::Index>(peak - quantities.begin());
    const Eigen::Index row = first + j;
    first += static_cast<Eigen::Index>(quantities.size());
    if (peak == quantities.end() || s.stated.size() > 0 || s.replicates.rows() < 2) continue;
    std::vector<double> known;
    for (Eigen::Index p = 0; p < by_packing.rows(); ++p)
      if (std::isfinite(by_packing(p, row))) known.push_back(by_packing(p, row));
    Strength one;
    one.test = study.test(s.probed.test).definition.name;
    one.specimens = s.replicates.col(j).array() - s.replicates.col(j).mean();
    one.packings =
        Eigen::Map<Eigen::VectorXd>(known.data(), static_cast<Eigen::Index>(known.size()));
    if (one.packings.size() < least_packings || !(variance_of(one.packings) > 0)) continue;
    one.packings.array() -= one.packings.mean();
    one.sensors = s.sensors.size() > 0 ? s.sensors(j) : 0;
    out.push_back(std::move(one));
  }
  return out;
}

// Of specimens over packings and sensors; the variance of few packings is large in its inverse.
double ratio_of(const Strength &s) {
  const auto dof = static_cast<double>(s.packings.size()) - 1;
  return variance_of(s.specimens) / (variance_of(s.packings) + s.sensors) * (dof - 2) / dof;
}

// All packings' deviations in their series' sd: forty of one series know little of its tail.
std::vector<double> shape_of(const std::vector<Strength> &strengths) {
  std::vector<double> out;
  for (const auto &s : strengths)
    for (const double x : s.packings) out.push_back(x / std::sqrt(variance_of(s.packings)));
  return out;
}

Strength drawn(const Strength &s, const std::vector<double> &shape, RandomStream &random) {
  Strength out = s;
  const double sd = std::sqrt(variance_of(s.packings));
  const auto any = [&] { return sd * shape[random.index(shape.size())]; };
  for (auto &x : out.packings) x = any();
  for (auto &x : out.specimens) x = any() + std::sqrt(s.sensors) * random.normal();
  return out;
}

// Two-sided, of `x` among `sorted`.
double rank_p(const std::vector<double> &sorted, double x) {
  const auto count = static_cast<double>(sorted.size());
  const auto below =
      static_cast<double>(std::lower_bound(sorted.begin(), sorted.end(), x) - sorted.begin());
  const auto above =
      static_cast<double>(sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), x));
  return std::min(1.0, 2 * (std::min(count - below, count - above) + 1) / (count + 1));
}

}  // namespace

const ScatterBlock *ScatterTest::worst() const {
  const auto it =
      std::min_element(blocks.begin(), blocks.end(),
                       [](const ScatterBlock &a, const ScatterBlock &b) { return a.p < b.p; });
  return it == blocks.end() ? nullptr : &*it;
}

ScatterTest scatter_test(const Study &study, const std::vector<MeasuredSeries> &series,
                         const Eigen::MatrixXd &by_packing, std::uint64_t seed) {
  const auto strengths = strengths_of(study, series, by_packing);
  std::vector<std::string> names;
  for (const auto &s : strengths)
    if (std::find(names.begin(), names.end(), s.test) == names.end()) names.push_back(s.test);
  if (names.size() > 1) names.push_back("all tests");
  const auto ratios = [&](const std::vector<Strength> &list) {
    std::vector<double> sum(names.size(), 0), dof(names.size(), 0);
    for (const auto &s : list) {
      const auto weight = static_cast<double>(s.specimens.size()) - 1;
      const double ratio = ratio_of(s);
      for (std::size_t b = 0; b < names.size(); ++b)
        if (names[b] == s.test || names[b] == "all tests")
          sum[b] += weight * ratio, dof[b] += weight;
    }
    for (std::size_t b = 0; b < names.size(); ++b) sum[b] /= dof[b];
    return sum;
  };
  ScatterTest out;
  if (names.empty()) return out;
  RandomStream random(seed, 61);
  const auto shape = shape_of(strengths);
  std::vector<std::vector<double>> null(draws);
  std::vector<std::vector<double>> sorted(names.size());
  for (auto &draw : null) {
    std::vector<Strength> list;
    for (const auto &s : strengths) list.push_back(drawn(s, shape, random));
    draw = ratios(list);
    for (std::size_t b = 0; b < names.size(); ++b) sorted[b].push_back(draw[b]);
  }
  for (auto &one : sorted) std::sort(one.begin(), one.end());
  const auto least_p = [&](const std::vector<double> &found) {
    double p = 1;
    for (std::size_t b = 0; b < names.size(); ++b) p = std::min(p, rank_p(sorted[b], found[b]));
    return p;
  };
  const auto found = ratios(strengths);
  for (std::size_t b = 0; b < names.size(); ++b)
    out.blocks.push_back({names[b] + ", scatter", found[b], rank_p(sorted[b], found[b])});
  const double p = least_p(found);
  const auto as_small =
      std::count_if(null.begin(), null.end(), [&](const auto &draw) { return least_p(draw) <= p; });
  out.p = static_cast<double>(as_small + 1) / (draws + 1);
  return out;
}

}  // namespace bondlab::diagnose
