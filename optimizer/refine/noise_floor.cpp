// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/noise_floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "refine/response_model.h"

namespace bondlab {

namespace {

constexpr std::uint64_t noise_stream = 0x401;
constexpr double largest_z_change = 0.2;  // near a bound a relative change would need a leap in z

}  // namespace

std::vector<TransformedPoint> noise_points(const ParameterSpace &space,
                                           const TransformedPoint &centre, double wiggle,
                                           int repeats, std::uint64_t seed) {
  RandomStream random(seed, noise_stream);
  const auto physical = space.to_physical(centre);
  std::vector<TransformedPoint> points;
  for (int r = 0; r < repeats; ++r) {
    auto point = centre;
    for (std::size_t k = 0; k < space.n(); ++k) {
      const double change = wiggle * std::fabs(physical.x[k]) / space.dx_dz(k, centre.z[k]);
      point.z[k] += random.uniform(-1, 1) * std::min(change, largest_z_change);
    }
    points.push_back(std::move(point));
  }
  return points;
}

NoiseFloor measure_noise(Evaluator &evaluator, const TargetIndices &targets,
                         const TransformedPoint &centre, int repeats, std::uint64_t seed) {
  const auto &space = evaluator.space();
  auto points = noise_points(space, centre, noise_wiggle, repeats, seed);
  evaluator.run(points, targets, "noise");
  points.push_back(centre);

  NoiseFloor floor;
  floor.sd.assign(evaluator.study().targets.size(), std::numeric_limits<double>::quiet_NaN());
  for (const std::size_t target : targets) {
    std::vector<double> all;
    for (const auto &point : evaluator.points())
      all.push_back(evaluator.value(point, target).value);
    const auto model =
        ResponseModel::fit(space, evaluator.points(), all, std::vector<double>(all.size(), 1.0));

    std::vector<double> left;  // figures with the explained part taken off
    for (const auto &point : points) {
      const auto figure = evaluator.value(point, target);
      if (!figure.had()) continue;
      left.push_back(figure.value - (model ? model->value(point) - model->value(centre) : 0.0));
    }
    const std::string &name = evaluator.study().targets[target].name;
    if (left.size() < 3) {
      floor.notes.push_back(
          fmt::format("the noise of {} is not known: {} of {} repeats gave a figure", name,
                      left.size(), points.size()));
      continue;
    }
    double mean = 0, sum = 0;
    for (const double figure : left) mean += figure / static_cast<double>(left.size());
    for (const double figure : left) sum += (figure - mean) * (figure - mean);
    const double measured = evaluator.study().targets[target].value;
    // Scatter of strengths goes with the strength: what is wanted is the noise where the fit is to
    // arrive.
    const double scale = mean * measured > 0 ? measured / mean : 1.0;
    floor.sd[target] = scale * std::sqrt(sum / static_cast<double>(left.size() - 1));
  }
  return floor;
}

}  // namespace bondlab
