// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/noise_floor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "design/latin_hypercube.h"
#include "refine/emulator_for_tests.h"

namespace bondlab {
namespace {

using testing::granite_study;
using testing::GraniteEmulator;

struct Bench {
  Study study = granite_study();
  GraniteEmulator model;
  ParameterSpace space{study.parameters};
  Evaluator evaluator{study, space, model};

  // With a design run before, as in a fit, so that slopes are known.
  NoiseFloor measure(int repeats, const std::vector<double> &u = {0.4, 0.5, 0.6}) {
    std::vector<TransformedPoint> design;
    for (const auto &v : latin_hypercube(12, 3, 1))
      design.push_back(space.to_transformed(space.from_unit_cube(v)));
    const auto centre = space.to_transformed(space.from_unit_cube(u));
    design.push_back(centre);
    evaluator.run(design, {0, 1, 2, 3}, "design");
    return measure_noise(evaluator, {0, 1, 2, 3}, centre, repeats, 1);
  }
};

TEST(NoiseFloor, FindsThePlantedNoise) {
  Bench bench;
  bench.model.noise_elastic = 1e-3;
  bench.model.noise_strength = 0.02;
  const auto floor = bench.measure(80);
  const double planted[] = {1e-3, 1e-3, 0.02, 0.02};
  for (std::size_t t = 0; t < 4; ++t) {
    const double relative = floor.sd[t] / bench.study.targets[t].value;
    EXPECT_NEAR(relative / planted[t], 1, 0.25)
        << bench.study.targets[t].name;  // 3 sd of a sd from 80 repeats
  }
  EXPECT_TRUE(floor.notes.empty());
}

TEST(NoiseFloor, SmoothModelHasNoneThoughTheParametersAreMoved) {
  Bench bench;
  const auto floor = bench.measure(4);
  for (std::size_t t = 0; t < 4; ++t) EXPECT_LT(floor.sd[t] / bench.study.targets[t].value, 1e-6);
}

TEST(NoiseFloor, IsForAFigureOfTheMeasuredSize) {
  // Twice the measured strength at the centre, the same share of noise: the sd is that of the
  // measured strength.
  Bench bench;
  bench.model.noise_strength = 0.02;
  const auto floor = bench.measure(80, {0.4, 0.5, 0.95});
  EXPECT_NEAR(floor.sd[3] / bench.study.targets[3].value / 0.02, 1, 0.25);
}

TEST(NoiseFloor, TooFewFiguresLeaveItUnknownWithANote) {
  Bench bench;
  bench.study.options.max_failed = 100;
  bench.model.fail = [](const ForwardRequest &request) {
    return request.test == "brazilian" ? FailureCause::timeout : FailureCause::none;
  };
  const auto floor = bench.measure(4);
  EXPECT_FALSE(std::isnan(floor.sd[2]));
  EXPECT_TRUE(std::isnan(floor.sd[3]));
  ASSERT_EQ(floor.notes.size(), 1u);
  EXPECT_NE(floor.notes[0].find("noise of sigma_t is not known"), std::string::npos);
}

TEST(NoiseFloor, PointsStayNearTheCentreAndInsideTheBounds) {
  const Study study = granite_study();
  const ParameterSpace space{study.parameters};
  for (const double u : {0.5, 0.001, 0.999}) {
    const auto centre = space.to_transformed(space.from_unit_cube({u, u, u}));
    const auto x = space.to_physical(centre).x;
    for (const auto &point : noise_points(space, centre, noise_wiggle, 20, 3)) {
      const auto y = space.to_physical(point).x;
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LE(std::fabs(y[k] / x[k] - 1), 1.1 * noise_wiggle);
        EXPECT_NE(y[k], x[k]);
        EXPECT_GT(y[k], study.parameters[k].lower);
        EXPECT_LT(y[k], study.parameters[k].upper);
      }
    }
  }
}

}  // namespace
}  // namespace bondlab
