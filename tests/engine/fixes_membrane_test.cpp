// SPDX-License-Identifier: GPL-2.0-or-later
//
// fix membrane: the total push, its balance, and the stress it makes in a specimen.
#include <gtest/gtest.h>

#include <cmath>

#include "fixes_deck.h"

namespace {

using namespace engine;

const std::string kInputs = std::string(BONDLAB_SOURCE_DIR) + "/inputs/";
const double pi = std::acos(-1.0);

// Forces after one set-up, on grains that are held and don't touch anything (no bonds, no contact).
std::string forces(int dimension, const std::string &specimen, const std::string &fix) {
  return "units si\ndimension " + std::to_string(dimension) + "\nboundary f f " +
         (dimension == 2 ? "p" : "f") +
         "\nnewton off\natom_style bonded/sphere thickness 0.5\ncommunicate single vel yes\n"
         "bond_style parallel\npair_style grain\nread_data " +
         kInputs + "specimens/" + specimen +
         "\nneighbor 0.0005 bin\npair_coeff * * 0 2 0\nbond_coeff 1 1e9 2 1e9 1e9\n"
         "bond_install all gap 1e-5\ntimestep 1e-9\nfix jacket all membrane " +
         fix +
         "\ncompute fx all property/atom fx\ncompute fy all property/atom fy\n"
         "compute fz all property/atom fz\n"
         "variable ax atom abs(fx)\nvariable ay atom abs(fy)\nvariable rf atom (x*fx+y*fy)/sqrt(x^2+y^2)\n"
         "compute sum all reduce sum c_fx c_fy c_fz v_ax v_ay v_rf\nvariable p equal f_jacket[1]\n"
         "variable n equal f_jacket[2]\n"
         "fix curve all curve 1 curve.tsv fx N c_sum[1] fy N c_sum[2] fz N c_sum[3] ax N c_sum[4] "
         "ay N c_sum[5] radial N c_sum[6] p Pa v_p n 1 v_n\nrun 0\n";
}

Table run_one(const EngineFolder &folder, const std::string &deck) {
  const EngineResult r = run_deck(folder, deck, 1);
  EXPECT_TRUE(r.ok()) << r.screen;
  return read_table(folder.file("curve.tsv"));
}

TEST(FixMembrane, PushesEachFlankWithPressureTimesItsArea) {
  EngineFolder folder;
  const Table t = run_one(folder, forces(2, "rectangle_small_2d.data", "y 2e6 reach 1e-4"));
  const double force = 2e6 * 0.050 * 0.5;  // height 50 mm, thickness 0.5 m
  EXPECT_NEAR(t.last("ax"), 2 * force, 1e-3 * force);  // the packing fills its box to within that
  EXPECT_NEAR(t.last("fx"), 0.0, 1e-9 * force);
  EXPECT_NEAR(t.last("ay"), 0.0, 1e-9 * force);
  EXPECT_GT(t.last("n"), 20.0);
  EXPECT_LT(t.last("n"), 80.0);
}

TEST(FixMembrane, PushesACylinderInwardsWithoutNetForce) {
  EngineFolder folder;
  const Table t = run_one(folder, forces(3, "cylinder_small_3d.data", "z 2e6 reach 2e-5"));
  const double force = 2e6 * pi * 0.010 * 0.020;
  EXPECT_NEAR(t.last("radial"), -force, 0.01 * force);  // what is taken out is of second order
  EXPECT_NEAR(t.last("fx"), 0.0, 1e-9 * force);
  EXPECT_NEAR(t.last("fy"), 0.0, 1e-9 * force);
  EXPECT_NEAR(t.last("fz"), 0.0, 1e-9 * force);
}

TEST(FixMembrane, WrongArgumentsAreExplained) {
  EngineFolder folder;
  const EngineResult r =
      run_deck(folder, forces(2, "rectangle_small_2d.data", "z 2e6 reach 1e-4"));
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("the axis of the specimen is 'z', allowed are x|y")) << r.screen;
}

}  // namespace
