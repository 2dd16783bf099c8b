// SPDX-License-Identifier: GPL-2.0-or-later
//
// Grains that leave the box of a specimen's file: the box grows after them, none is lost, the bits are
// those of one rank; a grain that flies without end, or to no place at all, ends the run by name.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "bond_deck.h"
#include "deck_tools.h"

namespace {

using namespace engine;
using namespace engine::decks;

// ---- a deck ----

// A steep end on weak bonds, closed fast and undamped: the corner is crushed and its grains fly.
const Values kCrushed{{"alpha", "3"},        {"sigma_c", "20e6"},  {"damping", "0"},
                      {"platen_speed", "10"}, {"stop_least", "1e3"}, {"max_strain", "0.15"}};
constexpr double kBoxHalf = 0.025;  // m, of rectangle_small_2d.data along x

struct Crowd {
  int grains = 0, outside = 0;  // of the file's box
};

Crowd at_the_end(const EngineFolder &folder) {
  std::istringstream in(folder.read("particles_end.txt"));
  std::string line;
  while (std::getline(in, line) && line.rfind("ITEM: ATOMS", 0) != 0) {
  }
  Crowd crowd;
  double id, type, radius, x;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    if (!(fields >> id >> type >> radius >> x)) continue;
    ++crowd.grains;
    crowd.outside += std::fabs(x) > kBoxHalf;
  }
  return crowd;
}

TEST(UniaxialDeck, follows_grains_that_leave_the_box_of_the_file) {
  EngineFolder folder;
  const Table t = curve_of(folder, "uniaxial_compression",
                           with_specimen("rectangle_small_2d.data") + var(kCrushed));
  EXPECT_EQ(t.completion, "stop_at_limit");
  const Crowd crowd = at_the_end(folder);
  EXPECT_EQ(crowd.grains, 299);
  EXPECT_GE(crowd.outside, 3);
}

TEST(UniaxialDeck, is_the_same_on_1_2_and_4_ranks_when_grains_leave_the_box) {
  expect_same_on_ranks("uniaxial_compression", with_specimen("rectangle_small_2d.data") + var(kCrushed));
}

TEST(UniaxialDeck, names_a_grain_of_a_specimen_that_blows_up) {
  std::string text = deck("uniaxial_compression");
  const std::string stable = "timestep_bonded ${safety}\n";
  const std::size_t at = text.find(stable);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, stable.size(), stable + "variable unstable equal 10*dt\ntimestep ${unstable}\n");
  for (const int ranks : {1, 2}) {
    EngineFolder folder;
    const auto run = run_deck(folder, text, ranks, with_specimen("rectangle_small_2d.data"), 60);
    EXPECT_FALSE(run.ok());
    EXPECT_FALSE(run.timed_out);
    EXPECT_TRUE(run.says("has flown to")) << run.screen;
  }
}

// ---- grains alone ----

constexpr double kHalf = 0.03;       // m, of the box
constexpr double kFar = 20 * 2 * kHalf;  // m beyond it the run ends
constexpr double kSpeed = 1000;      // m/s

// A bonded pair that swings in the middle and a grain that flies each way along each axis, a millimetre a
// step, so that the lists are made anew at each.
std::string burst(const EngineFolder &folder, const std::string &velocity_of_last = "") {
  std::vector<Particle> grains(8);
  grains[0].x = -1e-3, grains[1].x = 1e-3;
  std::ostringstream velocities;
  velocities << "\nVelocities\n\n1 0.1 0.2 0.3 0 0 5\n2 0 0 0 0 0 0\n";
  for (int way = 0; way < 6; ++way) {
    const double sign = way % 2 ? 1 : -1;
    double v[3] = {0, 0, 0};
    v[way / 2] = sign * kSpeed;
    Particle &p = grains[2 + way];
    (way / 2 == 0 ? p.x : way / 2 == 1 ? p.y : p.z) = sign * 0.01;
    velocities << 3 + way << ' ';
    if (way == 5 && !velocity_of_last.empty())
      velocities << velocity_of_last;
    else
      velocities << v[0] << ' ' << v[1] << ' ' << v[2];
    velocities << " 0 0 0\n";
  }
  folder.write("burst.data", data_file(grains, 3, kHalf) + velocities.str());
  bonds::Preamble p;
  p.specimen = "burst.data";
  p.install = "gap 1e-5";
  p.boundary = "m m m";
  p.skin = "1e-3";
  p.safety = 0;
  return p.text() + "timestep 1e-6\nfix integrate all nve/bonded\n";
}

std::string steps(double way) {
  return "run " + std::to_string(static_cast<int>(way / (kSpeed * 1e-6))) + "\n";
}

// In bins of half a cutoff the last box would have 2^31 of them and more.
TEST(FlyingGrains, a_large_box_has_no_more_bins_than_fit) {
  const auto fly = [](int ranks, const EngineFolder &folder) {
    const EngineResult r =
        run_deck(folder, burst(folder) + steps(0.9 * kFar) + bonds::dump_all("end.txt"), ranks, {}, 120);
    EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
    return folder.read("end.txt");
  };
  EngineFolder one, two, four;
  const std::string alone = fly(1, one);
  const auto rows = bonds::read_dump(one, "end.txt");
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_NEAR(rows.at(3)[0], -0.01 - 0.9 * kFar, 1e-9);
  EXPECT_TRUE(alone == fly(2, two)) << "2 ranks";
  EXPECT_TRUE(alone == fly(4, four)) << "4 ranks";
}

TEST(FlyingGrains, one_that_is_too_far_ends_the_run_by_name) {
  for (const int ranks : {1, 2}) {
    EngineFolder folder;
    const EngineResult r = run_deck(folder, burst(folder, "0 0 1200") + steps(1.1 * kFar), ranks, {}, 120);
    EXPECT_FALSE(r.ok());
    EXPECT_FALSE(r.timed_out);
    EXPECT_TRUE(r.says("atom 8 has flown to 0 0 1.23")) << r.screen;
    EXPECT_TRUE(r.says("more than 20 box sides (1.2 m) beyond the box of the start")) << r.screen;
  }
}

TEST(FlyingGrains, a_place_that_is_no_number_ends_the_run_by_name) {
  EngineFolder folder;
  const EngineResult r = run_deck(folder, burst(folder, "0 nan 0") + steps(kHalf), 1, {}, 60);
  EXPECT_FALSE(r.ok());
  EXPECT_TRUE(r.says("the position of atom 8 is not a number")) << r.screen;
}

// What was written in a box that has grown goes on with the same bits (the box itself may not: the engine
// keeps a margin around it that is a share of the size it was read with).
TEST(FlyingGrains, go_on_from_a_restart) {
  EngineFolder one, two;
  const std::string cut = steps(0.1 * kFar), rest = steps(0.2 * kFar);
  const EngineResult whole = run_deck(
      one, burst(one) + cut + "write_restart state\n" + rest + bonds::dump_all("end.txt"), 1, {}, 60);
  ASSERT_TRUE(whole.ok()) << whole.screen;
  const EngineResult again = run_deck(
      two, "atom_style bonded/sphere\nnewton off\ncommunicate single vel yes\nread_restart " + one.file("state") +
               "\nneighbor 1e-3 bin\nneigh_modify delay 0\nthermo 100000\nthermo_style custom step time ke\n"
               "thermo_modify lost error\ntimestep 1e-6\nfix integrate all nve/bonded\n" +
               rest + bonds::dump_all("end.txt"),
      2, {}, 60);
  ASSERT_TRUE(again.ok()) << again.screen;
  const auto rows = bonds::read_dump(one, "end.txt");
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_TRUE(rows == bonds::read_dump(two, "end.txt"));
}

}  // namespace
