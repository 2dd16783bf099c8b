// SPDX-License-Identifier: GPL-2.0-or-later
#include "design/latin_hypercube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/random.h"

namespace bondlab {

namespace {

constexpr std::uint64_t design_stream = 0xde5;
constexpr int exchanges_per_point = 400;

double squared_distance(const std::vector<double> &a, const std::vector<double> &b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

// Sum of d^-15 over the pairs that contain one of two points: all that an exchange between them
// changes. The power is high enough that the closest pair rules the sum, as in a maximin design.
double crowding(const std::vector<std::vector<double>> &points, std::size_t a, std::size_t b) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i != a) sum += std::pow(squared_distance(points[i], points[a]), -7.5);
    if (i != b && i != a) sum += std::pow(squared_distance(points[i], points[b]), -7.5);
  }
  return sum;
}

}  // namespace

std::vector<std::vector<double>> latin_hypercube(int points, int dimensions, std::uint64_t seed) {
  const std::size_t n = points > 0 ? static_cast<std::size_t>(points) : 0;
  const std::size_t d = dimensions > 0 ? static_cast<std::size_t>(dimensions) : 0;
  std::vector<std::vector<double>> design(n, std::vector<double>(d));
  RandomStream random(seed, design_stream);
  std::vector<std::size_t> order(n);
  for (std::size_t k = 0; k < d; ++k) {
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    random.shuffle(order);
    for (std::size_t i = 0; i < n; ++i)
      design[i][k] = (static_cast<double>(order[i]) + random.uniform()) / static_cast<double>(n);
  }
  if (n < 3 || d < 2) return design;  // nothing to gain by exchange

  for (std::size_t trial = 0; trial < n * exchanges_per_point; ++trial) {
    const std::size_t a = random.index(n), b = random.index(n), k = random.index(d);
    if (a == b) continue;
    const double before = crowding(design, a, b);
    std::swap(design[a][k], design[b][k]);
    if (crowding(design, a, b) >= before) std::swap(design[a][k], design[b][k]);
  }
  return design;
}

double smallest_distance(const std::vector<std::vector<double>> &points) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      smallest = std::min(smallest, squared_distance(points[i], points[j]));
  return std::sqrt(smallest);
}

}  // namespace bondlab
