// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "base/random.h"

namespace bondlab::diagnose {

namespace {

constexpr std::size_t least_points = 20;
constexpr double like_noise = -0.55;  // correlation of neighbouring second differences
constexpr double median_of_normal = 0.6745;
constexpr int draws = 12;  // a curve

}  // namespace

std::vector<double> white_noise(const std::vector<std::vector<double>> &columns) {
  std::vector<double> out(columns.size(), 0);
  double product = 0, square = 0;  // of all together: one curve's correlation is uncertain by 0.1
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto &column = columns[k];
    if (column.size() < least_points) continue;
    std::vector<double> second;
    for (std::size_t i = 1; i + 1 < column.size(); ++i)
      second.push_back(column[i - 1] - 2 * column[i] + column[i + 1]);
    std::vector<double> sizes;
    for (const double d : second) sizes.push_back(std::abs(d));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double sd = *middle / (median_of_normal * std::sqrt(6.0));
    if (!(sd > 0)) continue;
    out[k] = sd;
    // A jump is no noise: pairs with one tell nothing.
    const double most = 2.5 * std::sqrt(6.0) * sd;
    for (std::size_t i = 1; i < second.size(); ++i) {
      const double before = second[i - 1] / sd, now = second[i] / sd;
      if (std::max(std::abs(before), std::abs(now)) * sd > most) continue;
      product += before * now;
      square += 0.5 * (before * before + now * now);
    }
  }
  if (square > 0 && product < like_noise * square) return out;
  return std::vector<double>(columns.size(), 0);
}

Eigen::VectorXd sensor_variance(const std::vector<Curve> &replicates,
                                const std::vector<CurveQuantity> &quantities,
                                const TestDefinition &test,
                                const std::map<std::string, double> &variables,
                                std::uint64_t seed) {
  const auto rows = static_cast<Eigen::Index>(quantities.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(rows), counted = out;
  RandomStream random(seed, 51);
  std::map<std::string, std::vector<double>> noise;  // sd by channel, one a replicate
  for (const auto &name : replicates.front().names) {
    std::vector<std::vector<double>> columns;
    for (const auto &replicate : replicates)
      columns.push_back(replicate.has(name) ? replicate.column(name) : std::vector<double>());
    noise[name] = white_noise(columns);
  }
  for (std::size_t r = 0; r < replicates.size(); ++r) {
    const Curve &replicate = replicates[r];
    std::vector<double> sd;
    for (const auto &name : replicate.names)
      sd.push_back(noise.count(name) > 0 ? noise.at(name)[r] : 0);
    if (std::all_of(sd.begin(), sd.end(), [](double s) { return s == 0; })) {
      counted.array() += 1;
      continue;
    }
    Eigen::MatrixXd drawn(draws, rows);
    for (int i = 0; i < draws; ++i) {
      Curve curve = replicate;
      for (std::size_t c = 0; c < sd.size(); ++c)
        for (double &value : curve.columns[c]) value += sd[c] * random.normal();
      drawn.row(i) = rows_of_curve(curve, quantities, test, variables).transpose();
    }
    for (Eigen::Index row = 0; row < rows; ++row) {
      double sum = 0, square = 0;
      int known = 0;
      for (int i = 0; i < draws; ++i)
        if (std::isfinite(drawn(i, row)))
          sum += drawn(i, row), square += drawn(i, row) * drawn(i, row), ++known;
      if (2 * known < draws) continue;
      out(row) += (square - sum * sum / known) / (known - 1);
      counted(row) += 1;
    }
  }
  for (Eigen::Index row = 0; row < rows; ++row)
    out(row) = counted(row) > 0 ? std::max(0.0, out(row) / counted(row)) : 0;
  return out;
}

}  // namespace bondlab::diagnose
