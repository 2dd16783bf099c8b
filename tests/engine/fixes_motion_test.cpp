// SPDX-License-Identifier: GPL-2.0-or-later
//
// Motion of platens and grips in the engine: free bodies, loading frames, drives, glued particles;
// against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixes_deck.h"

namespace {

using namespace engine;

const double pi = std::acos(-1.0);
constexpr double radius = 1e-3, modulus = 1e9;
const double stiffness = 4 * radius * modulus;  // of one sphere against a platen, N/m

Table run_one(const EngineFolder &folder, const std::string &deck, int ranks = 1) {
  const EngineResult r = run_deck(folder, deck, ranks);
  EXPECT_TRUE(r.ok()) << r.screen;
  return read_table(folder.file("curve.tsv"));
}

// A sphere that is held; the platen comes from above.
std::string above(const std::string &motion) {
  return "fix p all platen plane 0 2e-3 0 0 -1 0 touch modulus 1e9 " + motion + "\n";
}
const std::string kColumns =
    "fix curve all curve 1 curve.tsv force N f_p[2] d m f_p[8] v m/s f_p[11] side m f_p[7]\n";

TEST(FixMotion, AFreeBodyBouncesInHalfAPeriodWithItsSpeedTurnedRound) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0, 0}}, 3, 0.01));
  const double mass = 1e-3, speed = 0.5, omega = std::sqrt(stiffness / mass), dt = 2e-7;
  const int contact = static_cast<int>(pi / omega / dt);
  const Table t = run_one(
      folder, few_particles(3, dt) + above("free 1e-3 y velocity 0 -0.5 0") + kColumns + "run " +
                  std::to_string(contact + 100) + "\n");
  const auto d = t.column("d"), force = t.column("force");
  for (int k = 0; k < contact; ++k) {
    // what velocity Verlet makes of it, exactly
    const double turn = 2 * std::asin(0.5 * omega * dt);
    ASSERT_NEAR(d[k], -speed * dt / std::sin(turn) * std::sin(turn * k), 1e-9 * speed / omega) << k;
    ASSERT_NEAR(force[k], -stiffness * std::fmin(0.0, d[k]), 1e-9 * stiffness * speed / omega);
  }
  EXPECT_NEAR(t.last("v"), speed, 1e-4 * speed);  // the last step of contact is cut off
  EXPECT_EQ(t.last("force"), 0.0);
}

TEST(FixMotion, AFrameCompressesByItsForceOverItsStiffness) {
  // Sphere and frame in series: the platen goes K/(K + k) of the drive's way.
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0, 0}}, 3, 0.01));
  const double frame = 0.25 * stiffness;
  const Table t =
      run_one(folder, few_particles(3, 2e-7) +
                          "fix loading all drive speed 0.01 ramp 2e-3 at 2e-5 end\n" +
                          above("follow loading 0 -1 0 frame " + number(frame) + " mass 1e-3") +
                          "fix curve all curve 10 curve.tsv force N f_p[2] d m f_p[8] v m/s f_p[11] "
                          "drive m f_loading[1]\nrun 40000\n");
  const double drive = t.last("drive");
  EXPECT_NEAR(drive, 2e-5 + 0.01 * 1e-3, 0.01 * 4e-7);
  EXPECT_NEAR(t.last("d"), -drive * frame / (frame + stiffness), 1e-9 * drive);
  EXPECT_NEAR(t.last("force"), drive * frame * stiffness / (frame + stiffness),
              1e-9 * drive * stiffness);
}

TEST(FixMotion, AFrameThatTheTimeStepCannotFollowIsAnError) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0, 0}}, 3, 0.01));
  const EngineResult r = run_deck(
      folder, few_particles(3, 2e-7) + above("velocity 0 -1 0 frame 1e9 mass 1e-6") + "run 1\n");
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("give a larger mass")) << r.screen;
}

TEST(FixMotion, AGuidedBodyMovesAlongItsGuideOnly) {
  // The sphere is hit off its top: the push has a sideways part.
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0, 0}}, 3, 0.01));
  const Table t = run_one(folder, few_particles(3, 2e-7) +
                                      "fix p all platen sphere 1e-3 2.2e-3 0 1e-3 outside modulus "
                                      "1e9 free 1e-3 y velocity 0 -0.5 0\n" +
                                      kColumns + "run 8000\n");
  const auto side = t.column("side"), force = t.column("force");
  EXPECT_GT(*std::max_element(force.begin(), force.end()), 0.0);
  for (double s : side) ASSERT_EQ(s, 0.0);
}

// Four bonded spheres in a row along y; the first two and the last two are gripped.
std::vector<Particle> row() {
  std::vector<Particle> spheres;
  for (int k = 0; k < 4; ++k) spheres.push_back({0, 2 * radius * k, 0});
  return spheres;
}

std::string gripped_row(const std::string &motion) {
  return "units si\ndimension 3\nboundary f f f\nnewton off\natom_style bonded/sphere\n"
         "communicate single vel yes\nbond_style parallel\npair_style grain\n"
         "read_data particles.data\nneighbor 0.0005 bin\npair_coeff * * 0 2 0.5\n"
         "bond_coeff 1 1e9 2 1e12 1e12\nbond_install all gap 1e-5\ntimestep 1e-7\n"
         "region up block INF INF 3e-3 INF INF INF\ngroup up region up\n"
         "group down subtract all up\n"
         "fix low down grip at_rest\nfix high up grip " +
         motion +
         "\nfix move all nve/bonded\nfix damp all damp/local 0.5\n"
         "fix curve all curve 10 curve.tsv high N f_high[2] low N f_low[2] side N f_high[1] moment "
         "Nm f_high[6] low_moment Nm f_low[6] d m f_high[8] x m f_high[7]\n";
}

TEST(FixGrip, PullsOneBondByItsStiffnessTimesTheStretch) {
  EngineFolder folder;
  folder.write("particles.data", data_file(row(), 3, 0.01));
  const Table t = run_one(folder, gripped_row("velocity 0 1e-3 0 ramp 1e-4") + "run 10000\n");
  // one bond between the blocks: k = E A / l, with l = 2 R
  const double bond = 1e9 * pi * radius * radius / (2 * radius);
  const auto d = t.column("d"), high = t.column("high"), low = t.column("low");
  for (std::size_t k = 0; k < d.size(); ++k) {
    ASSERT_NEAR(high[k], -bond * d[k], 1e-8 * bond * d.back()) << k;
    ASSERT_NEAR(low[k], -high[k], 1e-12 * bond * d.back());
  }
  EXPECT_NEAR(d.back(), 1e-3 * (1e-3 - 0.5e-4), 1e-12);
}

TEST(FixGrip, ShearedBlocksBalanceForceAndMoment) {
  // Moment of the couple of shear forces: F times the distance 4 R of the blocks' centres.
  EngineFolder folder;
  folder.write("particles.data", data_file(row(), 3, 0.01));
  const Table t = run_one(folder, gripped_row("velocity 1e-3 0 0 ramp 1e-4") + "run 10000\n");
  const double side = t.last("side");
  EXPECT_LT(side, 0.0);
  EXPECT_NEAR(t.last("moment") + t.last("low_moment"), -4 * radius * side * -1.0,
              1e-3 * std::fabs(4 * radius * side));
}

TEST(FixGrip, HoldsAForceByServo) {
  EngineFolder folder;
  folder.write("particles.data", data_file(row(), 3, 0.01));
  const Table t = run_one(folder, gripped_row("servo fy -3 gain 1e-2 vmax 0.01") + "run 40000\n");
  const double bond = 1e9 * pi * radius * radius / (2 * radius);
  EXPECT_NEAR(t.last("high"), -3.0, 1e-6);
  EXPECT_NEAR(t.last("d"), 3.0 / bond, 1e-6 * 3.0 / bond);
}

TEST(FixGrip, SameBitsOnOneAndTwoRanks) {
  std::string one;
  for (const int ranks : {1, 2}) {
    EngineFolder folder;
    folder.write("particles.data", data_file(row(), 3, 0.01));
    run_one(folder, "processors 1 " + std::to_string(ranks) + " 1\n" +
                        gripped_row("velocity 1e-3 2e-3 5e-4 ramp 1e-4") + "run 5000\n",
            ranks);
    if (ranks == 1) one = folder.read("curve.tsv");
    EXPECT_EQ(folder.read("curve.tsv"), one);
  }
}

TEST(FixMotion, RunInPiecesEqualsOneRun) {
  // Set-up between runs must not move a servo, a frame or a drive.
  std::string whole;
  for (const std::string run : {"run 3000\n", "run 1000\nrun 2000\n"}) {
    EngineFolder folder;
    folder.write("particles.data", data_file({{0, 0, 0}}, 3, 0.01));
    run_one(folder, few_particles(3, 2e-7) +
                        "variable load equal f_p[2]\n"
                        "fix loading all drive speed 0.1 ramp 1e-4 load v_load at_load 20 unload "
                        "0.5 at 1e-5 hold 1e-4\n" +
                        above("follow loading 0 -1 0 frame 1e6 mass 1e-3") +
                        "fix curve all curve 100 curve.tsv force N f_p[2] d m f_p[8]\n" + run);
    std::string rows = folder.read("curve.tsv");
    rows = rows.substr(0, rows.find("# complete"));
    if (whole.empty()) whole = rows;
    EXPECT_EQ(rows, whole);
  }
}

}  // namespace
