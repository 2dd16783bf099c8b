// SPDX-License-Identifier: GPL-2.0-or-later
//
// fix gauge in the engine: exact under a homogeneous strain, kept through a restart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "fixes_deck.h"

namespace {

using namespace engine;

// The displacement field u = e X, put on the particles by atom-style variables.
std::string stretch(double ex, double ey, double ez) {
  const std::string x = std::to_string(1 + ex), y = std::to_string(1 + ey),
                    z = std::to_string(1 + ez);
  return "variable X atom x*" + x + "+0.001\nvariable Y atom y*" + y +
         "-0.002\nvariable Z atom z*" + z + "\nset group all x v_X y v_Y z v_Z\n";
}

const std::string columns =
    "fix curve all curve 1 curve.tsv axial 1 f_g[1] lateral 1 f_g[2] top 1 f_g[3] bottom 1 f_g[4] "
    "flank 1 f_g[5]\n";

// A column of touching spheres filling a cylinder of diameter 20 mm, height 40 mm about z.
std::vector<Particle> cylinder() {
  std::vector<Particle> all;
  for (const Particle &p : brick(12, 12, 1e-3))  // a plane lattice
    for (int k = 0; k < 20; ++k) {
      Particle q = p;
      q.y -= 0.01;
      q.z = 1e-3 * (1 + 2 * k) + 1e-5 * ((7 * k + int(1e6 * p.x)) % 11);
      if (std::hypot(q.x, q.y) < 9e-3) all.push_back(q);
    }
  return all;
}

// Particles of the outer shell between two heights, found without the code under test.
int shell_count(const std::vector<Particle> &all, double low, double high, double depth) {
  const auto extent = [&](auto place, auto wanted) {
    double lo = 1e9, hi = -1e9;
    for (const Particle &p : all)
      if (wanted(p)) lo = std::min(lo, place(p) - p.radius), hi = std::max(hi, place(p) + p.radius);
    return std::make_pair(lo, hi);
  };
  const auto ends =
      extent([](const Particle &p) { return p.z; }, [](const Particle &) { return true; });
  const auto in_section = [&](const Particle &p) {
    const double fraction = (p.z - ends.first) / (ends.second - ends.first);
    return fraction >= low && fraction <= high;
  };
  const auto ex = extent([](const Particle &p) { return p.x; }, in_section);
  const auto ey = extent([](const Particle &p) { return p.y; }, in_section);
  const auto off_axis = [&](const Particle &p) {
    return std::hypot(p.x - 0.5 * (ex.first + ex.second), p.y - 0.5 * (ey.first + ey.second));
  };
  const double surface = extent(off_axis, in_section).second;
  return static_cast<int>(std::count_if(all.begin(), all.end(), [&](const Particle &p) {
    return in_section(p) && off_axis(p) >= surface - depth;
  }));
}

TEST(FixGauge, ExactUnderHomogeneousStrainInThePlane) {
  EngineFolder folder;
  folder.write("particles.data", data_file(brick(10, 20, 1e-3), 2, 0.06));
  for (int ranks : {1, 2}) {
    const EngineResult r = run_deck(
        folder,
        few_particles(2, 1e-8) +
            "fix g all gauge axial y layers 0.25 0.75 thickness 4e-3 lateral x strip 3e-3\n" +
            stretch(2.5e-4, -1e-3, 0) + columns + "run 0\n",
        ranks);
    ASSERT_TRUE(r.ok()) << r.screen;
    const Table t = read_table(folder.file("curve.tsv"));
    EXPECT_NEAR(t.last("axial"), 1e-3, 1e-13) << ranks;  // rounding of 0.03 m over 0.02 m
    EXPECT_NEAR(t.last("lateral"), 2.5e-4, 1e-13) << ranks;
    EXPECT_GE(t.last("top"), 10);
    EXPECT_GE(t.last("bottom"), 10);
    EXPECT_GE(t.last("flank"), 10);
  }
}

TEST(FixGauge, ExactUnderHomogeneousStrainOfACylinder) {
  EngineFolder folder;
  const std::vector<Particle> particles = cylinder();
  folder.write("particles.data", data_file(particles, 3, 0.06));
  std::string one;
  for (int ranks : {1, 2, 4}) {
    const EngineResult r = run_deck(
        folder,
        few_particles(3, 1e-8) +
            "fix g all gauge axial z layers 0.2 0.8 thickness 4e-3 lateral radial strip 3e-3\n" +
            stretch(2.5e-4, 2.5e-4, -1e-3) + columns + "run 0\n",
        ranks);
    ASSERT_TRUE(r.ok()) << r.screen;
    const Table t = read_table(folder.file("curve.tsv"));
    EXPECT_NEAR(t.last("axial"), 1e-3, 1e-13);
    EXPECT_NEAR(t.last("lateral"), 2.5e-4, 1e-13);
    EXPECT_EQ(t.last("flank"), shell_count(particles, 0.2, 0.8, 3e-3));
    if (ranks == 1) one = folder.read("curve.tsv");
    EXPECT_EQ(folder.read("curve.tsv"), one) << ranks << " ranks";
  }
}

TEST(FixGauge, ExtentMayBeGiven) {
  EngineFolder folder;
  folder.write("particles.data", data_file(brick(10, 20, 1e-3), 2, 0.06));
  const auto count = [&](const std::string &extent) {
    const EngineResult r = run_deck(
        folder, few_particles(2, 1e-8) +
                    "fix g all gauge axial y layers 0.25 0.75 thickness 2e-3 " + extent +
                    "\nfix curve all curve 1 curve.tsv top 1 f_g[3] bottom 1 f_g[4]\nrun 0\n");
    EXPECT_TRUE(r.ok()) << r.screen;
    const Table t = read_table(folder.file("curve.tsv"));
    return t.last("top") + 1000 * t.last("bottom");
  };
  // Rows of 10 are at y = 1, 2.73, 4.46 ... mm, the last at 33.9; the surface is 1 mm beyond.
  EXPECT_EQ(count("extent -0.0004 0.0076"), 10 + 1000 * 10);  // at 1.6 and 5.6 mm: one row each
  EXPECT_EQ(count(""), 20 + 1000 * 20);                       // at 8.7 and 26.2 mm: two
  EXPECT_EQ(count("extent 0 0.0349"), 20 + 1000 * 20);
}

TEST(FixGauge, KeepsItsLayersThroughARestart) {
  // The lowest rows are lost before the restart; a gauge that looked again would find another
  // extent.
  EngineFolder folder;
  folder.write("particles.data", data_file(brick(10, 20, 1e-3), 2, 0.06));
  const std::string gauge =
      "fix g all gauge axial y layers 0.25 0.75 thickness 4e-3 lateral x strip 3e-3\n";
  EngineResult r =
      run_deck(folder, few_particles(2, 1e-8) + gauge + stretch(2.5e-4, -1e-3, 0) + columns +
                           "run 0\ngroup end id 1:30\n"
                           "delete_atoms group end compress no\n"
                           "write_restart a.restart\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  const Table before = read_table(folder.file("curve.tsv"));
  const std::string restart =
      "newton off\nread_restart a.restart\nneighbor 0.001 bin\npair_style grain\n"
      "pair_coeff * * 1e9 2 0.5\n";
  r = run_deck(folder, restart + gauge + columns + "run 0\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_EQ(before.rows, read_table(folder.file("curve.tsv")).rows);
  // Under another name it does look again.
  r = run_deck(folder, restart + "fix h" + gauge.substr(5) +
                           "fix curve all curve 1 curve.tsv flank 1 "
                           "f_h[5] axial 1 f_h[1]\nrun 0\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_NEAR(read_table(folder.file("curve.tsv")).last("axial"), 1e-3, 1e-13);
  EXPECT_NE(read_table(folder.file("curve.tsv")).last("flank"), before.last("flank"));
}

TEST(FixGauge, AnEmptyLayerIsAnError) {
  EngineFolder folder;
  folder.write("particles.data", data_file(brick(10, 20, 1e-3), 2, 0.06));
  EngineResult r =
      run_deck(folder, few_particles(2, 1e-8) +
                           "fix g all gauge axial y layers 0.25 0.75 thickness 1e-7\nrun 0\n");
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("Fix gauge (id g): no particle of the group is in the")) << r.screen;
  r = run_deck(folder, few_particles(2, 1e-8) +
                           "fix g all gauge axial y layers 0.25 0.75 thickness 4e-3 "
                           "lateral x strip 1e-7\nrun 0\n");
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("in the flanks")) << r.screen;
}

}  // namespace
