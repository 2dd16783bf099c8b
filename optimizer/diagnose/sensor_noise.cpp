// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/sensor_noise.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace bondlab::diagnose {

namespace {

constexpr std::size_t least_points = 20;
constexpr double like_noise = -0.55;  // correlation of neighbouring second differences
constexpr double median_of_normal = 0.6745;
constexpr int draws = 12;  // a curve

}  // namespace

double white_noise(const std::vector<double> &column) {
  if (column.size() < least_points) return 0;
  std::vector<double> second;
  for (std::size_t i = 1; i + 1 < column.size(); ++i)
    second.push_back(column[i - 1] - 2 * column[i] + column[i + 1]);
  std::vector<double> sizes;
  for (const double d : second) sizes.push_back(std::abs(d));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double sd = *middle / (median_of_normal * std::sqrt(6.0));
  if (!(sd > 0)) return 0;
  // A jump is no noise: it counts no more than the largest noise.
  double product = 0, square = 0, before = 0;
  for (std::size_t i = 0; i < second.size(); ++i) {
    const double most = 3 * std::sqrt(6.0) * sd, now = std::clamp(second[i], -most, most);
    if (i > 0) product += before * now;
    square += now * now;
    before = now;
  }
  return product < like_noise * square ? sd : 0;
}

Eigen::VectorXd sensor_variance(const std::vector<Curve> &replicates,
                                const std::vector<CurveQuantity> &quantities,
                                const TestDefinition &test,
                                const std::map<std::string, double> &variables,
                                std::uint64_t seed) {
  const auto rows = static_cast<Eigen::Index>(quantities.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(rows), counted = out;
  RandomStream random(seed, 51);
  for (const auto &replicate : replicates) {
    std::vector<double> sd;
    for (const auto &column : replicate.columns) sd.push_back(white_noise(column));
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
