// SPDX-License-Identifier: GPL-2.0-or-later
//
// fix platen in the engine: forces against closed forms, motion, servo, friction.
#include <gtest/gtest.h>

#include <cmath>

#include "fixes_deck.h"

namespace {

using namespace engine;

const double pi = std::acos(-1.0);
constexpr double radius = 1e-3, density = 2500, modulus = 1e9, thickness = 0.01;
const double stiffness_3d = 4 * radius * modulus, stiffness_2d = 2 * thickness * modulus;
const double mass_3d = 4.0 / 3.0 * pi * radius * radius * radius * density;

Table run_one(const EngineFolder &folder, const std::string &deck, int ranks = 1) {
  const EngineResult r = run_deck(folder, deck, ranks);
  EXPECT_TRUE(r.ok()) << r.screen;
  return read_table(folder.file("curve.tsv"));
}

const std::string force_columns =
    "fix curve all curve 1 curve.tsv fx N f_p[1] fy N f_p[2] fz N f_p[3] tx Nm f_p[4] ty Nm f_p[5] "
    "tz Nm f_p[6] n 1 f_p[13] shift m f_p[14] energy J f_p[15]\n";

TEST(FixPlaten, ForceIsStiffnessTimesOverlapIn3D) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0.002, 0.9e-3, 0.001}}, 3, 0.01));
  const Table t =
      run_one(folder, few_particles(3, 1e-8) + "fix p all platen plane 0 0 0 0 1 0 modulus 1e9\n" +
                          force_columns + "run 0\n");
  const double force = stiffness_3d * 0.1e-3;
  EXPECT_NEAR(t.last("fy"), -force, 1e-12 * force);
  EXPECT_EQ(t.last("fx"), 0.0);
  // Torque about the plane's point of a force at (0.002, 0, 0.001).
  EXPECT_NEAR(t.last("tx"), 0.001 * force, 1e-15);
  EXPECT_NEAR(t.last("tz"), -0.002 * force, 1e-15);
  EXPECT_EQ(t.last("n"), 1.0);
  EXPECT_NEAR(t.last("energy"), 0.5 * force * 0.1e-3, 1e-12 * force * 0.1e-3);
}

TEST(FixPlaten, ForceIsStiffnessTimesOverlapIn2D) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0.9e-3, 0}}, 2, 0.01));
  for (const std::string stiffness : {"modulus 1e9", "stiffness_per_radius 2e9"}) {
    const Table t =
        run_one(folder, few_particles(2, 1e-8, thickness) + "fix p all platen plane 0 0 0 0 1 0 " +
                            stiffness + "\n" + force_columns + "run 0\n");
    const double k = stiffness == "modulus 1e9" ? stiffness_2d : 2e9 * radius;
    EXPECT_NEAR(t.last("fy"), -k * 0.1e-3, 1e-12 * k * 0.1e-3) << stiffness;
  }
}

TEST(FixPlaten, CurvedPlatens) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0.3e-3, 0.4e-3, 0}}, 3, 0.01));
  struct Case {
    const char *surface;
    double fx, fy;  // direction of the force on the particle
    double overlap;
  };
  for (const Case &c : {Case{"cylinder z -0.3e-3 -0.4e-3 5 0.1e-3 outside", 0.6, 0.8, 0.1e-3},
                        Case{"cylinder z 0 0 5 1.4e-3 inside", -0.6, -0.8, 0.1e-3},
                        Case{"cylinder vector 0 0 2 0 0 5 1.4e-3 inside", -0.6, -0.8, 0.1e-3},
                        Case{"sphere -0.3e-3 -0.4e-3 0 0.1e-3 outside", 0.6, 0.8, 0.1e-3},
                        Case{"sphere 0 0 0 1.4e-3 inside", -0.6, -0.8, 0.1e-3}}) {
    const Table t = run_one(folder, few_particles(3, 1e-8) + "fix p all platen " + c.surface +
                                        " modulus 1e9\n" + force_columns + "run 0\n");
    const double force = stiffness_3d * c.overlap;
    EXPECT_NEAR(t.last("fx"), -force * c.fx, 1e-11 * force) << c.surface;
    EXPECT_NEAR(t.last("fy"), -force * c.fy, 1e-11 * force) << c.surface;
    EXPECT_NEAR(t.last("tz"), 0.0, 1e-15) << c.surface;  // through the axis
  }
}

TEST(FixPlaten, OscillatesWithTheClosedFormFrequency) {
  // A sphere gripped between two platens: stiffness 2 k. Leap-frog gives a cosine exactly, with
  // sin(w dt/2) = sqrt(2 k/m) dt/2.
  EngineFolder folder;
  const double offset = 1e-5, dt = 2e-7;
  folder.write("particles.data", data_file({{0, offset, 0}}, 3, 0.01));
  const Table t = run_one(folder, few_particles(3, dt) +
                                      "fix move all nve/bonded\n"
                                      "fix p all platen plane 0 -0.9e-3 0 0 1 0 modulus 1e9\n"
                                      "fix q all platen plane 0 0.9e-3 0 0 -1 0 modulus 1e9\n"
                                      "variable y equal xcm(all,y)\n"
                                      "fix curve all curve 1 curve.tsv y m v_y\nrun 2000\n");
  const double omega = 2 / dt * std::asin(0.5 * dt * std::sqrt(2 * stiffness_3d / mass_3d));
  ASSERT_GT(omega * 2000 * dt, 10 * 2 * pi);  // more than ten cycles
  const auto y = t.column("y");
  ASSERT_EQ(y.size(), 2001u);
  for (std::size_t k = 0; k < y.size(); ++k)
    ASSERT_NEAR(y[k], offset * std::cos(omega * k * dt), 1e-9 * offset) << k;
}

TEST(FixPlaten, FrictionSticksThenSlides) {
  // A platen is drawn under a sphere that is held: shear k_s V t up to mu F_n.
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0.9e-3, 0}}, 3, 0.01));
  const Table t = run_one(folder, few_particles(3, 1e-7) +
                                      "fix p all platen plane 0 0 0 0 1 0 modulus 1e9 ratio 2 "
                                      "friction 0.25 velocity 0.1 0 0\n" +
                                      force_columns + "run 5000\n");
  const double normal = stiffness_3d * 0.1e-3, ks = stiffness_3d / 2;
  const auto fx = t.column("fx"), fy = t.column("fy"), tz = t.column("tz");
  bool stuck = false, slid = false;
  for (std::size_t k = 0; k < fx.size(); ++k) {
    const double elastic = ks * 0.1 * 1e-7 * k;
    const double expected = std::fmin(elastic, 0.25 * normal);
    ASSERT_NEAR(fx[k], -expected, 1e-10 * normal) << k;
    ASSERT_NEAR(fy[k], -normal, 1e-12 * normal);
    // The reference point has moved away from under the sphere by V t.
    ASSERT_NEAR(tz[k], 0.1 * 1e-7 * k * normal, 1e-12 * normal);
    (elastic < 0.25 * normal ? stuck : slid) = true;
  }
  EXPECT_TRUE(stuck && slid);
}

TEST(FixPlaten, AContactThatOpenedStartsAfresh) {
  // A held sphere on a sliding platen is lifted for a step and put back: no shear is left.
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0.9e-3, 0}}, 3, 0.01));
  const Table t = run_one(folder, few_particles(3, 1e-7) +
                                      "fix p all platen plane 0 0 0 0 1 0 modulus 1e9 ratio 2 "
                                      "friction 0.25 velocity 0.1 0 0\n" +
                                      force_columns +
                                      "run 100\nset group all y 1.1e-3\nrun 1\n"
                                      "set group all y 0.9e-3\nrun 10\n");
  const auto fx = t.column("fx"), step = t.column("step");
  const double each = stiffness_3d / 2 * 0.1 * 1e-7;
  ASSERT_EQ(step[100], 100.0);
  EXPECT_NEAR(fx[100], -100 * each, 1e-9 * each);
  EXPECT_EQ(fx[101], 0.0);
  EXPECT_NEAR(t.last("fx"), -10 * each, 1e-9 * each);
}

TEST(FixPlaten, ShearTurnsTheParticleAndBalances) {
  // Free sphere on a platen that starts to move: torque on the sphere is arm x force, so its spin
  // is that of a rolling start: acceleration F/m at the centre, F r/I about it, at first.
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 1e-3 - 1e-6, 0}}, 3, 0.01));
  const Table t =
      run_one(folder, few_particles(3, 1e-8) +
                          "fix move all nve/bonded\n"
                          "fix q all platen plane 0 1.998e-3 0 0 -1 0 modulus 1e9\n"
                          "fix p all platen plane 0 0 0 0 1 0 modulus 1e9 ratio 2 friction 5 "
                          "velocity 1e-3 0 0 ramp 1e-6\n"
                          "variable vx equal vcm(all,x)\nvariable wz equal omegaz[1]\n"
                          "fix curve all curve 1 curve.tsv vx m/s v_vx wz 1/s v_wz\nrun 200\n");
  // I w = -arm F: with the arm of the contact point R - overlap and I = 0.4 m R^2,
  // w R/v = -(m R arm)/I times (sign of the arm downwards).
  const double arm = radius - 1e-6;
  const double expected = mass_3d * arm / (0.4 * mass_3d * radius * radius);
  EXPECT_GT(t.last("vx"), 0.0);
  EXPECT_NEAR(t.last("wz") / t.last("vx"), expected, 1e-3 * expected);
}

TEST(FixPlaten, TheRampIsTheClosedForm) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0.005, 0}}, 3, 0.01));
  const Table t = run_one(
      folder, few_particles(3, 1e-7) +
                  "fix p all platen plane 0 0 0 0 1 0 modulus 1e9 velocity 0.3 -0.2 0.1 ramp 2e-4\n"
                  "fix curve all curve 1 curve.tsv dx m f_p[7] dy m f_p[8] dz m f_p[9] vx m/s "
                  "f_p[10] vy m/s f_p[11] vz m/s f_p[12]\nrun 3000\n");
  const auto time = t.column("time"), dx = t.column("dx"), dy = t.column("dy"), dz = t.column("dz"),
             vx = t.column("vx");
  EXPECT_EQ(vx.front(), 0.0);
  EXPECT_EQ(dx.front(), 0.0);
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double s = time[k], T = 2e-4;
    const double d = s < T ? 0.5 * (s - T / pi * std::sin(pi * s / T)) : s - 0.5 * T;
    const double v = s < T ? 0.5 * (1 - std::cos(pi * s / T)) : 1.0;
    ASSERT_NEAR(dx[k], 0.3 * d, 1e-17);
    ASSERT_NEAR(dy[k], -0.2 * d, 1e-17);
    ASSERT_NEAR(dz[k], 0.1 * d, 1e-17);
    ASSERT_NEAR(vx[k], 0.3 * v, 1e-13);
  }
}

TEST(FixPlaten, TouchLeavesNoGapAndNoForce) {
  EngineFolder folder;
  folder.write("particles.data",
               data_file({{0, 0.002, 0}, {0.003, 0.0045, 0}, {-0.003, -0.002, 0}}, 3, 0.01));
  struct Case {
    const char *arguments;
    double shift;
  };
  // The top of the highest particle is at y = 0.0055.
  for (const Case &c :
       {Case{"plane 0 0.009 0 0 -1 0 touch", 0.0035}, Case{"plane 0 0.001 0 0 -1 0 touch", -0.0045},
        Case{"plane 0 0.009 0 0 -1 0 touch along 0 -2 0", 0.0035},
        Case{"sphere 0.003 0.009 0 0.001 outside touch along 0 -1 0", 0.0025},
        Case{"cylinder z 0.003 0.009 0 0.001 outside touch", 0.0025}}) {
    const Table t = run_one(folder, few_particles(3, 1e-8) + "fix p all platen " + c.arguments +
                                        " modulus 1e9\n" + force_columns + "run 0\n");
    EXPECT_NEAR(t.last("shift"), c.shift, 1e-15) << c.arguments;
    EXPECT_NEAR(t.last("fy"), 0.0, 1e-15 * stiffness_3d) << c.arguments;
  }
}

TEST(FixPlaten, ServoReachesAndHoldsItsForce) {
  // The force approaches its target as exp(-G k/2 t), k/2 that of the two contacts in series:
  // exp(-16) after 40,000 steps.
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 1e-3, 0}}, 3, 0.01));
  const Table t = run_one(
      folder,
      few_particles(3, 2e-7) +
          "fix move all nve/bonded\n"
          "fix bottom all platen plane 0 0 0 0 1 0 modulus 1e9 at_rest\n"
          "fix top all platen plane 0 2e-3 0 0 -1 0 modulus 1e9 servo fy 20 gain 1e-3 "
          "vmax 0.05\n"
          "fix damp all damp/local 0.5\n"
          "fix curve all curve 10 curve.tsv top N f_top[2] bottom N f_bottom[2] d m f_top[8] "
          "v m/s f_top[11]\nrun 40000\n");
  EXPECT_NEAR(t.last("top"), 20.0, 20.0 * 1e-6);
  EXPECT_NEAR(t.last("bottom"), -20.0, 20.0 * 1e-6);
  EXPECT_NEAR(t.last("d"), -20.0 * 2 / stiffness_3d, 20.0 * 2 / stiffness_3d * 1e-5);
  for (double v : t.column("v")) EXPECT_LE(std::fabs(v), 0.05);
  EXPECT_EQ(t.column("v").front(), 0.0);
}

TEST(FixPlaten, ServoDoesNotDependOnWhatIsWritten) {
  // The force it works on is that of every step, asked for or not.
  std::vector<double> last;
  for (const std::string every : {"1", "50", "1000"}) {
    EngineFolder folder;
    folder.write("particles.data", data_file({{0, 1e-3, 0}}, 3, 0.01));
    const Table t =
        run_one(folder, few_particles(3, 2e-7) +
                            "fix move all nve/bonded\n"
                            "fix bottom all platen plane 0 0 0 0 1 0 modulus 1e9\n"
                            "fix top all platen plane 0 2e-3 0 0 -1 0 modulus 1e9 servo "
                            "fy 20 gain 1e-3 vmax 0.05\nfix curve all curve " +
                            every + " curve.tsv d m f_top[8] top N f_top[2]\nrun 1000\n");
    last.push_back(t.last("d"));
  }
  EXPECT_EQ(last[0], last[1]);
  EXPECT_EQ(last[0], last[2]);
}

TEST(FixPlaten, ShearSpringsMigrateWithTheirParticle) {
  // A sphere gripped by two platens that carry it from one rank to another, while the springs that
  // started it swing on: the same bits on one rank and on two.
  std::string one;
  for (int ranks : {1, 2}) {
    EngineFolder folder;
    folder.write("particles.data", data_file({{-0.3e-3, 0, 0}, {-0.009, 0, 0.005}}, 3, 0.01));
    const std::string grip = " modulus 1e9 ratio 2 friction 5 velocity 2 0 0 ramp 1e-4\n";
    run_one(folder,
            "processors " + std::to_string(ranks) + " 1 1\n" + few_particles(3, 2e-7) +
                "group gripped id 1\nfix move all nve/bonded\n"
                "fix p gripped platen plane 0 -0.95e-3 0 0 1 0" +
                grip + "fix q gripped platen plane 0 0.95e-3 0 0 -1 0" + grip +
                "variable x equal x[1]\n"
                "fix curve all curve 1 curve.tsv x m v_x px N f_p[1] py N f_p[2]\nrun 4000\n",
            ranks);
    if (ranks == 1) one = folder.read("curve.tsv");
    ASSERT_EQ(folder.read("curve.tsv"), one);
    const Table t = read_table(folder.file("curve.tsv"));
    ASSERT_GT(t.last("x"), 0.5e-3);  // beyond the boundary at 0, by more than half the skin
    double swing = 0.0;
    const auto px = t.column("px");
    for (std::size_t k = px.size() - 500; k < px.size(); ++k)
      swing = std::fmax(swing, std::fabs(px[k]));
    ASSERT_GT(swing, 1e-3);
  }
}

TEST(FixPlaten, AChangeOfTheTimeStepDoesNotJerkThePlaten) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0.005, 0}}, 3, 0.01));
  const Table t =
      run_one(folder, few_particles(3, 1e-7) +
                          "fix p all platen plane 0 0 0 0 1 0 modulus 1e9 velocity 0 0.5 0\n"
                          "fix curve all curve 1 curve.tsv d m f_p[8]\n"
                          "run 100\ntimestep 3e-8\nrun 100\nreset_timestep 1000\nrun 100\n");
  const auto d = t.column("d");
  ASSERT_EQ(d.size(), 302u);  // step 1000 after the reset is a row again
  EXPECT_NEAR(d[100], 0.5 * 100 * 1e-7, 1e-17);
  EXPECT_NEAR(d[101] - d[100], 0.5 * 3e-8, 1e-17);
  EXPECT_EQ(d[201], d[200]);
  EXPECT_NEAR(d.back(), 0.5 * (100 * 1e-7 + 200 * 3e-8), 1e-17);
}

}  // namespace
