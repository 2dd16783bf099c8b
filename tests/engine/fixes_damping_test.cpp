// SPDX-License-Identifier: GPL-2.0-or-later
//
// fix damp/local in the engine, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "fixes_deck.h"

namespace {

using namespace engine;

const double pi = std::acos(-1.0);

TEST(FixDampLocal, ConstantForceSpeedsUpLessAndSlowsDownMore) {
  // Particle 1 is thrown up against gravity, particle 2 falls from rest; alpha 0.4, g 10 m/s2.
  EngineFolder folder;
  folder.write("particles.data", data_file({{-0.005, 0, 0}, {0.005, 0, 0}}, 3, 0.02));
  const double g = 10, alpha = 0.4, dt = 1e-5, thrown = 0.1;
  const EngineResult r = run_deck(
      folder, few_particles(3, dt) +
                  "set atom 1 vy 0.1\nfix move all nve/bonded\n"
                  "fix g all gravity 10 vector 0 -1 0\nfix damp all damp/local 0.4\n"
                  "variable up equal vy[1]\nvariable down equal vy[2]\n"
                  "fix curve all curve 1 curve.tsv up m/s v_up down m/s v_down\nrun 600\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  const Table t = read_table(folder.file("curve.tsv"));
  const auto time = t.column("time"), up = t.column("up"), down = t.column("down");
  for (std::size_t k = 0; k < time.size(); ++k) {
    ASSERT_NEAR(up[k], thrown - (1 + alpha) * g * time[k], 1e-12) << k;
    // At rest there is no damping: the first half step of the falling one is undamped.
    const double first = k == 0 ? 0.0 : alpha * g * 0.5 * dt;
    ASSERT_NEAR(down[k], -(1 - alpha) * g * time[k] - first, 1e-12) << k;
  }
  EXPECT_GT(up.back(), 0.0);  // it was slowing down all the time
}

TEST(FixDampLocal, OscillatorDecaysAsTheClosedForm) {
  // A sphere between two platens: amplitude sqrt((1-alpha)/(1+alpha)) each half cycle.
  EngineFolder folder;
  const double offset = 1e-5, alpha = 0.3, dt = 2e-9;
  folder.write("particles.data", data_file({{0, offset, 0}}, 3, 0.01));
  const EngineResult r =
      run_deck(folder, few_particles(3, dt) +
                           "fix move all nve/bonded\n"
                           "fix p all platen plane 0 -0.9e-3 0 0 1 0 modulus 1e9\n"
                           "fix q all platen plane 0 0.9e-3 0 0 -1 0 modulus 1e9\n"
                           "fix damp all damp/local 0.3\nvariable y equal xcm(all,y)\n"
                           "fix curve all curve 5 curve.tsv y m v_y\nrun 30000\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  const auto y = read_table(folder.file("curve.tsv")).column("y");
  std::vector<double> peaks;
  for (std::size_t k = 1; k + 1 < y.size(); ++k)
    if ((y[k] - y[k - 1]) * (y[k + 1] - y[k]) < 0) peaks.push_back(std::fabs(y[k]));
  ASSERT_GE(peaks.size(), 8u);
  const double ratio = std::sqrt((1 - alpha) / (1 + alpha));
  // A turning point is found within one sample of about 1,000 a half cycle: (pi/1000)^2/8.
  for (std::size_t k = 0; k < 8; ++k)
    EXPECT_NEAR(peaks[k] / offset / std::pow(ratio, k + 1), 1.0, 2e-5) << k;
  // As a viscous damping ratio: atanh(alpha)/pi, alpha/pi for small alpha.
  EXPECT_NEAR(-std::log(peaks[1] / offset) / (2 * pi), std::atanh(alpha) / pi, 1e-4);
}

TEST(FixDampLocal, ActsOnSpinAndOnItsGroupOnly) {
  // Two spheres on a sliding platen: friction turns them; only the second is damped.
  EngineFolder folder;
  folder.write("particles.data",
               data_file({{-0.005, 1e-3 - 1e-6, 0}, {0.005, 1e-3 - 1e-6, 0}}, 3, 0.02));
  const EngineResult r =
      run_deck(folder, few_particles(3, 1e-8) +
                           "group second id 2\nfix move all nve/bonded\n"
                           "fix q all platen plane 0 1.998e-3 0 0 -1 0 modulus 1e9\n"
                           "fix p all platen plane 0 0 0 0 1 0 modulus 1e9 ratio 2 friction 0.01 "
                           "velocity 0.1 0 0\nfix damp second damp/local 0.5\n"
                           "variable w1 equal omegaz[1]\nvariable w2 equal omegaz[2]\n"
                           "fix curve all curve 1 curve.tsv w1 1/s v_w1 w2 1/s v_w2\nrun 400\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  const Table t = read_table(folder.file("curve.tsv"));
  // Sliding friction is a constant torque; sticking at the start is over in a few steps.
  const auto w1 = t.column("w1"), w2 = t.column("w2");
  const double rate1 = w1[400] - w1[100], rate2 = w2[400] - w2[100];
  EXPECT_GT(std::fabs(rate1), 0.0);
  EXPECT_NEAR(rate2 / rate1, 0.5, 1e-3);
}

TEST(FixDampLocal, MustComeAfterFixesThatAddForces) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0, 0}}, 3, 0.01));
  EngineResult r =
      run_deck(folder, few_particles(3, 1e-8) +
                           "fix damp all damp/local 0.7\n"
                           "fix late all platen plane 0 -0.005 0 0 1 0 modulus 1e9\nrun 1\n");
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("Fix damp/local (id damp): must come after fix platen (id late)")) << r.screen;
  r = run_deck(folder, few_particles(3, 1e-8) +
                           "group a id 1\nfix damp a damp/local 0.7\n"
                           "fix other all damp/local 0.1\nrun 1\n");
  EXPECT_TRUE(r.ok()) << r.screen;  // two of them may follow each other
}

}  // namespace
